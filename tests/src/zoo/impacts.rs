//! Systems with impacts.

use dvi_core::prelude::*;

/// A ball above the floor.
#[lagrangian(coordinates(y), lagrangian = m * dot(y).powi(2) / 2.0 - m * y, impact = y)]
#[derive(Clone, Debug)]
pub struct Ball {
    /// Mass, or masses.
    pub m: f64,
}

/// A particle in a potential without symmetry, on a wavy floor.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y - 0.15 * x * x - 0.1 * x.powi(4) - 0.15 * x * x * y * y,
    impact = y - a * x.cos(),
)]
#[derive(Clone, Copy, Debug)]
pub struct Wavy {
    /// Height of the waves.
    pub a: f64,
}

/// Coupled coordinates with a mass matrix that depends on the position and a term linear in the velocities,
/// in a bowl.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (1.0 + 0.2 * y * y) * dot(x).powi(2) / 2.0 + dot(y).powi(2) / 2.0 + 0.3 * dot(x) * dot(y)
        + b * (x * dot(y) - y * dot(x)) / 2.0 - 0.5 * x * x - 0.8 * y * y,
    impact = [1.0 - x * x - 0.5 * y * y, y + 0.7],
)]
#[derive(Clone, Copy, Debug)]
pub struct Bowl {
    /// Magnetic field.
    pub b: f64,
}

/// A particle whose momentum is no affine function of its velocity, above a sloping floor.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -(1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() - 0.5 * y - 0.2 * x * x,
    impact = y - 0.3 * x,
)]
#[derive(Clone, Copy, Debug)]
pub struct Fast;

/// A ball with friction on a table that moves up and down.
#[lagrangian(
    coordinates(y),
    lagrangian = dot(y).powi(2) / 2.0 - y,
    force(y) = -0.05 * dot(y) + 0.3 * t.cos(),
    impact = y - a * (2.0 * t).sin(),
)]
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// How far the table moves.
    pub a: f64,
}

/// A particle in a central potential within a circle.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (x * x + y * y) / 2.0 - 0.3 * (x * x + y * y).powi(2),
    impact = 1.0 - x * x - y * y,
    momenta(l = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy, Debug)]
pub struct Circle;

/// Balls on a line, of unit diameter.
#[lagrangian(
    coordinates(x[m.len()]),
    lagrangian = sum(0..m.len(), |i| m[i] * dot(x[i]).powi(2) / 2.0),
    impact(i in 1..m.len()) = x[i] - x[i - 1] - 1.0,
    momenta(p = sum(0..m.len(), |i| m[i] * dot(x[i]))),
)]
#[derive(Clone, Debug)]
pub struct Balls {
    /// Mass, or masses.
    pub m: Vec<f64>,
}

/// A free particle between two walls.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, impact = [x, 1.0 - x])]
#[derive(Clone, Debug)]
pub struct Channel;

/// A free particle in a corner of the plane.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = [x, y],
)]
#[derive(Clone, Debug)]
pub struct Corner;

/// A free particle beside a disc.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = x * x + y * y - 1.0,
)]
#[derive(Clone, Debug)]
pub struct Disc;

/// A particle in a potential between two walls that are not parallel.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - 0.5 * x * x * y - 0.2 * y.powi(4) - x,
    impact = [x + 0.05 * y * y, 0.3 - x + 0.1 * y],
)]
#[derive(Clone, Debug)]
pub struct Slot;
