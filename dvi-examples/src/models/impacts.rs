//! A particle that bounces: within a closed curve, and on a curved floor.

use dvi_core::prelude::*;

/// An ellipse with half axes a > b. The product of the angular momenta about the two foci does not change at
/// an impact.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = 1.0 - x * x / (a * a) - y * y / (b * b),
    momenta(product = (x * dot(y) - y * dot(x)).powi(2) - (a * a - b * b) * dot(y).powi(2)),
)]
#[derive(Clone, Copy, Debug)]
pub struct EllipseBilliard {
    pub a: f64,
    pub b: f64,
}

/// The curve x⁴ + y⁴ = 1, between a circle and a square.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = 1.0 - x.powi(4) - y.powi(4),
)]
#[derive(Clone, Copy, Debug)]
pub struct RoundedSquareBilliard;

/// A particle of mass 1 under gravity, in a valley that becomes narrower with the height, above the floor
/// y = a cos x.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
        - (y + 0.15 * x * x + 0.1 * x.powi(4) + 0.15 * x * x * y * y),
    impact = y - a * x.cos(),
)]
#[derive(Clone, Copy, Debug)]
pub struct Bouncer {
    /// The height of the hill.
    pub a: f64,
}
