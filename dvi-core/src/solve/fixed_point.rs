//! A fixed point for the increment of a step.

use super::{Convergence, Due, Iteration, Stopping, repeat};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::state::Statistics;
use crate::{Real, System};

/// What corrects the increment.
struct FixedPoint<'a, S, T, F> {
    system: &'a S,
    q0: &'a [T],
    delta: &'a mut [T],
    change: &'a mut [T],
    weights: &'a mut [T],
    correct: F,
}

/// Corrects the increment `delta` of `q0` until corrections count no longer, in up to so many iterations;
/// without a criterion once, from zero. `correct` adds a correction, and returns its size by the weights that
/// it is given; what comes with `delta` is storage for the correction, and for the weights.
///
/// # Errors
/// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`], or that of a correction.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn solve_by_fixed_point<S: System, T: Real>(
    (system, q0): (&S, &[T]),
    [delta, change, weights]: [&mut [T]; 3],
    criterion: Option<(Stopping, usize)>,
    statistics: &mut Statistics,
    mut correct: impl FnMut([&mut [T]; 2], &[T], &mut Statistics) -> Result<T, StepFailure>,
) -> Result<(), StepFailure> {
    if let Some((stopping, budget)) = criterion {
        let iteration = FixedPoint { system, q0, delta: &mut *delta, change, weights, correct };
        repeat(Convergence::fixed_point(stopping, budget), statistics, iteration)?;
    } else {
        delta.fill(T::lift(0.0));
        correct([delta, change], weights, statistics)?;
    }
    norm::finite(delta)
}

impl<S, T, F> Iteration<T> for FixedPoint<'_, S, T, F>
where
    S: System,
    T: Real,
    F: FnMut([&mut [T]; 2], &[T], &mut Statistics) -> Result<T, StepFailure>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare(self.system, self.weights, self.q0, self.delta);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, statistics: &mut Statistics) -> Result<T, StepFailure> {
        (self.correct)([self.delta, self.change], self.weights, statistics)
    }
}
