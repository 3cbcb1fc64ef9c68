//! Newton's method for several vectors of unknowns at once.

use super::{Due, Stopping, newton, sizes};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::{CoupledSolver, NodeSum, linear};
use crate::state::Statistics;
use crate::{Coupled, Real, System, Vector};

/// Equations rᵣ = 0 for the vectors from [`NodeSum::FIRST`] to `COUNT`, with their matrix as a sum over nodes.
pub(crate) trait CoupledEquations<const COUNT: usize, S: System, T: Real>: NodeSum<COUNT, T> {
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
}

/// Improves the unknowns that stand in `equations`, increments of `q`, until r = 0. What comes with `residuals` is
/// storage.
///
/// # Errors
/// [`StepFailure::NotConverged`], [`StepFailure::Singular`], [`StepFailure::NotFinite`], or those of the
/// equations.
pub(crate) fn solve_coupled<const COUNT: usize, S: System, T: Real, E: CoupledEquations<COUNT, S, T>>(
    equations: &mut E,
    (system, q): (&S, &[T]),
    solver: &mut Coupled<COUNT, S, T>,
    (residuals, [weights, sums]): (&mut [Vector<S, T>; COUNT], &mut [Vector<S, T>; 2]),
    stopping: Stopping,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    newton(stopping, statistics, |due, statistics| {
        due.prepare_all(system, weights, q, &mut equations.unknowns()[E::FIRST..]);
        equations.evaluate(residuals, statistics)?;
        residuals[E::FIRST..].iter().try_for_each(|residual| norm::finite(residual))?;
        statistics.linearizations += COUNT as u64;
        statistics.factorisations += 1;
        if *due == Due::Residual {
            return linear::residual_of_nodes(equations, weights, residuals, sums);
        }
        solver.solve(equations, weights, residuals)?;
        let mut correction = T::lift(0.0);
        for (unknown, change) in equations.unknowns().iter_mut().zip(&*residuals).skip(E::FIRST) {
            correction = norm::larger(correction, sizes::reduce(system, weights, unknown, change));
        }
        Ok(correction)
    })?;
    equations.unknowns()[E::FIRST..].iter().try_for_each(|unknown| norm::finite(unknown))
}
