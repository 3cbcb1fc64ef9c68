//! Affine one-forms: α(q_σ) − α(q0) = σDαΔ with one constant matrix Dα, so that a step is
//!
//! KΔ = c0 − (1−σ)h∇H(q_σ)        K  = σDα − (1−σ)(Dα)ᵀ
//! c1 = K'Δ − σh∇H(q_σ)           K' = σ(Dα)ᵀ − (1−σ)Dα
//!
//! At σ = 0 and σ = 1 no gradient of the unknown point occurs: explicit. At σ = ½, K' = −K and c1 = −c0;
//! with c0 = 0 the scheme is the implicit midpoint rule.

use super::leapfrog;
use super::newton::{self, Guess};
use super::{SigmaMemory, Step};
use crate::error::StepFailure;
use crate::method::Clock;
use crate::norm;
use crate::solver::{Convergence, STEPS_BEFORE_RETRY, Solver, Verdict};
use crate::space::scratch;
use crate::statistics::Statistics;
use crate::{DegenerateLagrangian, Real, Vector};

#[inline(always)]
pub(super) fn step<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if step.method.sigma == T::lift(0.0) {
        let (taken, result) = leapfrog::steps(step.system, memory, q, Clock::new(step.t, step.h), 1);
        statistics.gradients += taken;
        return result;
    }
    memory.monitor.look(q)?;
    if step.method.sigma == T::lift(1.0) {
        explicit_right(step, memory, q, statistics)?;
    } else {
        implicit(step, memory, q, statistics)?;
    }
    memory.monitor.steps += 1;
    Ok(())
}

/// σ = 1: DαΔ = c0, c1 = (Dα)ᵀΔ − h∇H(q1).
#[inline(never)]
fn explicit_right<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, inverse, product, work, .. } = memory;
    scratch!(delta = step.system, work.increment);
    scratch!(next = step.system, work.next);
    scratch!(gradient = step.system, work.gradient);
    inverse.solve(step.system, defect, delta);
    add(q, delta, next);
    step.system.hamiltonian_gradient(next, step.t + step.h, gradient);
    statistics.gradients += 1;
    norm::finite(next)?;
    // A collision at the new point shows in the gradient.
    norm::finite(gradient)?;
    q.copy_from_slice(next);
    if let Some(product) = product {
        product.apply(step.system, delta, defect);
    }
    for (c, &g) in defect.iter_mut().zip(gradient.iter()) {
        *c -= step.h * g;
    }
    Ok(())
}

#[inline(always)]
pub(super) fn add<T: Real>(q: &[T], increment: &[T], sum: &mut [T]) {
    for ((sum, &q), &delta) in sum.iter_mut().zip(q).zip(increment) {
        *sum = q + delta;
    }
}

/// Adds the increment to `q` if the result is finite.
#[inline(always)]
fn advance<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    q: &mut Vector<S, T>,
    increment: &[T],
    storage: &mut Vector<S, T>,
) -> Result<(), StepFailure> {
    scratch!(next = step.system, *storage);
    add(q, increment, next);
    norm::finite(next)?;
    q.copy_from_slice(next);
    Ok(())
}

/// Kept out of line, so that the explicit step does not set up a frame for it.
#[inline(never)]
fn implicit<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if !memory.defect_vanishes {
        memory.shift_by_defect(step.system);
    }
    if memory.newton_steps > 0 || step.method.solver == Solver::Newton {
        by_newton(step, memory, q, statistics)?;
    } else if let Err(failure) = fixed_point(step, memory, q, statistics) {
        if step.method.solver == Solver::FixedPoint {
            return Err(failure);
        }
        memory.newton_steps = STEPS_BEFORE_RETRY;
        by_newton(step, memory, q, statistics)?;
    }
    finish(step, memory, q)
}

/// s ← −(1−σ)h K⁻¹∇H(q0 + σK⁻¹c0 + σs).
#[inline(always)]
fn fixed_point<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { history, inverse, work, defect_vanishes, .. } = memory;
    let (sigma, node_time) = (step.method.sigma, step.node_time());
    scratch!(increment = step.system, work.velocity);
    scratch!(trial = step.system, work.trial);
    scratch!(point = step.system, work.point);
    scratch!(gradient = step.system, work.momentum);
    history.extrapolate(increment);
    let mut scale = norm::largest(q) + norm::largest(increment);
    // Where the iteration would be without s.
    let origin = if *defect_vanishes {
        q
    } else {
        for ((next, &q), &shift) in work.next.iter_mut().zip(q.iter()).zip(work.shift.iter()) {
            *next = q + sigma * shift;
        }
        scale += norm::largest(&work.shift);
        &work.next
    };
    let mut convergence = Convergence::fixed_point(step.method.stopping, scale, q, step.budget(q.len()));
    let verdict = loop {
        for ((point, &origin), &s) in point.iter_mut().zip(origin.iter()).zip(increment.iter()) {
            *point = origin + sigma * s;
        }
        step.system.hamiltonian_gradient(point, node_time, gradient);
        inverse.solve(step.system, gradient, trial);
        let correction = norm::distance(trial, increment);
        increment.copy_from_slice(trial);
        match convergence.judge(correction) {
            Verdict::Continue => {}
            verdict => break verdict,
        }
    };
    statistics.iterations += convergence.iterations as u64;
    statistics.gradients += convergence.iterations as u64;
    if verdict == Verdict::GiveUp {
        return Err(convergence.failure());
    }
    work.increment.copy_from_slice(increment);
    work.gradient.copy_from_slice(gradient);
    norm::finite(increment)
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

/// Solves for Δ by Newton and leaves s and ∇H(q_σ) as the fixed point does.
#[inline]
fn newton_from<S: DegenerateLagrangian, T: Real>(
    guess: Guess,
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, defect_vanishes, one_form, history, newton, work, .. } = memory;
    match guess {
        Guess::Extrapolated => history.extrapolate(&mut work.increment),
        Guess::Zero => work.increment.fill(T::lift(0.0)),
    }
    if !*defect_vanishes {
        for (delta, &shift) in work.increment.iter_mut().zip(work.shift.iter()) {
            *delta += shift;
        }
    }
    step.system.one_form(q, step.t, one_form);
    newton::solve(step, newton, work, q, defect, one_form, statistics)?;
    if !step.method.is_midpoint() {
        for i in 0..q.len() {
            work.point[i] = q[i] + step.method.sigma * work.increment[i];
        }
        step.system.hamiltonian_gradient(&work.point, step.node_time(), &mut work.gradient);
        statistics.gradients += 1;
    }
    if !*defect_vanishes {
        for (delta, &shift) in work.increment.iter_mut().zip(work.shift.iter()) {
            *delta -= shift;
        }
    }
    Ok(())
}

/// Moves to q1 = q0 + K⁻¹c0 + s and updates the defect.
#[inline(always)]
fn finish<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, history, product, work, defect_vanishes, .. } = memory;
    if *defect_vanishes {
        advance(step, q, &work.increment, &mut work.next)?;
        history.push(&work.increment);
        return Ok(());
    }
    for ((delta, &s), &shift) in work.trial.iter_mut().zip(work.increment.iter()).zip(work.shift.iter()) {
        *delta = shift + s;
    }
    advance(step, q, &work.trial, &mut work.next)?;
    history.push(&work.increment);
    match product {
        None => defect.iter_mut().for_each(|c| *c = -*c),
        Some(product) => {
            product.apply(step.system, &work.trial, defect);
            let right = step.method.sigma * step.h;
            for (c, &g) in defect.iter_mut().zip(work.gradient.iter()) {
                *c -= right * g;
            }
        }
    }
    Ok(())
}
