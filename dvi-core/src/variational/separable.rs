//! L = ½ v·M v − V(q, t): the fixed point that needs forces only.
//!
//! r(q1) = p0 + D₁L_d = p0 + M(A q0 − K q1)/h + h Σ w b F(qʲ),     q1 ← q1 + (h/κ) M⁻¹r,   κ = S/(sin u/u)²
//! p1 = p0 + (D₁ + D₂)L_d = p0 + M((A − K) q0 + (C − K) q1)/h + h Σ w (b + b̄) F(qʲ)
//!
//! κ contains the oscillator of the fitted frequency, so that only what differs from it is iterated. Where no
//! node lies between the ends and the frequency does not depend on q1, r is linear in q1: with K in place of κ
//! the first iterate is the solution, and the step is explicit.

use super::coefficients::{Coefficients, Sums};
use super::memory::{Interpolation, Motion, VariationalMemory, Work};
use super::{Step, general};
use crate::basis::Basis;
use crate::error::StepFailure;
use crate::frequency::{FrequencyIn, Reading};
use crate::norm;
use crate::solver::{Convergence, STEPS_BEFORE_RETRY, Solver, Verdict};
use crate::statistics::Statistics;
use crate::{Real, RegularLagrangian, Scalar, Vector};

pub(super) fn step<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let by_newton = step.method.solver == Solver::Newton && !step.method.is_explicit();
    if by_newton || memory.motion.newton_steps > 0 {
        return general::step(step, memory, q, statistics);
    }
    match read_start(step, memory, q).and_then(|()| solve(step, memory, q, statistics)) {
        Ok(()) => finish(step, memory, q, statistics),
        Err(StepFailure::NotConverged { .. } | StepFailure::NotFinite { .. })
            if memory.motion.newton.is_some() =>
        {
            memory.motion.newton_steps = STEPS_BEFORE_RETRY;
            general::step(step, memory, q, statistics)
        }
        Err(failure) => Err(failure),
    }
}

/// The coefficients, as far as the start of the step decides them.
#[inline(always)]
fn read_start<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
) -> Result<(), StepFailure> {
    let VariationalMemory { interpolation, ends: [start, _], motion } = memory;
    let Some(reading) = step.method.frequency.reading() else { return interpolation.fix(step) };
    let Motion { p, force, mass: Some(mass), work, .. } = motion else { return Ok(()) };
    mass.solve(p, &mut work.velocity);
    start.evaluate(&step.method.frequency, mass, q, &work.velocity, force)?;
    if reading == Reading::LeftFrozen { interpolation.set(step, start.omega) } else { Ok(()) }
}

/// Δ, in `work.increment`.
#[inline(always)]
fn solve<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    memory.motion.guess(step);
    if step.method.is_explicit() {
        improve(step, memory, q, |sums| sums.mixed, statistics);
        return norm::finite(&memory.motion.work.increment);
    }
    let scale = norm::largest(q) + norm::largest(&memory.motion.work.increment);
    let mut convergence = Convergence::new(step.method.stopping, scale, step.budget(q.len()));
    let verdict = loop {
        if step.method.reads_both_ends() {
            read_both_ends(step, memory, q, statistics)?;
        }
        let correction = improve(step, memory, q, |sums| sums.stiffness, statistics);
        match convergence.judge(correction) {
            Verdict::Continue => {}
            verdict => break verdict,
        }
    };
    statistics.iterations += convergence.iterations as u64;
    match verdict {
        Verdict::GiveUp => Err(convergence.failure()),
        _ => norm::finite(&memory.motion.work.increment),
    }
}

/// Sets `work.next` to q1, `work.trial` to F(q1), and the coefficients to those for the mean of the
/// frequencies at both ends.
#[inline(always)]
fn read_both_ends<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let VariationalMemory { interpolation, ends: [start, end], motion } = memory;
    let Motion { force, mass: Some(mass), work, .. } = motion else { return Ok(()) };
    let (frequency, per_h) = (&step.method.frequency, T::lift(1.0) / step.h);
    for i in 0..q.len() {
        work.next[i] = q[i] + work.increment[i];
        work.velocity[i] = work.increment[i] * per_h;
    }
    step.system.force(&work.next, &[], step.node_time(1.0), &mut work.trial);
    statistics.gradients += 1;
    if F::OF_VELOCITY {
        start.evaluate(frequency, mass, q, &work.velocity, force)?;
    }
    end.evaluate(frequency, mass, &work.next, &work.velocity, &work.trial)?;
    interpolation.set(step, T::lift(0.5) * (start.omega + end.omega))
}

