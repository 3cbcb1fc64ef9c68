//! Any L: derivatives of L at every node.
//!
//! rᵣ = Σⱼ wⱼ (h φ̂ⱼᵣ ∂L/∂q + ψ̂ⱼᵣ ∂L/∂v), for Δ with p0 added
//! ∂rᵣ/∂xₖ = Σⱼ wⱼ (h φ̂ⱼᵣφⱼₖ L_qq + φ̂ⱼᵣψⱼₖ L_qv + ψ̂ⱼᵣφⱼₖ L_vq + ψ̂ⱼᵣψⱼₖ L_vv/h)
//!
//! solved by Newton, [block by block](super::blocks). Where the frequency is read from the motion, the residual is
//! exact, and the matrix is that of ω held constant, which is close enough for the iteration to contract.

use super::Step;
use super::blocks;
use super::memory::{Newton, Path, Work};
use crate::discrete::frequency::{Frequency, FrequencyIn};
use crate::discrete::quadrature::Rule;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, Guess, iterate};
use crate::state::Statistics;
use crate::{Real, RegularLagrangian, Vector, Weights};

/// The unknowns.
pub(super) fn newton<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, NODES, S, F, T>,
    path: &mut Path<NODES, S, T>,
    q: &[T],
    storage: &mut Newton<NODES, S, T>,
    guess: Guess,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    path.guess(step, q);
    if guess == Guess::Zero {
        for unknown in &mut path.work.unknowns[1..] {
            unknown.fill(T::lift(0.0));
        }
    }
    let stopping = step.method.stopping;
    let convergence = Convergence::new(stopping, path.scale(), q, stopping.max_iterations);
    iterate(convergence, statistics, |statistics| {
        path.read_frequency(step, statistics)?;
        differentiate(step, path, statistics)?;
        linearize(step, path, storage, statistics);
        let Newton { blocks, permutation } = &mut *storage;
        let Work { unknowns, residuals, .. } = &mut path.work;
        blocks::eliminate(blocks, permutation, residuals, 1..NODES)?;
        let mut correction = T::lift(0.0);
        for (unknown, change) in unknowns.iter_mut().zip(residuals.iter()).skip(1) {
            for (x, &change) in unknown.iter_mut().zip(change.iter()) {
                *x -= change;
            }
            correction = norm::larger(correction, norm::largest(change));
        }
        Ok(correction)
    })?;
    path.work.unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))
}

/// Sets `point` to qʲ and `velocity` to q̇ʲ of node `j`.
fn place<const NODES: usize, S: RegularLagrangian<T>, F: Frequency, T: Real>(
    j: usize,
    step: &Step<'_, NODES, S, F, T>,
    path: &mut Path<NODES, S, T>,
) {
    let Path { coefficients, work, .. } = path;
    let Work { unknowns, point, velocity, .. } = work;
    let (zero, per_h) = (T::lift(0.0), T::lift(1.0) / step.h);
    let sum = |row: &[T; NODES], i: usize| {
        row.iter().zip(unknowns.iter()).fold(zero, |sum, (&factor, x)| sum + factor * x[i])
    };
    for i in 0..point.len() {
        point[i] = sum(&coefficients.point[j], i);
        velocity[i] = per_h * sum(&coefficients.velocity[j], i);
    }
}

/// Sets `work.residuals` at the current unknowns.
fn differentiate<const NODES: usize, S: RegularLagrangian<T>, F: Frequency, T: Real>(
    step: &Step<'_, NODES, S, F, T>,
    path: &mut Path<NODES, S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    for residual in &mut path.work.residuals {
        residual.fill(T::lift(0.0));
    }
    for j in 0..NODES {
        place(j, step, path);
        let Path { rule, coefficients, work, .. } = &mut *path;
        let Work { residuals, point, velocity, gradient, momentum, .. } = work;
        step.system.gradient(point, velocity, step.node_time(rule.nodes()[j]), gradient, momentum);
        statistics.gradients += 1;
        for (r, residual) in residuals.iter_mut().enumerate() {
            let [by_point, by_velocity] = coefficients.direction(j, r).map(|x| coefficients.weights[j] * x);
            for i in 0..residual.len() {
                residual[i] += step.h * by_point * gradient[i] + by_velocity * momentum[i];
            }
        }
    }
    let Path { phase, work, .. } = path;
    for (residual, &p) in work.residuals[NODES - 1].iter_mut().zip(phase.p.iter()) {
        *residual += p;
    }
    work.residuals.iter().try_for_each(|residual| norm::finite(residual))
}

