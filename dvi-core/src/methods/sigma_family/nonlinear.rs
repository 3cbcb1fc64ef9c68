//! Nonlinear one-forms.
//!
//! At σ = 0 the step is linear in Δ: (Dα)ᵀ(q0)Δ = h∇H(q0) − c0 and c1 = α(q0) − α(q1). Elsewhere it is
//! iterated: by Newton, or by Δ ← Δ + K⁻¹r(Δ) with K = σDα − (1−σ)(Dα)ᵀ frozen at the guess, which is
//! the fixed point of the affine case if α is affine.

use super::Step;
use super::memory::{SigmaMemory, Work, fixed_point_matrix};
use crate::discrete::{DiscreteLagrangian, Ends, NodeWork, OneNode, Span, solve_by_newton};
use crate::error::StepFailure;
use crate::mechanics::combination::Inverse;
use crate::scalar::norm;
use crate::solve::{Convergence, Guess, iterate, sizes};
use crate::state::Statistics;
use crate::state::history::History;
use crate::{DegenerateLagrangian, Linear, Real, Vector};

#[inline]
pub(super) fn step<S: DegenerateLagrangian<T>, T: Real>(
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
fn implicit<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { ladder, defect, one_form, history, inverse, l_d, work, .. } = memory;
    for i in 0..q.len() {
        work.shift[i] = defect[i] + one_form[i];
    }
    let budget = step.budget(ladder, q.len());
    let mut attempt = Attempt { step, q, history, inverse, l_d, work, budget };
    ladder.solve(&mut attempt, statistics, Attempt::fixed_point, Attempt::newton)?;
    finish(step, memory, q, statistics)
}

/// σ = 0.
#[inline]
fn one_solve<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, inverse, orientation, l_d, work, .. } = memory;
    let node = &mut l_d.work;
    let combination = fixed_point_matrix::<S, T>(step.method, step.h);
    step.system.hamiltonian_gradient(q, step.t, &mut node.gradient);
    statistics.gradients += 1;
    inverse.prepare(step.system, q, step.t, combination, &mut work.trial, statistics)?;
    for i in 0..q.len() {
        work.trial[i] = step.h * node.gradient[i] - defect[i];
    }
    inverse.solve(step.system, &work.trial, &mut work.increment);
    for i in 0..q.len() {
        work.next[i] = q[i] + work.increment[i];
    }
    norm::finite(&work.next)?;
    step.system.one_form(&work.next, step.t + step.h, &mut node.momentum);
    norm::finite(&node.momentum)?;
    orientation.check(step.system, &work.next, step.t + step.h)?;
    q.copy_from_slice(&work.next);
    for i in 0..q.len() {
        defect[i] = one_form[i] - node.momentum[i];
        one_form[i] = node.momentum[i];
    }
    Ok(())
}

/// A step as it is being solved: `work.increment` becomes Δ; `work.shift` is p0.
struct Attempt<'a, S: DegenerateLagrangian<T>, T: Real> {
    step: &'a Step<'a, S, T>,
    q: &'a Vector<S, T>,
    history: &'a History<S, T>,
    inverse: &'a mut Inverse<S, T>,
    l_d: &'a mut OneNode<S, T>,
    work: &'a mut Work<S, T>,
    budget: usize,
}

impl<S: DegenerateLagrangian<T>, T: Real> Attempt<'_, S, T> {
    /// Δ ← Δ + K⁻¹r(Δ), with K at the guess.
    #[inline]
    fn fixed_point(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { step, q, history, inverse, l_d, work, budget } = self;
        let combination = fixed_point_matrix::<S, T>(step.method, step.h);
        let Work { increment, trial, weights, shift: p0, sum, next: residual, .. } = &mut **work;
        history.extrapolate(increment);
        l_d.place(step.interval(), Ends { q0: q, delta: increment });
        inverse.prepare(step.system, &l_d.work.point, step.node_time(), combination, trial, statistics)?;
        let convergence = Convergence::fixed_point(step.method.stopping, *budget);
        iterate(convergence, statistics, |due, statistics| {
            due.prepare(step.system, weights, q, increment);
            residual.copy_from_slice(p0);
            let ends = Ends { q0: q, delta: increment };
            l_d.derivatives(
                Span { system: step.system, interval: step.interval(), ends },
                residual,
                sum,
                statistics,
            )?;
            inverse.solve(step.system, residual, trial);
            for (delta, &correction) in increment.iter_mut().zip(trial.iter()) {
                *delta += correction;
            }
            Ok(sizes::largest(weights, trial))
        })?;
        norm::finite(increment)
    }

    #[inline]
    fn newton(
        &mut self,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, q, history, l_d, work, .. } = self;
        let Work { increment, trial, weights, shift: p0, .. } = &mut **work;
        guess.begin(increment, |increment| history.extrapolate(increment));
        let (points, storage) = ([&***q, &**p0], (solver, [trial, weights]));
        let stopping = step.method.stopping;
        solve_by_newton(*l_d, step.system, step.interval(), points, increment, storage, stopping, statistics)
    }
}

/// Moves to q1 = q0 + Δ and evaluates c1 = α(q_σ) + σh ∂L/∂q − α(q1).
#[inline]
fn finish<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, one_form, history, orientation, l_d, work, .. } = memory;
    l_d.place(step.interval(), Ends { q0: q, delta: &work.increment });
    let NodeWork { point, velocity, gradient, momentum } = &mut l_d.work;
    let Work { trial, increment, next, .. } = work;
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
