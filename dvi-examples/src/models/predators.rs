//! Predators x and prey y, x' = x(y − 2) and y' = y(1 − x), in two one-forms of the same motion.

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

/// The same motion with the symmetric one-form, which has components along both coordinates.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (y.ln() / x * d(x) - x.ln() / y * d(y)) / 2.0,
    hamiltonian = x - x.ln() + y - 2.0 * y.ln(),
)]
#[derive(Clone, Debug)]
pub struct SymmetricPredators {}
