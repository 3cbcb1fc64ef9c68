//! Newton's method for the increment of a step.

use super::{Due, Stopping, newton, sizes};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::{LinearEquations, LinearSolver, Sink, linear};
use crate::state::Statistics;
use crate::{Linear, Real, Scalar, System, Vector};

/// Equations p0 + r(Δ) = 0.
pub(crate) trait Linearize<T> {
    /// Adds r to `r` and ∂r/∂Δ to `sink`.
    ///
    /// # Errors
    /// Those of what they are computed from.
    fn linearize<K: Sink<T>>(
        &mut self,
        delta: &[T],
        r: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;
}

/// Equations at an increment, whose solution is to be taken from it.
pub(crate) struct AtIncrement<'a, T, E> {
    pub(crate) equations: &'a mut E,
    pub(crate) p0: &'a [T],
    pub(crate) delta: &'a [T],
    pub(crate) statistics: &'a mut Statistics,
}

impl<T: Real, E: Linearize<T>> LinearEquations<T> for AtIncrement<'_, T, E> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        b.copy_from_slice(self.p0);
        self.equations.linearize(self.delta, b, sink, self.statistics)
    }
}

/// Improves the increment `delta` of `q0` until `p0` + r = 0. What comes with `solver` is storage.
///
/// # Errors
/// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`], or those of the
/// equations.
#[inline]
pub(crate) fn solve_by_newton<S: System, T: Real>(
    equations: &mut impl Linearize<T>,
    system: &S,
    [q0, p0]: [&[T]; 2],
    delta: &mut [T],
    (solver, [residual, weights]): (&mut Linear<S, T>, [&mut Vector<S, T>; 2]),
    stopping: Stopping,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    newton(stopping, statistics, |due, statistics| {
        due.prepare(system, weights, q0, delta);
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        let mut at = AtIncrement { equations, p0, delta, statistics };
        if *due == Due::Residual {
            let size = |j: usize| Scalar::abs(q0[j]) + Scalar::abs(at.delta[j]);
            return linear::residual(&mut at, size, |i| p0[i], [residual, weights]);
        }
        solver.solve(&mut at, weights, residual)?;
        Ok(sizes::reduce(system, weights, delta, residual))
    })?;
    norm::finite(delta)
}
