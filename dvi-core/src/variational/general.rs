//! Any L, and any frequency: derivatives of L at every node.
//!
//! r(q1) = p0 + D₁L_d      D₁L_d = Σ w (h b ∂L/∂q + B ∂L/∂v)      D₂L_d = Σ w (h b̄ ∂L/∂q + B̄ ∂L/∂v)
//! ∂r/∂q1 = D₁D₂L_d = Σ w (h b b̄ L_qq + b B̄ L_qv + B b̄ L_vq + B B̄ L_vv/h)
//!
//! solved by Newton. With a variational frequency, L_d = ℓ(q0, q1, ω(q0, q1)) and
//! D₁L_d = ∂ℓ/∂q0 + ∂ℓ/∂ω ∂ω/∂q0: the residual is exact, and the matrix is that of ω held constant, which is
//! close enough for the iteration to contract.

use super::Step;
use super::coefficients::{Adjustable, Coefficients};
use super::memory::{Interpolation, Motion, VariationalMemory, Work};
use crate::basis::Basis;
use crate::error::StepFailure;
use crate::frequency::{Frequency, FrequencyIn, Reading};
use crate::quadrature::Rule;
use crate::solver::{Convergence, Verdict};
use crate::statistics::Statistics;
use crate::{Matrix, Real, RegularLagrangian, Vector, Weights, elimination, norm};

pub(super) fn step<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    memory.motion.guess(step.h, &mut memory.work.increment);
    if let Err(failure) = solve(step, memory, q, statistics) {
        if memory.motion.newton.is_none() {
            return Err(failure);
        }
        memory.work.increment.fill(T::lift(0.0));
        solve(step, memory, q, statistics)?;
    }
    finish(step, memory, q, statistics)
}

/// Δ, in `work.increment`.
fn solve<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let stopping = step.method.stopping;
    let scale = norm::largest(q) + norm::largest(&memory.work.increment);
    let mut convergence = Convergence::new(stopping, scale, q, stopping.max_iterations);
    let verdict = loop {
        differentiate(step, memory, q, statistics)?;
        correct(step, memory, q, statistics)?;
        let Work { increment, trial, .. } = &mut memory.work;
        for (delta, &correction) in increment.iter_mut().zip(trial.iter()) {
            *delta -= correction;
        }
        match convergence.judge(norm::largest(trial)) {
            Verdict::Continue => {}
            verdict => break verdict,
        }
    };
    statistics.iterations += convergence.iterations as u64;
    memory.motion.newton_steps = memory.motion.newton_steps.saturating_sub(1);
    match verdict {
        Verdict::GiveUp => Err(convergence.failure()),
        _ => norm::finite(&memory.work.increment),
    }
}

/// Sets `work.d1` and `work.d2` to D₁L_d and D₁L_d + D₂L_d at the current Δ, and the coefficients.
fn differentiate<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    read_frequency(step, memory, q)?;
    let VariationalMemory { interpolation, ends, work, .. } = memory;
    match interpolation {
        Interpolation::Uniform(uniform) => sum_derivatives(uniform, step, work, q, statistics),
        Interpolation::Each(each) => sum_derivatives(each, step, work, q, statistics),
    }
    if step.method.frequency.reading() == Some(Reading::Variational)
        && let Interpolation::Uniform(uniform) = interpolation
    {
        let by_omega = uniform.slope(step, work, q, ends[0].omega + ends[1].omega);
        let half = T::lift(0.5) * by_omega;
        let Work { d1, d2, .. } = work;
        let [start, end] = ends;
        for i in 0..q.len() {
            let by_velocity = (start.dv[i] + end.dv[i]) / step.h;
            d1[i] += half * (start.dq[i] - by_velocity);
            d2[i] += half * (start.dq[i] + end.dq[i]);
        }
    }
    norm::finite(&memory.work.d1)
}

