//! Systems and runs without the standard library, and without a heap.
//!
//! The crate is checked by itself, `cargo check -p dvi-no-std`: built together with the others it
//! would share their features.
#![no_std]
#![deny(warnings, missing_docs)]

use dvi_core::prelude::*;

/// N oscillators that are coupled by one more: an array of const-generic size beside single coordinates.
#[degenerate_lagrangian(
    coordinates(q[N], p[N], w[2]),
    one_form    = sum(0..N, |j| p[j] * d(q[j])) + w[1] * d(w[0]),
    hamiltonian = sum(0..N, |j| p[j].powi(2) + (q[j] - w[0]).powi(2)) / 2.0 + w[1].powi(2) / (2.0 * mass),
)]
#[derive(Clone, Debug)]
pub struct Bath<const N: usize> {
    /// Of the one in the middle.
    pub mass: f64,
}

/// A chain whose length is known at run time only.
#[cfg(feature = "alloc")]
#[degenerate_lagrangian(
    coordinates(q[stiffness.len()], p[stiffness.len()]),
    one_form    = sum(0..stiffness.len(), |j| p[j] * d(q[j])),
    hamiltonian = sum(0..stiffness.len(), |j| p[j].powi(2) / 2.0
                      + stiffness[j] * (q[(j + 1) % stiffness.len()] - q[j]).powi(2)),
)]
#[derive(Clone, Debug)]
pub struct Chain<'a> {
    /// Stiffness of the springs.
    pub stiffness: &'a [f64],
}

/// Bodies in the plane that attract each other.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |j| mass[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2))) / 2.0
        + sum_pairs(0..N, |j, k| mass[j] * mass[k] / (x[j] - x[k]).hypot(y[j] - y[k])),
)]
#[derive(Clone, Debug)]
pub struct Gravity<const N: usize> {
    /// Masses.
    pub mass: [f64; N],
}

/// The state after some steps of the implicit midpoint rule.
///
/// # Errors
/// [`StepFailure`], if a step fails; `None`, if the run cannot start.
pub fn last(steps: usize) -> Result<BathState<3>, Option<StepFailure>> {
    let system = Bath::<3> { mass: 2.0 };
    let start = BathState { q: [-1.0, 1.0, 0.5], p: [0.0; 3], w: [0.25, 0.0] };
    let mut run = Integrator::new(&system, Sigma::midpoint(), 0.1, start).map_err(|_| None)?;
    for _ in 0..steps {
        run.advance().map_err(|error| Some(error.failure))?;
    }
    Ok(run.state())
}
