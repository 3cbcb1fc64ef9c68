//! Constraints of the velocities.

use dvi_core::prelude::*;

/// Constraints of the velocities with coefficients that are linear in the coordinates.
#[lagrangian(
    coordinates(q[4]),
    lagrangian = sum(0..4, |j| m[j] * dot(q[j]).powi(2) / 2.0),
    nonholonomic(i in 0..2) = sum(0..4, |j| (a[i][j] + sum(0..4, |k| b[i][j][k] * q[k])) * dot(q[j])) + c[i],
)]
#[derive(Clone, Copy, Debug)]
pub struct Bundle {
    /// Masses.
    pub m: [f64; 4],
    /// Coefficients of the velocities where q = 0.
    pub a: [[f64; 4]; 2],
    /// Their derivatives.
    pub b: [[[f64; 4]; 4]; 2],
    /// What a constraint has beside the velocities.
    pub c: [f64; 2],
}

/// A particle in space with ż = y ẋ, in a potential (x² + y²)/2.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - (x * x + y * y) / 2.0,
    nonholonomic = dot(z) - y * dot(x),
)]
#[derive(Clone, Copy, Debug)]
pub struct Particle;

/// A constraint that depends on the time, A v + b(t) = 0, and friction.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - x * x / 2.0,
    force(x) = -0.2 * dot(x),
    nonholonomic = (dot(y) - x * dot(x) - t.cos()) * (2.0 + x.sin()),
)]
#[derive(Clone, Copy, Debug)]
pub struct Steered;

/// A blade on an inclined plane, which slides along itself only. The slope leads along x.
#[lagrangian(
    coordinates(x, y, angle),
    lagrangian = m * (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + inertia * dot(angle).powi(2) / 2.0
        + m * slope * x,
    nonholonomic = dot(x) * angle.sin() - dot(y) * angle.cos(),
)]
#[derive(Clone, Copy, Debug)]
pub struct KnifeEdge {
    /// Mass.
    pub m: f64,
    /// Moment of inertia.
    pub inertia: f64,
    /// Acceleration along x.
    pub slope: f64,
}
