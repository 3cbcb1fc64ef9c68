//! How the points and velocities of the nodes depend on the unknowns of a step, and how it varies them.
//!
//! The unknowns are x₁ … x_{s−2} = δ of the interior nodes and x_{s−1} = Δ = q1 − q0; with x₀ = q0,
//!
//! qʲ = Σₖ φⱼₖ xₖ      h q̇ʲ = Σₖ ψⱼₖ xₖ      φⱼ₀ = b + b̄   φⱼₖ = δⱼₖ   φⱼ,ₛ₋₁ = b̄      (ψ likewise)
//!
//! The equations of a step are the derivatives of L_d in the directions (φ̂ⱼᵣ, ψ̂ⱼᵣ): that of δʳ for each
//! interior node, and that of q0, (b, B), for p0 + D₁L_d. Direction 0 moves both ends and gives (D₁ +
//! D₂)L_d.

use crate::Real;
use crate::discrete::basis::{Bases, Basis};
use crate::discrete::frequency;
use crate::discrete::{Interval, Rule};
use crate::error::StepFailure;
use crate::methods::collocation::lobatto::{Lobatto, MOST};
use crate::space::elimination;
use core::ops::{Deref, DerefMut};

/// How many unknowns there are at most.
const UNKNOWNS: usize = MOST - 1;

/// The coefficients for the frequency and the length of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit<const NODES: usize, T> {
    pub(super) rule: Lobatto<NODES>,
    differentiation: [[f64; NODES]; NODES],
    pub(super) coefficients: Coefficients<NODES, T>,
}

impl<const NODES: usize, T: Real> Fit<NODES, T> {
    /// Those of linear interpolation.
    pub(super) fn new() -> Self {
        let rule = Lobatto::new();
        let differentiation = rule.differentiation();
        let (coefficients, _) = Coefficients::at(&rule, &differentiation, T::lift(0.0));
        Self { rule, differentiation, coefficients }
    }

    /// Makes the coefficients those for `u` = ωh, if they are not.
    ///
    /// # Errors
    /// Those of [`Coefficients::new`].
    pub(super) fn to(&mut self, u: T) -> Result<(), StepFailure> {
        if self.coefficients.u != u {
            self.coefficients = Coefficients::new(&self.rule, &self.differentiation, u)?;
        }
        Ok(())
    }

    /// The time of node `j`.
    pub(super) fn time(&self, interval: Interval<T>, j: usize) -> T {
        interval.time(T::lift(self.rule.nodes()[j]))
    }
}

/// The coefficients for one frequency and step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<const NODES: usize, T> {
    /// ωh
    u: T,
    pub(super) weights: [T; NODES],
    /// φ
    pub(super) point: [[T; NODES]; NODES],
    /// ψ
    velocity: [[T; NODES]; NODES],
    /// b and B of each node.
    pub(super) left: [[T; 2]; NODES],
    /// Entry (r, k): Σⱼ wⱼ ψ̂ⱼᵣ ψⱼₖ, which M/h multiplies.
    pub(super) kinetic: [[T; NODES]; NODES],
    /// The inverse of Σⱼ wⱼ (ψ̂ⱼᵣ ψⱼₖ − u² φ̂ⱼᵣ φⱼₖ), r and k from 1.
    pub(super) inverse: [[T; NODES]; NODES],
}

impl<const NODES: usize, T: Real> Coefficients<NODES, T> {
    /// For u = ωh, where `a` is the matrix of `rule` that differentiates.
    ///
    /// # Errors
    /// [`StepFailure::Resonance`] where there is no step, and [`StepFailure::Frequency`].
    fn new(rule: &Lobatto<NODES>, a: &[[f64; NODES]; NODES], u: T) -> Result<Self, StepFailure> {
        let (new, [sinc, cosine_sum]) = Self::at(rule, a, u);
        frequency::determined(u, sinc, cosine_sum)?;
        Ok(new)
    }

    /// The same beside sin u/u and what multiplies the new point.
    fn at(rule: &Lobatto<NODES>, a: &[[f64; NODES]; NODES], u: T) -> (Self, [T; 2]) {
        let (zero, one, last) = (T::lift(0.0), T::lift(1.0), NODES - 1);
        let mut new = Self {
            u,
            weights: core::array::from_fn(|j| T::lift(rule.weights()[j])),
            point: [[zero; NODES]; NODES],
            velocity: [[zero; NODES]; NODES],
            left: [[zero; 2]; NODES],
            kinetic: [[zero; NODES]; NODES],
            inverse: [[zero; NODES]; NODES],
        };
        let nodes = Bases::new(u);
        for (j, &c) in rule.nodes().iter().enumerate().take(NODES) {
            let Basis { b, b_bar, d, d_bar } = nodes.basis(c, nodes.pairs(c));
            new.left[j] = [b, d];
            (new.point[j][0], new.velocity[j][0]) = (b + b_bar, d + d_bar);
            for k in 1..last {
                (new.point[j][k], new.velocity[j][k]) = (if j == k { one } else { zero }, T::lift(a[j][k]));
            }
            (new.point[j][last], new.velocity[j][last]) = (b_bar, d_bar);
        }
        for r in 0..NODES {
            new.kinetic[r] = core::array::from_fn(|k| new.sum(r, k, zero));
        }
        let sinc = nodes.sinc();
        let cosine_sum = new.invert().map_or(zero, |multiplier| multiplier * sinc * sinc);
        (new, [sinc, cosine_sum])
    }

