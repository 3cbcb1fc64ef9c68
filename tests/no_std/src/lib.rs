//! Systems and runs without the standard library, and without a heap.
//!
//! The crate is checked by itself, `cargo check -p dvi-no-std`: built together with the others it
//! would share their features.
#![no_std]
#![deny(warnings, missing_docs)]

use dvi_core::prelude::*;

/// Point vortices in the plane.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
                      * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
    momenta(impulse = sum(0..N, |j| gamma[j] * x[j])),
)]
#[derive(Clone, Debug)]
pub struct PointVortices<const N: usize> {
    /// Circulations.
    pub gamma: [f64; N],
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
pub fn last(steps: usize) -> Result<PointVorticesState<2>, Option<StepFailure>> {
    let system = PointVortices { gamma: [1.0, -1.0] };
    let start = PointVorticesState { x: [-1.0, 1.0], y: [0.0, 0.0] };
    let mut run = Integrator::new(&system, Sigma::midpoint(), 0.1, start).map_err(|_| None)?;
    for _ in 0..steps {
        run.advance().map_err(|error| Some(error.failure))?;
    }
    Ok(run.state())
}