/// The coefficients for the frequency at the current Δ.
fn read_frequency<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
) -> Result<(), StepFailure> {
    let VariationalMemory { interpolation, ends: [start, end], motion, work } = memory;
    let Some(reading) = step.method.frequency.reading() else { return interpolation.fix(step) };
    let Motion { p, force, mass: Some(mass), .. } = motion else { return Ok(()) };
    let Interpolation::Uniform(coefficients) = interpolation else { return Ok(()) };
    let (frequency, per_h) = (&step.method.frequency, T::lift(1.0) / step.h);
    let Work { next, velocity, increment, gradient, .. } = work;
    for i in 0..q.len() {
        next[i] = q[i] + increment[i];
        velocity[i] = increment[i] * per_h;
    }
    let (t0, t1) = (step.t, step.node_time(1.0));
    match reading {
        Reading::LeftFrozen => {
            mass.solve(p, velocity);
            start.evaluate(frequency, mass, q, velocity, force)?;
            return coefficients.set(step, start.omega);
        }
        Reading::Averaged => {
            start.evaluate(frequency, mass, q, velocity, force)?;
            step.system.force(next, &[], t1, gradient);
            end.evaluate(frequency, mass, next, velocity, gradient)?;
        }
        Reading::Variational => {
            start.differentiate(frequency, mass, step.system, q, velocity, t0)?;
            end.differentiate(frequency, mass, step.system, next, velocity, t1)?;
        }
    }
    coefficients.set(step, T::lift(0.5) * (start.omega + end.omega))
}

/// ∂ℓ/∂q0 and ∂ℓ/∂q0 + ∂ℓ/∂q1.
fn sum_derivatives<S: RegularLagrangian, F: Frequency, R: Rule, T: Real>(
    coefficients: &impl Coefficients<T>,
    step: &Step<'_, S, F, R, T>,
    work: &mut Work<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) {
    work.d1.fill(T::lift(0.0));
    work.d2.fill(T::lift(0.0));
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        place(coefficients, node, step, work, q);
        let Work { point, velocity, gradient, momentum, d1, d2, .. } = &mut *work;
        step.system.gradient(point, velocity, step.node_time(c), gradient, momentum);
        statistics.gradients += 1;
        let weight = coefficients.weight(node);
        for i in 0..q.len() {
            let Basis { b, b_bar, d, d_bar } = coefficients.basis(node, i);
            d1[i] += weight * (step.h * b * gradient[i] + d * momentum[i]);
            d2[i] += weight * (step.h * (b + b_bar) * gradient[i] + (d + d_bar) * momentum[i]);
        }
    }
}

/// Sets `point` to qʲ and `velocity` to q̇ʲ.
pub(super) fn place<S: RegularLagrangian, F, R: Rule, T: Real>(
    coefficients: &impl Coefficients<T>,
    node: usize,
    step: &Step<'_, S, F, R, T>,
    work: &mut Work<S, T>,
    q: &[T],
) {
    let per_h = T::lift(1.0) / step.h;
    for i in 0..q.len() {
        let Basis { b, b_bar, d, d_bar } = coefficients.basis(node, i);
        work.point[i] = (b + b_bar) * q[i] + b_bar * work.increment[i];
        work.velocity[i] = ((d + d_bar) * q[i] + d_bar * work.increment[i]) * per_h;
    }
}

/// Sets `work.trial` to the correction (∂r/∂q1)⁻¹r.
fn correct<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &[T],
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let VariationalMemory { interpolation, motion, work, .. } = memory;
    for i in 0..q.len() {
        work.trial[i] = motion.p[i] + work.d1[i];
    }
    match (&mut motion.newton, &motion.mass, interpolation) {
        (Some([matrix, _]), _, Interpolation::Uniform(uniform)) => {
            newton_matrix(uniform, step, matrix, work, q);
        }
        (Some(storage), _, Interpolation::Each(each)) => {
            newton_matrix_by_coordinates(each, step, storage, work, q);
        }
        (None, Some(mass), Interpolation::Uniform(uniform)) => {
            let Work { trial, velocity, .. } = work;
            let factor = -step.h * uniform.sums(0).compliance;
            mass.solve(trial, velocity);
            for (trial, &velocity) in trial.iter_mut().zip(velocity.iter()) {
                *trial = factor * velocity;
            }
            return Ok(());
        }
        // Such options have been refused at the start.
        (None, ..) => {}
    }
    let Motion { newton: Some([matrix, _]), .. } = motion else { return Ok(()) };
    statistics.linearizations += 1;
    statistics.factorisations += 1;
    elimination::eliminate(matrix, &mut work.trial)
}

