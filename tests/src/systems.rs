//! Systems of different kinds, as a downstream crate declares them.

use dvi_core::degenerate_lagrangian;

pub use dvi_examples::models::{PointVortices, PointVorticesState, PointVorticesStateOf};

/// Point vortices whose number is known at run time only.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form    = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k]
                      * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
    momenta(
        impulse_x = sum(0..gamma.len(), |j| gamma[j] * x[j]),
        impulse_y = sum(0..gamma.len(), |j| gamma[j] * y[j]),
        angular   = sum(0..gamma.len(), |j| gamma[j] * (x[j].powi(2) + y[j].powi(2))) / 2.0,
    ),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct ManyVortices {
    /// Circulations.
    pub gamma: Vec<f64>,
}

/// z' = iωz.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = omega / 2.0 * (x * x + y * y),
    momenta(action = (x * x + y * y) / 2.0),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Oscillator {
    /// Frequency.
    pub omega: f64,
}

/// An affine one-form and a quartic Hamiltonian that couple everything to everything.
#[degenerate_lagrangian(
    coordinates(z[4]),
    one_form    = sum(0..4, |i| sum(0..4, |j| a[i][j] * z[j]) * d(z[i])),
    hamiltonian = sum(0..4, |i| sum(0..4, |j| s[i][j] * z[i] * z[j])) / 2.0
                      + quartic / 4.0 * sum(0..4, |i| z[i].powi(4)),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Quadratic {
    /// The matrix of the one-form, αᵢ = Σ Aᵢⱼzⱼ.
    pub a: [[f64; 4]; 4],
    /// The symmetric matrix of H.
    pub s: [[f64; 4]; 4],
    /// The size of the part that makes the system nonlinear.
    pub quartic: f64,
}

/// Lotka–Volterra in the symmetric gauge.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y.ln() / (2.0 * x) * d(x) - x.ln() / (2.0 * y) * d(y),
    hamiltonian = a[0] * x + a[1] * y + b[0] * x.ln() + b[1] * y.ln(),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct LotkaVolterra {
    /// a₁, a₂.
    pub a: [f64; 2],
    /// b₁, b₂.
    pub b: [f64; 2],
}

/// A nonlinear one-form with one entry of Dα per row.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = [-(y + kappa * y.powi(3)) / 2.0, (x + kappa * x.powi(3)) / 2.0],
    hamiltonian = (x * x + y * y) / 2.0 + x.powi(4) / 4.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Curved {
    /// How nonlinear α is.
    pub kappa: f64,
}

/// The one-form of a vortex on the sphere, which degenerates at σ = 0 and σ = 1.
#[degenerate_lagrangian(
    coordinates(phi, z),
    one_form    = -gamma * z * d(phi),
    hamiltonian = z * z / 2.0 + phi.cos(),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct SphereForm {
    /// Circulation.
    pub gamma: f64,
}

/// A gauge in which the shift of a step is a multiple of Δ that differs from coordinate to coordinate, and
/// the parasitic mode of σ = 0 grows by 7/3 a step.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = 0.3 * x * d(y) - 0.7 * y * d(x),
    hamiltonian = (x * x + y * y) / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Oblique;
