//! L = ½ v·M v − V(q, t) without a frequency: the fixed point over the positions of the [interior
//! nodes](super::interior).

use super::interior::{Departure, InteriorNodes};
use super::memory::{Path, Work};
use super::steps::Step;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, iterate};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Vector};

/// Of another L no step comes here, and none is solved.
const NOTHING_SOLVED: StepFailure =
    StepFailure::NotConverged { iterations: 0, correction: f64::NAN, tolerance: 0.0 };

/// The positions, and the increments that follow but for the second kick.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_point<const NODES: usize, S: NondegenerateLagrangian<T>, F, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    q: &[T],
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    let Path { phase, inertial, interior, work, .. } = path;
    let (Some(interior), Some(mass)) = (interior, inertial.constant()) else { return Err(NOTHING_SOLVED) };
    let departure = Departure { q, phase, mass, h: step.h };
    interior.depart(&departure);
    // The momentum is that of the forces before the last correction, whose size counts, and not that of the
    // next one alone.
    let stopping = step.method.stopping.exhaustive();
    let convergence = Convergence::fixed_point(stopping, budget);
    iterate(
        convergence,
        statistics,
        #[cfg_attr(not(debug_assertions), inline(always))]
        |due, statistics| Ok(interior.improve(step.system, &departure, step.t, due, statistics)),
    )?;
    let Work { unknowns, residuals, .. } = work;
    for k in 0..q.len() {
        [unknowns[NODES - 1][k], residuals[0][k]] = interior.increments(k);
    }
    norm::finite(&unknowns[NODES - 1])
}

/// The increment of the momentum where Newton's method has found the positions.
pub(super) fn settle<const NODES: usize, S: NondegenerateLagrangian<T>, F, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    let Path { interior, work: Work { unknowns, residuals, .. }, .. } = path;
    let Some(interior) = interior else { return Err(NOTHING_SOLVED) };
    interior.visit(step.system, unknowns, [step.t, step.h], statistics);
    for (k, sum) in residuals[0].iter_mut().enumerate() {
        [_, *sum] = interior.increments(k);
    }
    Ok(())
}

/// Moves to q1 = q0 + Δ and p1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn finish<const NODES: usize, S: NondegenerateLagrangian<T>, F, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    let Path { phase, interior, work, .. } = path;
    let Some(interior) = interior else { return Err(NOTHING_SOLVED) };
    let Work { unknowns, residuals, momentum, next, next_force, .. } = work;
    phase.reach(q, &unknowns[NODES - 1], next);
    step.system.force(next, &[], step.node_time(1.0), next_force);
    statistics.gradients += 1;
    let ends = phase.force.iter().zip(next_force.iter());
    for (sum, (&first, &last)) in residuals[0].iter_mut().zip(ends) {
        *sum = interior.end_impulse(step.h, first) + *sum + interior.end_impulse(step.h, last);
    }
    phase.kick(&residuals[0], momentum);
    path.complete(step.system, [step.h, step.node_time(1.0)], q)
}
