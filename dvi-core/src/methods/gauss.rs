//! Gauss collocation on the equations of motion y' = X(y, t).
//!
//! Kᵢ = X(y + h Σⱼ aᵢⱼ Kⱼ, t + cᵢh),   y⁺ = y + h Σᵢ bᵢ Kᵢ,   c the zeros of the shifted Legendre polynomial
//! (Butcher 1964; Hairer, Lubich & Wanner 2006, section II.1.3). The stages are iterated as a fixed point
//! down to rounding errors, from the collocation polynomial of the last step, continued.

use core::fmt;

use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{EquationsOf, FirstOrder, Motion, PointOf};
use crate::methods::collocation::{Collocation, MOST};
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{Lagrangian, Real, Scalar, System, Vector};

/// Gauss collocation with `S` stages, 1 ≤ `S` ≤ 4, of order 2`S`, on the equations of motion y' = X(y, t).
///
/// ```math
/// K_i = X\Bigl(y + h \sum_j a_{ij} K_j,\ t + c_i h\Bigr), \qquad y^+ = y + h \sum_i b_i K_i
/// ```
///
/// Of a degenerate system y = q, and of a regular one y = (q, p). With `S` = 1 the method is the implicit midpoint rule.
///
/// It is symmetric. On Hamilton's equations of a regular system it preserves dq ∧ dp, and all momenta that are bilinear in q
/// and p. On q' = X(q) of a degenerate system it preserves Ω if α is affine, and then all quadratic momenta. The stages are found
/// by a fixed point, which contracts if h is small against the fastest time scale only:
/// [`StepFailure::NotConverged`] where it does not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gauss<const S: usize> {
    /// The criterion by which the stages count as converged. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<const S: usize> Gauss<S> {
    /// The method with default options. A number of stages other than 1, 2, 3 or 4 does not compile.
    pub fn new() -> Self {
        const { assert!(S >= 1 && S <= MOST, "Gauss collocation is available with 1, 2, 3 or 4 stages") };
        Self::default()
    }
}

/// The stages of a Gauss step, and those of the step before.
pub struct GaussMemory<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    equations: EquationsOf<S, T>,
    tableau: Collocation<STAGES>,
    continuation: [[f64; STAGES]; STAGES],
    /// Of the last completed step.
    completed: [PointOf<S, T>; STAGES],
    slopes: [PointOf<S, T>; STAGES],
    updated: [PointOf<S, T>; STAGES],
    /// Where the step begins, and where a stage is.
    y: PointOf<S, T>,
    stage: PointOf<S, T>,
}

impl<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> Memory<T> for GaussMemory<STAGES, S, T> {
    lasting!(T; part equations, parts completed);
}

impl<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> fmt::Debug for GaussMemory<STAGES, S, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GaussMemory").field("completed", &self.completed).finish_non_exhaustive()
    }
}

impl<const S: usize> Scheme for Gauss<S> {
    fn order(&self) -> usize {
        2 * S
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::OmegaIfAffine
    }
}

