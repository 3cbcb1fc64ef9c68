//! Any L: derivatives of L at every node.
//!
//! rᵣ = Σⱼ wⱼ (h φ̂ⱼᵣ ∂L/∂q + ψ̂ⱼᵣ ∂L/∂v), for Δ with p0 added
//! ∂rᵣ/∂xₖ = Σⱼ wⱼ (h φ̂ⱼᵣφⱼₖ L_qq + φ̂ⱼᵣψⱼₖ L_qv + ψ̂ⱼᵣφⱼₖ L_vq + ψ̂ⱼᵣψⱼₖ L_vv/h)
//!
//! solved by Newton for all unknowns at once. Where the frequency is read from the motion, the residual is
//! exact, and the matrix is that of ω held constant, which is close enough for the iteration to contract.

use super::coefficients::Coefficients;
use super::interior::InteriorNodes;
use super::memory::{Path, Work};
use super::steps::Step;
use crate::discrete::Rule;
use crate::discrete::frequency::{Frequency, FrequencyIn};
use crate::error::StepFailure;
use crate::methods::collocation::lobatto::Lobatto;
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Guess, iterate, sizes};
use crate::space::{CoupledSolver, NodeSum, Sink, linear, scratch};
use crate::state::Statistics;
use crate::{Coupled, NondegenerateLagrangian, Real, System, Vector, Weights};
use core::ops::DerefMut;

/// The unknowns.
pub(super) fn newton<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    q: &[T],
    solver: &mut Coupled<NODES, S, T>,
    guess: Guess,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    path.guess(step, q);
    if guess == Guess::Zero {
        for unknown in &mut path.work.unknowns[1..] {
            unknown.fill(T::lift(0.0));
        }
    }
    let stopping = step.method.stopping;
    let convergence = Convergence::new(stopping, stopping.max_iterations);
    iterate(convergence, statistics, |due, statistics| {
        due.prepare_all(step.system, &mut path.work.weights, q, &mut path.work.unknowns[1..]);
        path.read_frequency(step, statistics)?;
        differentiate(step, path, statistics)?;
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        let Path { rule, coefficients, phase, work, .. } = &mut *path;
        let Work { unknowns, residuals, weights, point, velocity, gradient, momentum, next, .. } = work;
        let node = [point, velocity, gradient, momentum];
        let p = &phase.p;
        let mut equations = Linearized { step, rule, coefficients, unknowns, p, node, j: 0, t: step.t };
        if *due == Due::Residual {
            return linear::residual_of_nodes(&mut equations, weights, residuals, next);
        }
        solver.solve(&mut equations, weights, residuals)?;
        let mut correction = T::lift(0.0);
        for (unknown, change) in unknowns.iter_mut().zip(residuals.iter()).skip(1) {
            correction = norm::larger(correction, sizes::reduce(step.system, weights, unknown, change));
        }
        Ok(correction)
    })?;
    path.work.unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))
}

/// Sets `point` to qʲ and `velocity` to q̇ʲ of node `j`.
fn place<const NODES: usize, T: Real, V: DerefMut<Target = [T]>>(
    j: usize,
    h: T,
    coefficients: &Coefficients<NODES, T>,
    unknowns: &[V; NODES],
    [point, velocity]: [&mut V; 2],
) {
    let (zero, per_h) = (T::lift(0.0), T::lift(1.0) / h);
    let sum = |row: &[T; NODES], i: usize| {
        row.iter().zip(unknowns.iter()).fold(zero, |sum, (&factor, x)| sum + factor * x[i])
    };
    for i in 0..point.len() {
        point[i] = sum(&coefficients.point[j], i);
        velocity[i] = per_h * sum(&coefficients.velocity[j], i);
    }
}

/// Sets `work.residuals` at the current unknowns.
fn differentiate<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real, E, I>(
    step: &Step<'_, NODES, S, F, T, E>,
    path: &mut Path<NODES, S, T, I>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure>
where
    I: InteriorNodes<NODES, S, T>,
{
    for residual in &mut path.work.residuals {
        residual.fill(T::lift(0.0));
    }
    for j in 0..NODES {
        let Path { rule, coefficients, work, .. } = &mut *path;
        let Work { unknowns, residuals, point, velocity, gradient, momentum, .. } = work;
        place(j, step.h, coefficients, unknowns, [point, velocity]);
        step.system.gradient(point, velocity, step.node_time(rule.nodes()[j]), gradient, momentum);
        statistics.gradients += 1;
        for (r, residual) in residuals.iter_mut().enumerate() {
            let [by_point, by_velocity] = coefficients.weighted_direction(j, r);
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

/// The matrix ∂rᵣ/∂xₖ at the current unknowns.
struct Linearized<'a, 'b, const NODES: usize, S: System, F, T: Real, E> {
    step: &'a Step<'b, NODES, S, F, T, E>,
    rule: &'a Lobatto<NODES>,
    coefficients: &'a Coefficients<NODES, T>,
    unknowns: &'a [Vector<S, T>; NODES],
    p: &'a [T],
    /// Work space: point and velocity of a node, and the first derivatives of L there.
    node: [&'a mut Vector<S, T>; 4],
    /// The node, and its time.
    j: usize,
    t: T,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real, E> NodeSum<NODES, T>
    for Linearized<'_, '_, NODES, S, F, T, E>
{
    const FIRST: usize = 1;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&mut self, j: usize) {
        let Self { step, rule, coefficients, unknowns, node: [point, velocity, ..], .. } = self;
        place(j, step.h, coefficients, unknowns, [point, velocity]);
        self.j = j;
        self.t = step.node_time(rule.nodes()[j]);
    }

    fn given(&self, i: usize) -> T {
        self.p[i]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let Self { step: Step { h, .. }, coefficients, j, .. } = *self;
        let [by_point, by_velocity] = coefficients.weighted_direction(j, r);
        let (phi, psi) = (coefficients.point[j][k], coefficients.velocity[j][k]);
        Weights {
            qq: *h * by_point * phi,
            qv: by_point * psi,
            vq: by_velocity * phi,
            vv: by_velocity * psi / *h,
        }
    }

    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn momentum_by_position(&mut self, vq: &mut impl Sink<T>) {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let [point, velocity, gradient, momentum] = &mut self.node;
        let w = Weights { qq: zero, qv: zero, vq: one, vv: zero };
        self.step.system.linearize(point, velocity, self.t, w, gradient, momentum, vq);
    }

    // Kept out of line, with scratch of its own, so that the compiler sees that what is written is not what
    // is read, and evaluates once what the three have in common.
    #[inline(never)]
    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        let (system, t) = (self.step.system, self.t);
        let [point, velocity, gradient, momentum] = &mut self.node;
        scratch!(l_q = system, **gradient);
        scratch!(l_v = system, **momentum);
        system.linearize(point, velocity, t, Weights { qq: one, ..none }, l_q, l_v, qq);
        system.linearize(point, velocity, t, Weights { qv: one, ..none }, l_q, l_v, qv);
        system.linearize(point, velocity, t, Weights { vv: one, ..none }, l_q, l_v, vv);
    }
}

/// Moves to q1 = q0 + Δ and evaluates p1 = p0 + (D₁ + D₂)L_d.
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
    differentiate(step, path, statistics)?;
    let Work { unknowns, residuals, momentum, next, .. } = &mut path.work;
    path.phase.reach(&unknowns[0], &unknowns[NODES - 1], next);
    path.phase.kick(&residuals[0], momentum);
    path.complete(step.system, [step.h, step.node_time(1.0)], q)
}