/// One iteration with M times the factor that `divisor` picks; returns the size of its correction.
#[inline(always)]
fn improve<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    divisor: impl Fn(Sums<T>) -> T,
    statistics: &mut Statistics,
) -> T {
    let motion = &mut memory.motion;
    match &memory.interpolation {
        Interpolation::Uniform(uniform) => improve_by(uniform, step, motion, q, divisor, statistics),
        Interpolation::Each(each) => improve_by(each, step, motion, q, divisor, statistics),
    }
}

#[inline(always)]
fn improve_by<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    coefficients: &impl Coefficients<T>,
    step: &Step<'_, S, F, T>,
    motion: &mut Motion<S, T>,
    q: &[T],
    divisor: impl Fn(Sums<T>) -> T,
    statistics: &mut Statistics,
) -> T {
    let Motion { p, force, mass: Some(mass), work, .. } = motion else { return T::lift(0.0) };
    let Work { increment, point, gradient, d1, velocity, .. } = work;
    d1.copy_from_slice(p);
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        let weight = step.h * coefficients.weight(node);
        if c == 1.0 {
            // b = 0
            continue;
        }
        let node_force: &[T] = if c == 0.0 {
            force
        } else {
            place(coefficients, node, q, increment, point);
            step.system.force(point, &[], step.node_time(c), gradient);
            statistics.gradients += 1;
            gradient
        };
        for i in 0..q.len() {
            d1[i] += weight * coefficients.basis(node, i).b * node_force[i];
        }
    }
    mass.solve(d1, velocity);
    let mut correction = T::lift(0.0);
    for i in 0..q.len() {
        let sums = coefficients.sums(i);
        let residual = step.h * velocity[i] + sums.left * q[i] - sums.mixed * increment[i];
        let change = residual / divisor(sums);
        increment[i] += change;
        correction = norm::larger(correction, Scalar::abs(change));
    }
    correction
}

/// Sets `point` to qʲ = b q0 + b̄ q1.
#[inline(always)]
fn place<T: Real>(
    coefficients: &impl Coefficients<T>,
    node: usize,
    q: &[T],
    increment: &[T],
    point: &mut [T],
) {
    for i in 0..q.len() {
        let Basis { b, b_bar, .. } = coefficients.basis(node, i);
        point[i] = (b + b_bar) * q[i] + b_bar * increment[i];
    }
}

/// Moves to q1 = q0 + Δ and evaluates p1.
#[inline(always)]
fn finish<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, S, F, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if step.method.reads_both_ends() {
        read_both_ends(step, memory, q, statistics)?;
    } else {
        let Work { next, increment, trial, .. } = &mut memory.motion.work;
        for i in 0..q.len() {
            next[i] = q[i] + increment[i];
        }
        step.system.force(next, &[], step.node_time(1.0), trial);
        statistics.gradients += 1;
    }
    let motion = &mut memory.motion;
    match &memory.interpolation {
        Interpolation::Uniform(uniform) => next_momentum(uniform, step, motion, q, statistics),
        Interpolation::Each(each) => next_momentum(each, step, motion, q, statistics),
    }
    let Motion { p, force, work, .. } = motion;
    norm::finite(&work.next).and(norm::finite(&work.d2)).and(norm::finite(&work.trial))?;
    q.copy_from_slice(&work.next);
    p.copy_from_slice(&work.d2);
    force.copy_from_slice(&work.trial);
    motion.remember(step.h);
    Ok(())
}

/// p1, in `work.d2`, from F(q0) in `force` and F(q1) in `work.trial`.
#[inline(always)]
fn next_momentum<S: RegularLagrangian, F: FrequencyIn<T>, T: Real>(
    coefficients: &impl Coefficients<T>,
    step: &Step<'_, S, F, T>,
    motion: &mut Motion<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) {
    let Motion { p, force, mass: Some(mass), work, .. } = motion else { return };
    let Work { increment, next, point, gradient, trial, d2, velocity, .. } = work;
    d2.copy_from_slice(p);
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        let weight = step.h * coefficients.weight(node);
        let node_force: &[T] = if c == 0.0 {
            force
        } else if c == 1.0 {
            trial
        } else {
            place(coefficients, node, q, increment, point);
            step.system.force(point, &[], step.node_time(c), gradient);
            statistics.gradients += 1;
            gradient
        };
        for i in 0..q.len() {
            let Basis { b, b_bar, .. } = coefficients.basis(node, i);
            d2[i] += weight * (b + b_bar) * node_force[i];
        }
    }
    if F::UNFITTED {
        return;
    }
    for i in 0..q.len() {
        let sums = coefficients.sums(i);
        velocity[i] = sums.left * q[i] + sums.right * next[i];
    }
    mass.multiply_add(T::lift(1.0) / step.h, velocity, d2);
}
