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
use crate::discrete::{Interval, frequency};
use crate::error::StepFailure;
use crate::methods::collocation::lobatto::{Lobatto, MOST};
use crate::space::elimination;
use core::ops::{Deref, DerefMut};

/// How many unknowns there are at most.
const UNKNOWNS: usize = MOST - 1;

/// The coefficients for the frequency and the length of a step.
#[derive(Debug)]
pub(super) struct Fit<const NODES: usize, T> {
    rule: Lobatto<NODES>,
    differentiation: [[f64; NODES]; NODES],
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

impl<const NODES: usize, T: Real> Fit<NODES, T> {
    /// Those of linear interpolation.
    pub(super) fn new() -> Self {
        let (rule, zero) = (Lobatto::new(), T::lift(0.0));
        let zeros = [[zero; NODES]; NODES];
        let mut new = Self {
            rule,
            differentiation: rule.differentiation(),
            u: zero,
            weights: rule.b.map(T::lift),
            point: zeros,
            velocity: zeros,
            left: [[zero; 2]; NODES],
            kinetic: zeros,
            inverse: zeros,
        };
        new.set(zero);
        new
    }

    /// Makes the coefficients those for `u` = ωh, if they are not.
    ///
    /// # Errors
    /// [`StepFailure::Resonance`] where there is no step, and [`StepFailure::Frequency`].
    pub(super) fn to(&mut self, u: T) -> Result<(), StepFailure> {
        if self.u == u {
            return Ok(());
        }
        let [sinc, cosine_sum] = self.set(u);
        let determined = frequency::determined(u, sinc, cosine_sum);
        if determined.is_err() {
            // Not the coefficients of any step.
            self.u = T::lift(f64::NAN);
        }
        determined
    }

    /// The same, and returns sin u/u and what multiplies the new point.
    fn set(&mut self, u: T) -> [T; 2] {
        let (zero, one, last, nodes) = (T::lift(0.0), T::lift(1.0), NODES - 1, Bases::new(u));
        self.u = u;
        for (j, &c) in self.rule.c.iter().enumerate() {
            let Basis { b, b_bar, d, d_bar } = nodes.basis(c, nodes.pairs(c));
            self.left[j] = [b, d];
            (self.point[j][0], self.velocity[j][0]) = (b + b_bar, d + d_bar);
            for k in 1..last {
                let slope = T::lift(self.differentiation[j][k]);
                (self.point[j][k], self.velocity[j][k]) = (if j == k { one } else { zero }, slope);
            }
            (self.point[j][last], self.velocity[j][last]) = (b_bar, d_bar);
        }
        for r in 0..NODES {
            self.kinetic[r] = core::array::from_fn(|k| self.sum(r, k, zero));
        }
        let sinc = nodes.whole.sinc;
        [sinc, self.invert().map_or(zero, |multiplier| multiplier * sinc * sinc)]
    }

    /// The time of node `j`.
    pub(super) fn time(&self, interval: Interval<T>, j: usize) -> T {
        interval.time(T::lift(self.rule.c[j]))
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
            elimination::solve(&matrix, &permutation, &mut column[..n]);
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
    use super::Fit;
    use crate::error::StepFailure;

    #[test]
    fn the_multiplier_of_the_new_point_is_that_of_the_exact_step() {
        // ∂²L_d/∂q0∂q1 of the exact discrete Lagrangian of the oscillator is −u/sin u.
        for u in [0.1_f64, 0.5, 1.0, 1.5] {
            let mut fit = Fit::<5, f64>::new();
            assert!(fit.to(u).is_ok(), "u = {u} is not resonant");
            let found = fit.invert().unwrap_or(f64::NAN);
            assert!((found - u / u.sin()).abs() < 1e-5 * u.powi(8), "u = {u}: {found}");
        }
    }

    #[test]
    fn half_periods_are_resonant() {
        let failure = |u| Fit::<4, f64>::new().to(u).err();
        let half_turn = failure(core::f64::consts::PI);
        assert!(matches!(half_turn, Some(StepFailure::Resonance { .. })), "{half_turn:?}");
        let undefined = failure(f64::NAN);
        assert!(
            matches!(undefined, Some(StepFailure::Frequency { omega }) if omega.is_nan()),
            "{undefined:?}"
        );
    }
}