/// Sets the first matrix to D₁D₂L_d.
fn newton_matrix<S: RegularLagrangian, F: Frequency, R: Rule, T: Real>(
    coefficients: &impl Coefficients<T>,
    step: &Step<'_, S, F, R, T>,
    matrix: &mut Matrix<S, T>,
    work: &mut Work<S, T>,
    q: &[T],
) {
    matrix.fill(T::lift(0.0));
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        place(coefficients, node, step, work, q);
        let (w, Basis { b, b_bar, d, d_bar }) = (coefficients.weight(node), coefficients.basis(node, 0));
        let weights = Weights {
            qq: w * step.h * b * b_bar,
            qv: w * b * d_bar,
            vq: w * d * b_bar,
            vv: w * d * d_bar / step.h,
        };
        let Work { point, velocity, gradient, momentum, .. } = work;
        step.system.linearize(point, velocity, step.node_time(c), weights, gradient, momentum, matrix);
    }
}

/// The same with coefficients that differ from coordinate to coordinate: block by block.
fn newton_matrix_by_coordinates<S: RegularLagrangian, F: Frequency, R: Rule, T: Real>(
    coefficients: &impl Coefficients<T>,
    step: &Step<'_, S, F, R, T>,
    [matrix, block]: &mut [Matrix<S, T>; 2],
    work: &mut Work<S, T>,
    q: &[T],
) {
    let (zero, one, n) = (T::lift(0.0), T::lift(1.0), q.len());
    let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
    matrix.fill(zero);
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        place(coefficients, node, step, work, q);
        let (w, t) = (coefficients.weight(node), step.node_time(c));
        let Work { point, velocity, gradient, momentum, .. } = &mut *work;
        let mut add = |weights: Weights<T>, factor: &dyn Fn(Basis<T>, Basis<T>) -> T| {
            block.fill(zero);
            step.system.linearize(point, velocity, t, weights, gradient, momentum, block);
            for i in 0..n {
                for j in 0..n {
                    let (row, column) = (coefficients.basis(node, i), coefficients.basis(node, j));
                    matrix[i * n + j] += w * factor(row, column) * block[i * n + j];
                }
            }
        };
        add(Weights { qq: one, ..none }, &|row, column| step.h * row.b * column.b_bar);
        add(Weights { qv: one, ..none }, &|row, column| row.b * column.d_bar);
        add(Weights { vq: one, ..none }, &|row, column| row.d * column.b_bar);
        add(Weights { vv: one, ..none }, &|row, column| row.d * column.d_bar / step.h);
    }
}

/// Moves to q1 = q0 + Δ and evaluates p1 = p0 + (D₁ + D₂)L_d.
fn finish<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    differentiate(step, memory, q, statistics)?;
    let VariationalMemory { motion, work, .. } = memory;
    let Motion { p, force, orientation, .. } = motion;
    for i in 0..q.len() {
        work.next[i] = q[i] + work.increment[i];
        work.d2[i] += p[i];
    }
    norm::finite(&work.next).and(norm::finite(&work.d2))?;
    if S::SEPARABLE {
        step.system.force(&work.next, &[], step.node_time(1.0), &mut work.trial);
        statistics.gradients += 1;
        norm::finite(&work.trial)?;
        force.copy_from_slice(&work.trial);
    }
    if let Some(orientation) = orientation {
        let per_h = T::lift(1.0) / step.h;
        for (v, &delta) in work.velocity.iter_mut().zip(work.increment.iter()) {
            *v = delta * per_h;
        }
        orientation.check(step.system, &work.next, &work.velocity, step.node_time(1.0))?;
    }
    q.copy_from_slice(&work.next);
    p.copy_from_slice(&work.d2);
    motion.remember(step.h, &work.increment);
    Ok(())
}
