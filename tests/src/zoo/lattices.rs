//! Periodic quantum lattices, ψ = q + ip, with neighbours.

use dvi_core::degenerate_lagrangian;

/// The discrete nonlinear Schrödinger equation with hopping to the first and second neighbour.
#[degenerate_lagrangian(
    coordinates(q[N], p[N]),
    one_form    = sum(0..N, |j| p[j] * d(q[j])),
    hamiltonian = sum(0..N, |j| lambda / 4.0 * (q[j].powi(2) + p[j].powi(2)).powi(2)
                      - hopping[0] * (q[j] * q[(j + 1) % N] + p[j] * p[(j + 1) % N])
                      - hopping[1] * (q[j] * q[(j + N - 2) % N] + p[j] * p[(j + N - 2) % N])),
    momenta(norm = sum(0..N, |j| q[j] * q[j] + p[j] * p[j]) / 2.0),
)]
#[derive(Clone, Debug)]
pub struct Schroedinger<const N: usize> {
    /// Strength of the nonlinearity.
    pub lambda: f64,
    /// Hopping amplitudes.
    pub hopping: [f64; 2],
}

/// Ablowitz and Ladik's integrable lattice, with a nonlinear one-form.
#[degenerate_lagrangian(
    coordinates(q[N], p[N]),
    one_form    = sum(0..N, |j| {
                      let r = q[j] * q[j] + p[j] * p[j];
                      r.ln_1p() / (2.0 * r) * (p[j] * d(q[j]) - q[j] * d(p[j]))
                  }),
    hamiltonian = -sum(0..N, |j| q[j] * q[(j + 1) % N] + p[j] * p[(j + 1) % N]),
    momenta(norm = sum(0..N, |j| (q[j] * q[j] + p[j] * p[j]).ln_1p())),
)]
#[derive(Clone, Debug)]
pub struct AblowitzLadik<const N: usize> {}
