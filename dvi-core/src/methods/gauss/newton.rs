//! Steps of Gauss collocation by Newton's method.

use core::ops::Deref;

use super::memory::Path;
use crate::discrete::NodeWork;
use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{FirstOrder, StageWork, weigh};
use crate::methods::collocation::stages::{Departure, NewtonStages};
use crate::scalar::Lanes;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::passes::multiply;
use crate::solve::{Guess, Solver, Stopping};
use crate::state::Statistics;
use crate::{Coupled, Lagrangian, Real, System, Vector};

/// A matrix of fixed size is made on the stack, where threads have two megabytes, and without optimisation
/// in some copies.
const MOST_BYTES: usize = 1 << 17;

/// How a run is solved.
///
/// # Errors
/// [`StartError::Unsupported`] where Newton's method is asked for, and its matrix is too large for the
/// stack.
pub(super) fn solver<const STAGES: usize, S: System, T: Real>(solver: Solver) -> Result<Solver, StartError> {
    match solver {
        Solver::FixedPoint => {}
        Solver::Automatic if S::FAST_SUM => return Ok(Solver::FixedPoint),
        _ if size_of::<Coupled<STAGES, S, T>>() <= MOST_BYTES => {}
        Solver::Automatic => return Ok(Solver::FixedPoint),
        Solver::Newton | Solver::NewtonKrylov => {
            let reason = "its matrix for so many stages and coordinates takes too much of the stack; take \
                          Solver::FixedPoint, fewer stages, or an array of coordinates whose length is \
                          known at run time";
            return Err(StartError::Unsupported { option: "Newton's method", reason });
        }
    }
    Ok(solver.in_numbers::<T>())
}

/// Finds the slopes and terms of the step from `q`.
pub(super) fn solve<const STAGES: usize, S, T: Real>(
    newton: &mut NewtonStages<STAGES, S, T>,
    system: &S,
    path: &mut Path<STAGES, S, T>,
    (q, [t, h]): (&Vector<S, T>, [T; 2]),
    guess: Guess,
    stopping: Stopping,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    S::Kind::gather(&mut path.equations, q, &mut path.y);
    path.guess(guess, h);
    match guess {
        Guess::Extrapolated => path.set_velocities(),
        Guess::Zero => path.slopes[0].fill(Lanes::all(T::lift(0.0))),
    }
    for (stage, increment) in newton.increments.iter_mut().enumerate() {
        read_lane(stage, &path.slopes[0], increment);
        multiply(increment, h);
    }
    let Path { equations, coefficients, slopes, terms, y, rest, work, .. } = path;
    let StageWork { point, slope, .. } = work;
    let from = Departure { q: [part(y, 0), part(rest, 0)], p: [part(y, 1), part(rest, 1)], t, h };
    let take = |stage, time, node: &NodeWork<S, T>, force: &[T], statistics: &mut Statistics| {
        let NodeWork { point: place, velocity, momentum, .. } = node;
        for (slopes, slope) in slopes.iter_mut().zip([velocity, force]) {
            write_lane(stage, slope, slopes);
        }
        for (point, numbers) in point.iter_mut().zip([place, momentum]) {
            point.copy_from_slice(numbers);
        }
        S::Kind::compare(equations, system, point, time)?;
        // The velocity of the last stage leads to that at the end of the step.
        if S::Kind::HAS_VELOCITY_FORCES && stage + 1 == STAGES {
            slope[0].copy_from_slice(velocity);
            S::Kind::evaluate_part(equations, system, 0, point, time, slope, statistics)?;
        }
        Ok(())
    };
    let solved = newton.solve::<S::Kind>(system, from, (guess, stopping), statistics, take);
    solved.map_err(|failure| failure.of(StepFailure::STAGES))?;
    let weights = Lanes::all(h) * coefficients.b;
    for (slopes, terms) in slopes.iter().zip(terms.iter_mut()) {
        weigh(weights, slopes, terms);
    }
    Ok(())
}

/// q, or p where there are momenta.
fn part<V: Deref<Target = [T]>, T>(point: &[V], part: usize) -> &[T] {
    point.get(part).map_or(&[], |vector| vector)
}
