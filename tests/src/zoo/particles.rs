//! Vortices on the sphere and charged particles without mass.

use dvi_core::degenerate_lagrangian;

/// N point vortices on the unit sphere, in longitude φ and height z; γ is the angle between two.
#[degenerate_lagrangian(
    coordinates(phi[N], z[N]),
    one_form    = -sum(0..N, |j| gamma[j] * z[j] * d(phi[j])),
    hamiltonian = sum_pairs(0..N, |j, k| {
                      let flat = ((1.0 - z[j] * z[j]) * (1.0 - z[k] * z[k])).sqrt();
                      let cos_angle = z[j] * z[k] + flat * (phi[j] - phi[k]).cos();
                      gamma[j] * gamma[k] * (2.0 - 2.0 * cos_angle).ln()
                  }) / (4.0 * PI),
    momenta(
        moment_z = sum(0..N, |j| gamma[j] * z[j]),
        moment_x = sum(0..N, |j| gamma[j] * (1.0 - z[j].powi(2)).sqrt() * phi[j].cos()),
    ),
)]
#[derive(Clone, Debug)]
pub struct SphereVortices<const N: usize> {
    /// Circulations.
    pub gamma: [f64; N],
}

/// A guiding centre (x, y, z) with parallel velocity u: α = (A + u b)·dx with a unit vector b that
/// turns with the radius, so that Ω is dense.
#[degenerate_lagrangian(
    coordinates(x, y, z, u),
    one_form    = {
        let length = (1.0 + x * x + y * y + shear * z * z).sqrt();
        let potential = -(1.0 + x * x + y * y).ln() / 2.0;
        (-y / 2.0 - u * y / length) * d(x)
            + (x / 2.0 + u * x / length) * d(y)
            + (potential + u / length) * d(z)
            + shear * z * x * d(u)
    },
    hamiltonian = u * u / 2.0 + mu * (1.0 + x * x + y * y + shear * z * z).sqrt(),
)]
#[derive(Clone, Debug)]
pub struct GuidingCentre {
    /// Magnetic moment.
    pub mu: f64,
    /// How b depends on z.
    pub shear: f64,
}

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
