//! Predators and prey: x' = x(y − 2) and y' = y(1 − x) in several one-forms of the same motion, and three
//! species in a circle.

use dvi_core::prelude::*;

/// Lotka–Volterra with a gauge that leaves a one-form along x only: in the class of one-step schemes.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (y.ln() / x * d(x) - x.ln() / y * d(y)) / 2.0,
    hamiltonian = x - x.ln() + y - 2.0 * y.ln(),
    gauge       = auto,
)]
#[derive(Clone, Debug)]
pub struct OneSidedPredators {}

/// The same motion with one-forms that have components along both coordinates, and differ by gauges.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = ((2.0 - share) * y.ln() / x * d(x) - share * x.ln() / y * d(y)) / 2.0
        + shift * (y * d(x) + x * d(y)),
    hamiltonian = x - x.ln() + y - 2.0 * y.ln(),
)]
#[derive(Clone, Debug)]
pub struct Predators {
    /// How much of the one-form is along y: 1 makes it symmetric, 0 one-sided.
    pub share: f64,
    /// How much of d(xy) is added.
    pub shift: f64,
}

/// Three species that eat each other in a circle, x' = x(y − z), y' = y(z − x), z' = z(x − y), as a
/// degenerate system of four.
///
/// The Poisson bracket {x, y} = xy, {y, z} = yz, {z, x} = zx of three coordinates has a function that
/// commutes with all, its Casimir xyz, and no one-form. With w = ln xyz in place of z, and with a coordinate
/// s that is conjugate to w and on which nothing depends, it has one: (ln y/x) dx + w ds. The energy is x +
/// y + z, and the momentum of s is w.
#[degenerate_lagrangian(
    coordinates(x, s, y, w),
    one_form    = y.ln() / x * d(x) + w * d(s),
    hamiltonian = x + y + w.exp() / (x * y),
    momenta(casimir = w),
)]
#[derive(Clone, Debug)]
pub struct ThreeSpecies {}

/// The same motion with w as a parameter, which leaves x and y.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y.ln() / x * d(x),
    hamiltonian = x + y + product / (x * y),
)]
#[derive(Clone, Debug)]
pub struct ThreeSpeciesReduced {
    pub product: f64,
}
