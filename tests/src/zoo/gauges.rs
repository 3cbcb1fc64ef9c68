//! Lotka–Volterra in another gauge than [`LotkaVolterra`](crate::systems::LotkaVolterra).

use dvi_core::degenerate_lagrangian;

/// All of α on one coordinate.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y.ln() / x * d(x),
    hamiltonian = a[0] * x + a[1] * y + b[0] * x.ln() + b[1] * y.ln(),
)]
#[derive(Clone, Debug)]
pub struct OneSided {
    /// a₁, a₂.
    pub a: [f64; 2],
    /// b₁, b₂.
    pub b: [f64; 2],
}
