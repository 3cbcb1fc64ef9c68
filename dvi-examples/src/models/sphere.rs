//! Point vortices on the unit sphere.

use dvi_core::prelude::*;

/// In z = cos θ and the longitude φ, with α = −Σ Γ z dφ along the longitudes only. The moment Σ Γ r is
/// conserved, of which the component along the axis belongs to the rotation of all longitudes.
#[degenerate_lagrangian(
    coordinates(z[N], phi[N]),
    one_form    = sum(0..N, |j| -gamma[j] * z[j] * d(phi[j])),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k] * (2.0 - 2.0 * (z[j] * z[k]
        + ((1.0 - z[j].powi(2)) * (1.0 - z[k].powi(2))).sqrt() * (phi[j] - phi[k]).cos())).ln()) / (4.0 * PI),
    momenta(
        moment_x = sum(0..N, |j| gamma[j] * (1.0 - z[j].powi(2)).sqrt() * phi[j].cos()),
        moment_y = sum(0..N, |j| gamma[j] * (1.0 - z[j].powi(2)).sqrt() * phi[j].sin()),
        moment_z = sum(0..N, |j| gamma[j] * z[j]),
    ),
)]
#[derive(Clone, Debug)]
pub struct SphereVortices<const N: usize> {
    /// The circulations Γ.
    pub gamma: [f64; N],
}

impl<const N: usize> SphereVortices<N> {
    /// r of each vortex of a state in flat form.
    pub fn places(&self, q: &[f64]) -> [[f64; 3]; N] {
        std::array::from_fn(|j| {
            let (z, (sin, cos)) = (q[j], q[j + N].sin_cos());
            let radius = (1.0 - z * z).sqrt();
            [radius * cos, radius * sin, z]
        })
    }

    /// Vortices at these places, which need not be of length one.
    pub fn state(places: [[f64; 3]; N]) -> SphereVorticesState<N> {
        SphereVorticesState {
            z: places.map(|[x, y, z]| z / (x * x + y * y + z * z).sqrt()),
            phi: places.map(|[x, y, _]| y.atan2(x)),
        }
    }
}
