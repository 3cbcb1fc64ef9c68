//! Charged particles without mass.

use dvi_core::degenerate_lagrangian;

/// The guiding centre of a particle in a magnetic mirror, B = curl A with A = ½(1 + 0.3 z²)(−y, x, 0), and
/// an electric potential. Ω couples all pairs but (x, u) and (y, u) on the axis, so that no gauge brings it
/// into class.
#[degenerate_lagrangian(
    coordinates(x, y, z, u),
    one_form = {
        let bx = -0.3 * x * z;
        let by = -0.3 * y * z;
        let bz = 1.0 + 0.3 * z * z;
        let b = (bx * bx + by * by + bz * bz).sqrt();
        (x * d(y) - y * d(x)) * bz / 2.0 + u * (bx * d(x) + by * d(y) + bz * d(z)) / b
    },
    hamiltonian = {
        let bx = -0.3 * x * z;
        let by = -0.3 * y * z;
        let bz = 1.0 + 0.3 * z * z;
        u * u / 2.0 + 0.5 * (bx * bx + by * by + bz * bz).sqrt() + 0.05 * x * x
    },
)]
#[derive(Clone, Debug)]
pub struct Mirror;
