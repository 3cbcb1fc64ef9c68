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