    /// Sets `point` to qʲ of node `j`.
    pub(super) fn set_point<V: DerefMut<Target = [T]>>(&self, j: usize, x: &[V; NODES], point: &mut [T]) {
        for i in 0..point.len() {
            point[i] = weighted(&self.point[j], x, i);
        }
    }

    /// Sets `point` to qʲ of node `j` and `velocity` to q̇ʲ, in a step of length `h`.
    pub(super) fn place<V: DerefMut<Target = [T]>>(
        &self,
        j: usize,
        h: T,
        x: &[V; NODES],
        [point, velocity]: [&mut [T]; 2],
    ) {
        let per_h = T::lift(1.0) / h;
        self.set_point(j, x, point);
        for i in 0..point.len() {
            velocity[i] = per_h * weighted(&self.velocity[j], x, i);
        }
    }

    /// φ̂ and ψ̂ of direction `r` at node `j`, times the weight of the node.
    pub(super) fn weighted_direction(&self, j: usize, r: usize) -> [T; 2] {
        let direction = if r == NODES - 1 { self.left[j] } else { self.slopes(j, r) };
        direction.map(|along| self.weights[j] * along)
    }

    /// φ and ψ of unknown `k` at node `j`.
    pub(super) fn slopes(&self, j: usize, k: usize) -> [T; 2] {
        [self.point[j][k], self.velocity[j][k]]
    }

    /// Σⱼ wⱼ (ψ̂ⱼᵣ ψⱼₖ − z φ̂ⱼᵣ φⱼₖ)
    fn sum(&self, r: usize, k: usize, z: T) -> T {
        (0..NODES).fold(T::lift(0.0), |sum, j| {
            let ([left, left_dot], [right, right_dot]) = (self.weighted_direction(j, r), self.slopes(j, k));
            sum + left_dot * right_dot - z * left * right
        })
    }

    /// Sets `inverse`, and returns by what the equation for the new point multiplies it once the
    /// displacements are eliminated: without them S/(sin u/u)²; `None` if there is no inverse.
    fn invert(&mut self) -> Option<T> {
        let (zero, n) = (T::lift(0.0), NODES - 1);
        let (mut matrix, mut permutation) = ([zero; UNKNOWNS * UNKNOWNS], [0; UNKNOWNS]);
        for r in 0..n {
            for k in 0..n {
                matrix[r * n + k] = self.sum(r + 1, k + 1, self.u * self.u);
            }
        }
        let (matrix, permutation) = (&mut matrix[..n * n], &mut permutation[..n]);
        elimination::factor(matrix, permutation).ok()?;
        for k in 0..n {
            let mut column = [zero; UNKNOWNS];
            column[k] = T::lift(1.0);
            elimination::solve(matrix, permutation, &mut column[..n]);
            for r in 0..n {
                self.inverse[r + 1][k + 1] = column[r];
            }
        }
        // The Schur complement of the displacements is the reciprocal of the last entry of the inverse.
        Some(-T::lift(1.0) / self.inverse[n][n])
    }
}

/// Σₖ `row`ₖ xₖ of coordinate `i`.
pub(super) fn weighted<T: Real>(row: &[T], x: &[impl Deref<Target = [T]>], i: usize) -> T {
    row.iter().zip(x).fold(T::lift(0.0), |sum, (&factor, x)| sum + factor * x[i])
}

#[cfg(test)]
mod tests {
    use super::Coefficients;
    use crate::error::StepFailure;
    use crate::methods::collocation::lobatto::Lobatto;

    #[test]
    fn the_multiplier_of_the_new_point_is_that_of_the_exact_step() {
        // ∂²L_d/∂q0∂q1 of the exact discrete Lagrangian of the oscillator is −u/sin u.
        let rule = Lobatto::<5>::new();
        let a = rule.differentiation();
        for u in [0.1_f64, 0.5, 1.0, 1.5] {
            let Ok(mut coefficients) = Coefficients::<5, f64>::new(&rule, &a, u) else {
                panic!("u = {u} is not resonant")
            };
            let found = coefficients.invert().unwrap_or(f64::NAN);
            assert!((found - u / u.sin()).abs() < 1e-5 * u.powi(8), "u = {u}: {found}");
        }
    }

    #[test]
    fn half_periods_are_resonant() {
        let rule = Lobatto::<4>::new();
        let a = rule.differentiation();
        let failure = |u| Coefficients::<4, f64>::new(&rule, &a, u).err();
        let half_turn = failure(core::f64::consts::PI);
        assert!(matches!(half_turn, Some(StepFailure::Resonance { .. })), "{half_turn:?}");
        let undefined = failure(f64::NAN);
        assert!(
            matches!(undefined, Some(StepFailure::Frequency { omega }) if omega.is_nan()),
            "{undefined:?}"
        );
    }
}
