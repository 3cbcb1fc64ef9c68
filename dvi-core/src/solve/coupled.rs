//! Newton's method for several vectors of unknowns at once.

use super::{Convergence, Due, Judge, Stopping, repeat, sizes};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::{CoupledSolver, NodeSum, linear};
use crate::state::Statistics;
use crate::{Coupled, Real, System, Vector};

/// Equations rᵣ = 0 for the vectors from [`NodeSum::FIRST`] to `COUNT`, with their matrix as a sum over
/// nodes.
pub(crate) trait CoupledEquations<const COUNT: usize, S: System, T: Real>: NodeSum<COUNT, T> {
    /// How many iterations bring one more order of derivatives, where numbers carry them: one, if the matrix
    /// is exact.
    const PER_ORDER: usize = 1;

    /// The vectors, with those before the first unknown one.
    fn unknowns(&mut self) -> &mut [Vector<S, T>; COUNT];

    /// Sets `residuals` to r at the unknowns, which is also where the matrix is asked for next.
    ///
    /// # Errors
    /// Those of what r is computed from; not that r is no number.
    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; COUNT],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;

    /// Takes the corrections from the unknowns, and returns the size of the largest.
    ///
    /// # Errors
    /// Those of what leads too far.
    fn correct(
        &mut self,
        system: &S,
        weights: &[T],
        corrections: &[Vector<S, T>; COUNT],
    ) -> Result<T, StepFailure> {
        let unknowns = self.unknowns().iter_mut().zip(corrections).skip(Self::FIRST);
        Ok(unknowns.fold(T::lift(0.0), |largest, (unknown, change)| {
            norm::larger(largest, sizes::reduce(system, weights, unknown, change))
        }))
    }
}

/// Room for the residuals, and for weights and sums.
type Storage<'a, const COUNT: usize, S, T> = (&'a mut [Vector<S, T>; COUNT], &'a mut [Vector<S, T>; 2]);

/// Improves the unknowns that stand in `equations`, increments of `q`, until r = 0. What comes with
/// `residuals` is storage.
///
/// # Errors
/// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`], or those of the
/// equations.
pub(crate) fn solve_coupled<const COUNT: usize, S: System, T: Real, E: CoupledEquations<COUNT, S, T>>(
    equations: &mut E,
    (system, q): (&S, &[T]),
    solver: &mut Coupled<COUNT, S, T>,
    (residuals, [weights, sums]): Storage<'_, COUNT, S, T>,
    stopping: Stopping,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let mut convergence = Convergence::new(stopping, stopping.max_iterations);
    convergence.course().more *= E::PER_ORDER;
    repeat(convergence, statistics, |due: &mut Due, statistics: &mut Statistics| {
        due.prepare_all(system, weights, q, &mut equations.unknowns()[E::FIRST..]);
        equations.evaluate(residuals, statistics)?;
        residuals[E::FIRST..].iter().try_for_each(|residual| norm::finite(residual))?;
        statistics.linearizations += COUNT as u64;
        statistics.factorisations += 1;
        if *due == Due::Residual {
            return linear::residual_of_nodes(equations, weights, residuals, sums);
        }
        solver.solve(equations, weights, residuals)?;
        equations.correct(system, weights, residuals)
    })?;
    equations.unknowns()[E::FIRST..].iter().try_for_each(|unknown| norm::finite(unknown))
}
