//! A chain of molecules of three atoms in the plane, rigid or with springs.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, TAU};

use dvi_core::error::StartError;
use dvi_core::prelude::*;

/// n rigid triangles in a row. The atoms 3m, 3m + 1 and 3m + 2 of molecule m have mass 1 and are joined by
/// rods of length 1. The last two of a molecule face the first two of the next one: each of these four pairs
/// has the potential (1 − e^{−β(r − r₀)})² of Morse, with r₀ = 1 or √2, so that at rest the four are the
/// corners of a square.
#[lagrangian(
    coordinates(x[3 * n], y[3 * n]),
    lagrangian = sum(0..3 * n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0
        - sum(0..n - 1, |m| sum(0..2, |a| {
            let side = ((x[3 * m + 3 + a] - x[3 * m + 1 + a]).powi(2) + (y[3 * m + 3 + a] - y[3 * m + 1 + a]).powi(2)).sqrt();
            let diagonal = ((x[3 * m + 4 - a] - x[3 * m + 1 + a]).powi(2) + (y[3 * m + 4 - a] - y[3 * m + 1 + a]).powi(2)).sqrt();
            (1.0 - (-beta * (side - 1.0)).exp()).powi(2) + (1.0 - (-beta * (diagonal - 2.0_f64.sqrt())).exp()).powi(2)
        })),
    constraint(m in 0..n) = (x[3 * m + 1] - x[3 * m]).powi(2) + (y[3 * m + 1] - y[3 * m]).powi(2) - 1.0,
    constraint(m in 0..n) = (x[3 * m + 2] - x[3 * m + 1]).powi(2) + (y[3 * m + 2] - y[3 * m + 1]).powi(2) - 1.0,
    constraint(m in 0..n) = (x[3 * m] - x[3 * m + 2]).powi(2) + (y[3 * m] - y[3 * m + 2]).powi(2) - 1.0,
    momenta(
        along = sum(0..3 * n, |i| dot(x[i])),
        across = sum(0..3 * n, |i| dot(y[i])),
        angular = sum(0..3 * n, |i| x[i] * dot(y[i]) - y[i] * dot(x[i])),
    ),
)]
#[derive(Clone, Debug)]
pub struct RigidMolecules {
    /// How many molecules there are.
    pub n: usize,
    /// β
    pub beta: f64,
}

/// The same molecules with springs of the stiffness `k` in place of the rods.
#[lagrangian(
    coordinates(x[3 * n], y[3 * n]),
    lagrangian = sum(0..3 * n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0
        - sum(0..n - 1, |m| sum(0..2, |a| {
            let side = ((x[3 * m + 3 + a] - x[3 * m + 1 + a]).powi(2) + (y[3 * m + 3 + a] - y[3 * m + 1 + a]).powi(2)).sqrt();
            let diagonal = ((x[3 * m + 4 - a] - x[3 * m + 1 + a]).powi(2) + (y[3 * m + 4 - a] - y[3 * m + 1 + a]).powi(2)).sqrt();
            (1.0 - (-beta * (side - 1.0)).exp()).powi(2) + (1.0 - (-beta * (diagonal - 2.0_f64.sqrt())).exp()).powi(2)
        }))
        - k / 2.0 * sum(0..n, |m| sum(0..3, |a| {
            let r2 = (x[3 * m + (a + 1) % 3] - x[3 * m + a]).powi(2) + (y[3 * m + (a + 1) % 3] - y[3 * m + a]).powi(2);
            (r2.sqrt() - 1.0).powi(2)
        })),
    momenta(
        along = sum(0..3 * n, |i| dot(x[i])),
        across = sum(0..3 * n, |i| dot(y[i])),
        angular = sum(0..3 * n, |i| x[i] * dot(y[i]) - y[i] * dot(x[i])),
    ),
)]
#[derive(Clone, Debug)]
pub struct SpringMolecules {
    /// How many molecules there are.
    pub n: usize,
    /// β
    pub beta: f64,
    /// The force of a spring over the change of its length.
    pub k: f64,
}

impl RigidMolecules {
    /// The straight chain, in which every other molecule is upside down, with velocities that are sines of
    /// the square of the number of the atom, of magnitude `speed` and then made those of rigid molecules.
    ///
    /// # Errors
    /// Those of [`projected`](dvi_core::mechanics::OnConstraints::projected).
    pub fn chain(&self, speed: f64) -> Result<RigidMoleculesState, StartError> {
        let (mut x, mut y, mut dot_x, mut dot_y) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let radius = 1.0 / 3.0_f64.sqrt();
        let apart = 1.0 + radius;
        for m in 0..self.n {
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            let along = (m as f64 - 0.5 * (self.n as f64 - 1.0)) * apart * FRAC_PI_6.cos();
            for a in 0..3 {
                let angle = FRAC_PI_2 + (1.0 - f64::from(a)) * TAU / 3.0;
                x.push(along + radius * angle.cos());
                y.push(sign * (radius * angle.sin() - 0.25 * apart));
                let square = (x.len() * x.len()) as f64;
                dot_x.push(speed * (2.1 * square).sin());
                dot_y.push(speed * (1.7 * square).cos());
            }
        }
        self.projected(0.0, &RigidMoleculesState { x, y, dot_x, dot_y })
    }
}

impl From<RigidMoleculesState> for SpringMoleculesState {
    fn from(RigidMoleculesState { x, y, dot_x, dot_y }: RigidMoleculesState) -> Self {
        Self { x, y, dot_x, dot_y }
    }
}
