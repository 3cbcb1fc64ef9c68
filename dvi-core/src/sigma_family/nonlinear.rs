//! Nonlinear one-forms.
//!
//! At σ = 0 the step is linear in Δ: (Dα)ᵀ(q0)Δ = h∇H(q0) − c0 and c1 = α(q0) − α(q1). Elsewhere it is
//! iterated: by Newton, or by Δ ← Δ + K⁻¹r(Δ) with K = σDα − (1−σ)(Dα)ᵀ frozen at the guess, which is
//! the fixed point of the affine case if α is affine.

use super::memory::{Work, fixed_point_matrix};
use super::newton::{self, Guess};
use super::{SigmaMemory, Step};
use crate::error::StepFailure;
use crate::norm;
use crate::solver::{Convergence, STEPS_BEFORE_RETRY, Solver, Verdict};
use crate::statistics::Statistics;
use crate::{DegenerateLagrangian, Real, Vector};

#[inline]
pub(super) fn step<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    memory.monitor.look(q)?;
    if step.method.sigma == T::lift(0.0) {
        one_solve(step, memory, q, statistics)?;
    } else {
        implicit(step, memory, q, statistics)?;
    }
    memory.monitor.steps += 1;
    Ok(())
}

/// 0 < σ ≤ 1.
#[inline]
fn implicit<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if memory.newton_steps > 0 || step.method.solver == Solver::Newton {
        by_newton(step, memory, q, statistics)?;
    } else if let Err(failure) = fixed_point(step, memory, q, statistics) {
        if step.method.solver == Solver::FixedPoint {
            return Err(failure);
        }
        memory.newton_steps = STEPS_BEFORE_RETRY;
        by_newton(step, memory, q, statistics)?;
    }
    finish(step, memory, q, statistics)
}

/// σ = 0.
#[inline]
fn one_solve<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, inverse, orientation, work, .. } = memory;
    let combination = fixed_point_matrix::<S, T>(step.method, step.h);
    step.system.hamiltonian_gradient(q, step.t, &mut work.gradient);
    statistics.gradients += 1;
    inverse.prepare(step.system, q, step.t, combination, &mut work.trial, statistics)?;
    for i in 0..q.len() {
        work.trial[i] = step.h * work.gradient[i] - defect[i];
    }
    inverse.solve(step.system, &work.trial, &mut work.increment);
    for i in 0..q.len() {
        work.next[i] = q[i] + work.increment[i];
    }
    norm::finite(&work.next)?;
    step.system.one_form(&work.next, step.t + step.h, &mut work.momentum);
    norm::finite(&work.momentum)?;
    orientation.check(step.system, &work.next, step.t + step.h)?;
    q.copy_from_slice(&work.next);
    for i in 0..q.len() {
        defect[i] = one_form[i] - work.momentum[i];
        one_form[i] = work.momentum[i];
    }
    Ok(())
}

/// The fixed point, from the extrapolated guess, in `work.increment`.
#[inline]
fn fixed_point<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, history, inverse, work, .. } = memory;
    let sigma = step.method.sigma;
    let (per_h, left_h) = (T::lift(1.0) / step.h, (T::lift(1.0) - sigma) * step.h);
    let combination = fixed_point_matrix::<S, T>(step.method, step.h);
    history.extrapolate(&mut work.increment);
    step.place(work, q, per_h);
    inverse.prepare(step.system, &work.point, step.node_time(), combination, &mut work.trial, statistics)?;
    let scale = norm::largest(q) + norm::largest(&work.increment);
    let mut convergence = Convergence::fixed_point(step.method.stopping, scale, q, step.budget(q.len()));
    let verdict = loop {
        let Work { point, velocity, gradient, momentum, trial, increment, .. } = work;
        step.system.gradient(point, velocity, step.node_time(), gradient, momentum);
        for i in 0..q.len() {
            // `velocity` has been used and `place` will set it again.
            velocity[i] = defect[i] + one_form[i] - momentum[i] + left_h * gradient[i];
        }
        inverse.solve(step.system, velocity, trial);
        for (delta, &correction) in increment.iter_mut().zip(trial.iter()) {
            *delta += correction;
        }
        let correction = norm::largest(trial);
        match convergence.judge(correction) {
            Verdict::Continue => step.place(work, q, per_h),
            verdict => break verdict,
        }
    };
    statistics.iterations += convergence.iterations as u64;
    statistics.gradients += convergence.iterations as u64;
    match verdict {
        Verdict::GiveUp => Err(convergence.failure()),
        _ => norm::finite(&work.increment),
    }
}

/// Newton from the extrapolated guess, and again without it where that fails.
#[inline]
fn by_newton<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    newton_from(Guess::Extrapolated, step, memory, q, statistics)
        .or_else(|_| newton_from(Guess::Zero, step, memory, q, statistics))?;
    memory.newton_steps = memory.newton_steps.saturating_sub(1);
    Ok(())
}

#[inline]
fn newton_from<S: DegenerateLagrangian, T: Real>(
    guess: Guess,
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, history, newton, work, .. } = memory;
    match guess {
        Guess::Extrapolated => history.extrapolate(&mut work.increment),
        Guess::Zero => work.increment.fill(T::lift(0.0)),
    }
    newton::solve(step, newton, work, q, defect, one_form, statistics)?;
    Ok(())
}

/// Moves to q1 = q0 + Δ and evaluates c1 = α(q_σ) + σh ∂L/∂q − α(q1).
#[inline]
fn finish<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, history, orientation, work, .. } = memory;
    step.place(work, q, T::lift(1.0) / step.h);
    let Work { point, velocity, gradient, momentum, trial, increment, next, .. } = work;
    step.system.gradient(point, velocity, step.node_time(), gradient, momentum);
    statistics.gradients += 1;
    for i in 0..q.len() {
        next[i] = q[i] + increment[i];
    }
    norm::finite(next)?;
    step.system.one_form(next, step.t + step.h, trial);
    let right_h = step.method.sigma * step.h;
    for i in 0..q.len() {
        momentum[i] += right_h * gradient[i] - trial[i];
    }
    norm::finite(momentum)?;
    orientation.check(step.system, next, step.t + step.h)?;
    q.copy_from_slice(next);
    defect.copy_from_slice(momentum);
    one_form.copy_from_slice(trial);
    history.push(increment);
    Ok(())
}
