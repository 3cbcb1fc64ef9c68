//! Newton's method for the increment of a step.

use super::{Due, Judge, repeat, sizes};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::{LinearEquations, LinearSolver, Sink, linear};
use crate::state::Statistics;
use crate::{Real, Scalar, System, Vector};

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

    /// How often L is linearised for that, and a matrix factored.
    fn cost(&self) -> [u64; 2] {
        [1, 1]
    }

    /// As [`residual`]. What another function sees has no place in registers: it may be a copy of `self`.
    ///
    /// # Errors
    /// As [`linearize`](Self::linearize).
    fn residual(&mut self, at: [&[T]; 3], storage: [&mut [T]; 2]) -> Result<T, StepFailure>
    where
        Self: Sized,
        T: Real,
    {
        residual(self, at, storage)
    }
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

/// The residual at an increment `delta` of `q0`, relative to what it is made of. No correction is left in
/// `correction`.
#[cold]
pub(crate) fn residual<T: Real>(
    equations: &mut impl Linearize<T>,
    [q0, p0, delta]: [&[T]; 3],
    [correction, sums]: [&mut [T]; 2],
) -> Result<T, StepFailure> {
    let size = |j: usize| Scalar::abs(q0[j]) + Scalar::abs(delta[j]);
    let mut at = AtIncrement { equations, p0, delta, statistics: &mut Statistics::default() };
    let residual = linear::residual(&mut at, size, |i| p0[i], [&mut *correction, sums]);
    correction.fill(T::lift(0.0));
    residual
}

/// Improves the increment `delta` of `q0` until `p0` + r = 0. What comes with `solver` is storage; there the
/// last correction is left, of which nothing has been left where the residual was asked for at last.
///
/// # Errors
/// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`], or those of the
/// equations.
#[inline]
pub(crate) fn solve_by_newton<S: System, T: Real, J: Judge<T>>(
    equations: &mut impl Linearize<T>,
    system: &S,
    [q0, p0]: [&[T]; 2],
    delta: &mut [T],
    (solver, [correction, weights]): (&mut impl LinearSolver<T>, [&mut Vector<S, T>; 2]),
    judge: J,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    repeat(
        judge,
        statistics,
        #[cfg_attr(not(debug_assertions), inline(always))]
        |due: &mut Due, statistics: &mut Statistics| {
            due.prepare(system, weights, q0, delta);
            let [linearizations, factorisations] = equations.cost();
            statistics.linearizations += linearizations;
            statistics.factorisations += factorisations;
            if *due == Due::Residual {
                return equations.residual([q0, p0, delta], [correction, weights]);
            }
            let mut at = AtIncrement { equations: &mut *equations, p0, delta, statistics };
            solver.solve(&mut at, weights, correction)?;
            Ok(sizes::reduce(system, weights, delta, correction))
        },
    )?;
    if J::NAMES { norm::finite(delta) } else { Ok(()) }
}
