//! Lotka–Volterra in three gauges more than [`LotkaVolterra`](crate::systems::LotkaVolterra): α and
//! α + dF have the same dynamics and different derivatives.

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

/// [`OneSided`] + d(xy), as a list of components.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = [y + y.ln() / x, x],
    hamiltonian = a[0] * x + a[1] * y + b[0] * x.ln() + b[1] * y.ln(),
)]
#[derive(Clone, Debug)]
pub struct OneSidedShifted {
    /// a₁, a₂.
    pub a: [f64; 2],
    /// b₁, b₂.
    pub b: [f64; 2],
}

/// The symmetric gauge + d(xy).
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (y + y.ln() / (2.0 * x)) * d(x) + (x - x.ln() / (2.0 * y)) * d(y),
    hamiltonian = a[0] * x + a[1] * y + b[0] * x.ln() + b[1] * y.ln(),
)]
#[derive(Clone, Debug)]
pub struct SymmetricShifted {
    /// a₁, a₂.
    pub a: [f64; 2],
    /// b₁, b₂.
    pub b: [f64; 2],
}