impl<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> Carries<S, T> for Gauss<STAGES> {
    type Memory = GaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>, T: Real> Method<S, T>
    for Gauss<STAGES>
{
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let mut equations = S::Kind::begin(system, q, v, t)?;
        let (points, tableau) = (|| core::array::from_fn(|_| S::Kind::point(system)), Collocation::gauss());
        let (mut y, mut completed): (_, [PointOf<S, T>; STAGES]) = (S::Kind::point(system), points());
        S::Kind::gather(&mut equations, q, &mut y);
        for slope in &mut completed {
            S::Kind::evaluate(&mut equations, system, &y, t, slope, &mut Statistics::default())
                .map_err(StartError::Starter)?;
        }
        Ok(GaussMemory {
            equations,
            tableau,
            continuation: tableau.continuation(),
            completed,
            slopes: points(),
            updated: points(),
            y,
            stage: S::Kind::point(system),
        })
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        S::Kind::gather(&mut memory.equations, q, &mut memory.y);
        memory.guess();
        let speed = memory.slopes.iter().fold(T::lift(0.0), |m: T, slope| m.max(norm::largest(&slope[0])));
        let GaussMemory { equations, y, .. } = &mut *memory;
        let speed = norm::larger(speed, S::Kind::cancelling(equations, system, y, t)?);
        let scale = norm::largest(q) + Scalar::abs(h) * speed;
        let convergence = Convergence::fixed_point(self.stopping, scale, q, self.stopping.max_iterations);
        iterate(convergence, statistics, |statistics| memory.iterate(system, t, h, statistics))?;
        if S::Kind::has_velocity_forces() {
            // Those of the last iteration belong to the velocities before it.
            memory.evaluate_part(1, system, t, h, statistics)?;
        }
        let GaussMemory { equations, tableau, slopes, completed, y, stage, .. } = memory;
        combine::<STAGES, S, T>(y, h, &tableau.b, slopes, stage);
        S::Kind::arrive(equations, system, stage, q, t + h)?;
        for (completed, slope) in completed.iter_mut().zip(slopes.iter()) {
            completed.restore(slope);
        }
        Ok(())
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        S::Kind::velocity(&memory.equations, system, q, t, v)
    }
}

impl<const STAGES: usize, S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>, T: Real> VariableStep<S, T>
    for Gauss<STAGES>
{
}

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> GaussMemory<STAGES, S, T> {
    /// Continues the polynomial through the completed stages into the next step.
    #[inline]
    fn guess(&mut self) {
        for (row, slope) in self.continuation.iter().zip(&mut self.slopes) {
            for (part, slope) in slope.iter_mut().enumerate() {
                for (n, slope) in slope.iter_mut().enumerate() {
                    let terms = row.iter().zip(&self.completed).map(|(&l, k)| T::lift(l) * k[part][n]);
                    *slope = terms.fold(T::lift(0.0), |sum, term| sum + term);
                }
            }
        }
    }

    /// Evaluates one part of the slopes of all stages; `updated` has those before.
    #[inline]
    fn evaluate_part(
        &mut self,
        part: usize,
        system: &S,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { equations, tableau, slopes, updated, y, stage, .. } = self;
        for i in 0..STAGES {
            combine::<STAGES, S, T>(y, h, &tableau.a[i], slopes, stage);
            let time = t + T::lift(tableau.c[i]) * h;
            let (from, to) = (&slopes[i], &mut updated[i][part]);
            S::Kind::evaluate_part(equations, system, part, stage, time, from, to, statistics)?;
        }
        for (slope, updated) in slopes.iter_mut().zip(updated.iter_mut()) {
            core::mem::swap(&mut slope[part], &mut updated[part]);
        }
        Ok(())
    }

    /// Evaluates all stages once, momenta before coordinates, and returns the largest change of h times a velocity: the
    /// momenta follow from the velocities.
    #[inline]
    fn iterate(&mut self, system: &S, t: T, h: T, statistics: &mut Statistics) -> Result<T, StepFailure> {
        for part in (0..self.y.len()).rev() {
            self.evaluate_part(part, system, t, h, statistics)?;
        }
        let Self { slopes, updated, .. } = self;
        let changes =
            slopes.iter().zip(updated.iter()).map(|(now, before)| norm::distance(&now[0], &before[0]));
        Ok(Scalar::abs(h) * changes.fold(T::lift(0.0), |m: T, change| m.max(change)))
    }
}

/// Sets `out` to y + h Σ wⱼ kⱼ.
#[inline(always)]
fn combine<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real>(
    y: &PointOf<S, T>,
    h: T,
    weights: &[f64; STAGES],
    slopes: &[PointOf<S, T>; STAGES],
    out: &mut PointOf<S, T>,
) {
    let factors: [T; STAGES] = weights.map(|weight| h * T::lift(weight));
    for (part, (out, y)) in out.iter_mut().zip(y.iter()).enumerate() {
        for (n, (out, &y)) in out.iter_mut().zip(y.iter()).enumerate() {
            *out = factors.iter().zip(slopes).fold(y, |sum, (&factor, k)| sum + factor * k[part][n]);
        }
    }
}
