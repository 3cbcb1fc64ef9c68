//! Oscillators and pendulums with one degree of freedom.

use dvi_core::prelude::*;

/// z' = iωz with z = x + iy: the test equation of stability.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = omega / 2.0 * (x * x + y * y),
)]
#[derive(Clone, Debug)]
pub struct Rotation {
    /// The frequency ω.
    pub omega: f64,
}

/// z' = λz for any complex λ, by L = w·(z' − λz) with a second variable w' = −λᵀw that stays zero if it
/// begins so.
#[degenerate_lagrangian(
    coordinates(z[2], w[2]),
    one_form = (w[0] * d(z[0]) + w[1] * d(z[1]) - z[0] * d(w[0]) - z[1] * d(w[1])) / 2.0,
    hamiltonian = w[0] * (real * z[0] - imaginary * z[1]) + w[1] * (imaginary * z[0] + real * z[1]),
)]
#[derive(Clone, Debug)]
pub struct Linear {
    /// The real part of λ.
    pub real: f64,
    /// The imaginary part of λ.
    pub imaginary: f64,
}

/// x'' = −kx: an oscillator of frequency √k, or, with negative k, what runs away from its origin.
#[lagrangian(
    coordinates(x),
    lagrangian = (dot(x).powi(2) - k * x * x) / 2.0,
)]
#[derive(Clone, Debug)]
pub struct Spring {
    /// Stiffness over mass.
    pub k: f64,
}

/// x'' = −sin x, x in radians from the lowest point.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 + x.cos(),
)]
#[derive(Clone, Debug)]
pub struct Pendulum {}

/// The same pendulum in phase space, with p = x' and a one-form along x only.
#[degenerate_lagrangian(
    coordinates(x, p),
    one_form    = p * d(x),
    hamiltonian = p * p / 2.0 - x.cos(),
)]
#[derive(Clone, Debug)]
pub struct PhasePendulum {}

/// The same with the symmetric one-form.
#[degenerate_lagrangian(
    coordinates(x, p),
    one_form    = (p * d(x) - x * d(p)) / 2.0,
    hamiltonian = p * p / 2.0 - x.cos(),
)]
#[derive(Clone, Debug)]
pub struct SymmetricPendulum {}
