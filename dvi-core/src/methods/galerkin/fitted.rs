//! L = ½ v·M v − V(q, t) with a frequency: the fixed point that needs forces only.
//!
//! rᵣ = h Gᵣ + M Σₖ Kᵣₖ xₖ/h      Gᵣ = wᵣ F(qʳ) for displacements,   G_{s−1} = p0/h + Σⱼ wⱼ bⱼ F(qʲ) for Δ
//! x ← x − A⁻¹(h M⁻¹ r),   A = Σⱼ wⱼ (ψ̂ⱼ ψⱼᵀ − z φ̂ⱼ φⱼᵀ)
//!
//! A contains the oscillator of the fitted frequency, so that only what differs from it is iterated. As b =
//! 0 at the end and no displacement reaches it, an iteration needs the forces of the interior nodes alone.

use super::interior::InteriorNodes;
use super::memory::{Path, Work};
use super::steps::Step;
use crate::discrete::Rule;
use crate::discrete::frequency::FrequencyIn;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, iterate};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Scalar, Vector};

/// The unknowns.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_point<
    const NODES: usize,
    S: NondegenerateLagrangian<T>,
    F: FrequencyIn<T>,
    T: Real,
    E,
    I,
>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    q: &[T],
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    path.guess(step, q);
    let convergence = Convergence::fixed_point(step.method.stopping, budget);
    iterate(convergence, statistics, |due, statistics| {
        due.prepare_all(step.system, &mut path.work.weights, q, &mut path.work.unknowns[1..]);
        path.read_frequency(step, statistics)?;
        Ok(improve(step, path, statistics))
    })?;
    path.work.unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))
}

/// One iteration; returns the size of its correction.
#[cfg_attr(not(debug_assertions), inline(always))]
fn improve<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    statistics: &mut Statistics,
) -> T
where
    I: InteriorNodes<NODES, S, T>,
{
    let last = NODES - 1;
    let (weights, zero) = (path.coefficients.weights, T::lift(0.0));
    for i in 0..path.phase.p.len() {
        path.work.residuals[last][i] = path.phase.p[i] + step.h * weights[0] * path.phase.force[i];
    }
    for j in 1..last {
        node_force(j, step, path, statistics);
        let Work { residuals, gradient, .. } = &mut path.work;
        let [b, _] = path.coefficients.direction(j, last);
        for i in 0..gradient.len() {
            let impulse = step.h * weights[j] * gradient[i];
            residuals[j][i] = impulse;
            residuals[last][i] += b * impulse;
        }
    }
    let Path { coefficients, inertial, work, .. } = path;
    // Of another L no step comes here, and nothing converges.
    let Some(mass) = inertial.constant() else { return T::lift(f64::NAN) };
    let Work { unknowns, residuals, weights, velocity, .. } = work;
    for (residual, kinetic) in residuals.iter_mut().zip(&coefficients.kinetic).skip(1) {
        mass.solve(residual, velocity);
        for i in 0..residual.len() {
            let terms = kinetic.iter().zip(unknowns.iter());
            residual[i] = terms.fold(step.h * velocity[i], |sum, (&k, x)| sum + k * x[i]);
        }
    }
    let mut correction = zero;
    for (unknown, inverse) in unknowns.iter_mut().zip(&coefficients.inverse).skip(1) {
        for i in 0..unknown.len() {
            let terms = inverse.iter().zip(residuals.iter()).skip(1);
            let change = terms.fold(zero, |sum, (&a, r)| sum + a * r[i]);
            unknown[i] -= change;
            correction = norm::larger(correction, Scalar::abs(change) * weights[i]);
        }
    }
    correction
}

/// Sets `work.gradient` to the force at interior node `j`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn node_force<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, E, I>(
    j: usize,
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    statistics: &mut Statistics,
) where
    I: InteriorNodes<NODES, S, T>,
{
    let Work { unknowns, point, gradient, .. } = &mut path.work;
    let (row, last) = (&path.coefficients.point[j], NODES - 1);
    for i in 0..point.len() {
        point[i] = row[0] * unknowns[0][i] + row[last] * unknowns[last][i] + unknowns[j][i];
    }
    step.system.force(point, &[], step.node_time(path.rule.nodes()[j]), gradient);
    statistics.gradients += 1;
}

/// Moves to q1 = q0 + Δ and evaluates p1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn finish<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    path.read_frequency(step, statistics)?;
    let last = NODES - 1;
    let Work { unknowns, next, next_force, .. } = &mut path.work;
    path.phase.reach(&unknowns[0], &unknowns[last], next);
    step.system.force(next, &[], step.node_time(1.0), next_force);
    statistics.gradients += 1;
    let weights = path.coefficients.weights;
    for (sum, &f) in path.work.residuals[0].iter_mut().zip(path.phase.force.iter()) {
        *sum = step.h * weights[0] * f;
    }
    for j in 1..last {
        node_force(j, step, path, statistics);
        let Work { residuals, gradient, .. } = &mut path.work;
        let weight = step.h * weights[j] * path.coefficients.point[j][0];
        for (sum, &f) in residuals[0].iter_mut().zip(gradient.iter()) {
            *sum += weight * f;
        }
    }
    let Work { momentum, next_force, unknowns, residuals, velocity, .. } = &mut path.work;
    let sum = &mut residuals[0];
    for (sum, &f) in sum.iter_mut().zip(next_force.iter()) {
        *sum += step.h * weights[last] * f;
    }
    if let Some(mass) = path.inertial.constant() {
        for i in 0..velocity.len() {
            let terms = path.coefficients.kinetic[0].iter().zip(unknowns.iter());
            velocity[i] = terms.fold(T::lift(0.0), |sum, (&k, x)| sum + k * x[i]);
        }
        mass.multiply_add(T::lift(1.0) / step.h, velocity, sum);
    }
    path.phase.kick(sum, momentum);
    path.complete(step.system, [step.h, step.node_time(1.0)], q)
}
