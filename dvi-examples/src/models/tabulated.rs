//! The guiding centre of [`TokamakInClass`](super::TokamakInClass) in a field that is known from a table
//! only.
//!
//! A computed equilibrium comes as numbers on a grid. The five functions of the section (r, θ) that the
//! Lagrangian needs, A_θ, A_φ, b_θ, b_φ and |B|, become splines, periodic in θ. They need not be consistent
//! with one another for a scheme to be variational: the splines are the Lagrangian.

use core::f64::consts::TAU;

use anyhow::Result;
use dvi_core::field::{Axis, ScalarField};
use dvi_core::prelude::*;

/// In class, as α has components along θ and φ only.
#[degenerate_lagrangian(
    coordinates(r, theta, phi, u),
    one_form    = (a_theta(r, theta) + u * b_theta(r, theta)) * d(theta)
        + (a_phi(r, theta) + u * b_phi(r, theta)) * d(phi),
    hamiltonian = u * u / 2.0 + mu * strength(r, theta),
)]
#[derive(Clone, Debug)]
pub struct TabulatedTokamak<F> {
    /// The covariant components of the vector potential.
    pub a_theta: F,
    /// The other of them.
    pub a_phi: F,
    /// Those of the direction of the field.
    pub b_theta: F,
    /// The other of them.
    pub b_phi: F,
    /// The strength of the field.
    pub strength: F,
    /// The magnetic moment.
    pub mu: f64,
}

/// The part of the section that the table covers, from r = 0.06 to 0.3.
const SECTION: [f64; 2] = [0.06, 0.3];

/// A function of the section.
pub type Sampled<'a> = &'a dyn Fn([f64; 2]) -> f64;

impl<F: ScalarField<2>> TabulatedTokamak<F> {
    /// The field with the safety factor `q` on a grid of `n` intervals across the section and 4 `n` around
    /// it, which `spline` makes functions of.
    ///
    /// # Errors
    /// Those of `spline`, and grids that are too small.
    pub fn sampled(
        q: f64,
        mu: f64,
        n: usize,
        spline: impl Fn([Axis; 2], Sampled<'_>) -> Result<F>,
    ) -> Result<Self> {
        let around: Vec<f64> = (0..4 * n).map(|i| i as f64 * TAU / (4 * n) as f64).collect();
        let axes = [Axis::uniform(SECTION, n + 1)?, Axis::periodic(&around, TAU)?];
        let major = |[r, theta]: [f64; 2]| 1.0 + r * theta.cos();
        let toroidal = |at| 2.0 - major(at);
        let poloidal = |at: [f64; 2]| at[0] / (q * major(at));
        let strength = |at| toroidal(at).hypot(poloidal(at));
        let sampled = |function: Sampled<'_>| spline(axes.clone(), function);
        Ok(Self {
            a_theta: sampled(&|at| at[0].powi(2) / 2.0 * (5.0 - 2.0 * major(at)) / 3.0)?,
            a_phi: sampled(&|[r, _]| -r * r / (2.0 * q))?,
            b_theta: sampled(&|at| at[0] * poloidal(at) / strength(at))?,
            b_phi: sampled(&|at| major(at) * toroidal(at) / strength(at))?,
            strength: sampled(&strength)?,
            mu,
        })
    }
}