/// Sets the blocks of the Newton matrix at the current unknowns.
fn linearize<const NODES: usize, S: RegularLagrangian<T>, F: Frequency, T: Real>(
    step: &Step<'_, NODES, S, F, T>,
    path: &mut Path<NODES, S, T>,
    newton: &mut Newton<NODES, S, T>,
    statistics: &mut Statistics,
) {
    let (zero, one) = (T::lift(0.0), T::lift(1.0));
    let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
    let kinds = [Weights { qq: one, ..none }, Weights { qv: one, ..none }, Weights { vv: one, ..none }];
    newton.blocks[1..].iter_mut().flatten().for_each(|block| block.fill(zero));
    for j in 0..NODES {
        place(j, step, path);
        let Path { rule, coefficients, work, .. } = &mut *path;
        let Work { point, velocity, gradient, momentum, .. } = work;
        let (second, rows) = newton.blocks.split_at_mut(1);
        for (matrix, weights) in second[0].iter_mut().zip(kinds) {
            matrix.fill(zero);
            let t = step.node_time(rule.nodes()[j]);
            step.system.linearize(point, velocity, t, weights, gradient, momentum, matrix);
        }
        let weight = coefficients.weights[j];
        for (r, row) in rows.iter_mut().enumerate().map(|(r, row)| (r + 1, row)) {
            let [by_point, by_velocity] = coefficients.direction(j, r).map(|x| weight * x);
            for (k, block) in row.iter_mut().enumerate().skip(1) {
                let (phi, psi) = (coefficients.point[j][k], coefficients.velocity[j][k]);
                let weights = Weights {
                    qq: step.h * by_point * phi,
                    qv: by_point * psi,
                    vq: by_velocity * phi,
                    vv: by_velocity * psi / step.h,
                };
                add_transposed(weights, &second[0], point.len(), block);
            }
        }
    }
    statistics.linearizations += 1;
    statistics.factorisations += 1;
}

/// Adds the transpose of the weighted sum of second derivatives L_qq, L_qv, L_vv and L_vq = (L_qv)ᵀ.
#[inline]
fn add_transposed<T: Real, M: core::ops::Deref<Target = [T]>>(
    w: Weights<T>,
    second: &[M],
    n: usize,
    block: &mut [T],
) {
    let [qq, qv, vv, ..] = second else { return };
    for i in 0..n {
        for j in 0..n {
            let (here, across) = (i * n + j, j * n + i);
            block[here] += w.qq * qq[here] + w.qv * qv[across] + w.vq * qv[here] + w.vv * vv[here];
        }
    }
}

/// Moves to q1 = q0 + Δ and evaluates p1 = p0 + (D₁ + D₂)L_d.
pub(super) fn finish<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real>(
    step: &Step<'_, NODES, S, F, T>,
    path: &mut Path<NODES, S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    path.read_frequency(step, statistics)?;
    differentiate(step, path, statistics)?;
    let Work { unknowns, residuals, momentum, next, next_force, .. } = &mut path.work;
    path.phase.reach(&unknowns[0], &unknowns[NODES - 1], next);
    path.phase.kick(&residuals[0], momentum);
    if S::SEPARABLE {
        step.system.force(next, &[], step.node_time(1.0), next_force);
        statistics.gradients += 1;
    }
    path.complete(step.system, [step.h, step.node_time(1.0)], q)
}
