//! The equations of a step, r(Δ) = c0 + α(q0) − α(q_σ) + (1−σ)G = 0, solved for Δ = K⁻¹c0 + s, and c1.
//!
//! They are p0 + D₁L_d = 0 for Newton's method, and for the fixed point Δ ← Δ + K⁻¹r(Δ), with the matrix K =
//! σDα − (1−σ)(Dα)ᵀ at the guess.
//!
//! If α is affine, α(q_σ) − α(q0) = σDαΔ with one constant matrix Dα, so that a step is
//!
//! KΔ = c0 − (1−σ)h∇H(q_σ)        c1 = K'Δ − σh∇H(q_σ)        K' = σ(Dα)ᵀ − (1−σ)Dα = −K
//!
//! At σ = 0 and 1 no gradient of the unknown point occurs in the first: explicit. Steps with σ = 0 are
//! [`leaps`](super::leapfrog). At σ = ½, c1 = −c0; with c0 = 0 the scheme is the implicit midpoint rule. If
//! α is not affine, σ = ½.

use super::Step;
use super::affine::fixed_point;
use super::begin::scaled;
use super::memory::{Carried, SigmaMemory, Work};
use crate::discrete::{Departing, Span};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::scalar::passes::{add, negate, subtract};
use crate::solve::{Convergence, Guess, sizes, solve_by_fixed_point, solve_by_newton};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{DegenerateLagrangian, Linear, Real, Vector};

/// A step that is no leap. Kept out of line, so that leaps do not set up a frame for it.
#[inline(never)]
pub(super) fn step<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { carried, ladder, monitor, .. } = memory;
    monitor.look(q)?;
    if S::AFFINE && !carried.defect_vanishes {
        carried.shift_by_defect(step.system);
    }
    let budget = step.method.budget(ladder, q.len());
    let mut attempt = Attempt { step, q, carried, budget };
    ladder.solve(&mut attempt, statistics, Attempt::fixed_point, Attempt::newton)?;
    if S::AFFINE {
        carried.arrive(step, q)?;
    } else {
        carried.arrive_on_curved(step, q, statistics)?;
    }
    monitor.steps += 1;
    Ok(())
}

/// A step as it is being solved: `work.increment` becomes s and, if α is affine and σ ≠ ½, the gradient of
/// the node ∇H(q_σ).
struct Attempt<'a, S: DegenerateLagrangian<T>, T: Real> {
    step: &'a Step<'a, S, T>,
    q: &'a Vector<S, T>,
    carried: &'a mut Carried<S, T>,
    budget: usize,
}

impl<S: DegenerateLagrangian<T>, T: Real> Attempt<'_, S, T> {
    fn fixed_point(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        if !S::AFFINE {
            self.frozen_fixed_point(statistics)
        } else if self.step.method.is_end() {
            self.carried.work.increment.fill(T::lift(0.0));
            self.evaluate_at_node(statistics)
        } else {
            fixed_point(self.step, self.q, self.carried, self.budget, statistics)
        }
    }

    /// Δ ← Δ + K⁻¹r(Δ).
    fn frozen_fixed_point(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { step, q, carried, budget } = self;
        let Carried { defect, one_form, history, inverse, l_d, work, .. } = &mut **carried;
        let Work { increment, trial, weights, sum, next: residual, .. } = work;
        let system = step.system;
        history.extrapolate(increment);
        l_d.place(step.h, [q, increment]);
        let (_, matrix) = scaled::<S, T>(step.method, step.h);
        inverse.prepare(system, &l_d.work.point, step.node_time(), matrix, trial, statistics)?;
        let criterion = Some((step.method.stopping, *budget));
        let storage = [&mut increment[..], trial, weights];
        let correct = |[delta, change]: [&mut [T]; 2], weights: &[T], statistics: &mut Statistics| {
            add(defect, one_form, residual);
            let span = Span { system, interval: step.interval(), q0: q, delta };
            l_d.derivatives(span, residual, sum, statistics);
            inverse.solve(system, residual, change);
            Ok(sizes::improve(weights, delta, change, sizes::added))
        };
        solve_by_fixed_point((system, q), storage, criterion, statistics, correct)
    }

    /// Newton on Δ.
    #[inline]
    fn newton(
        &mut self,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, q, carried, .. } = self;
        let Step { system, method, t, .. } = **step;
        let Carried { defect, defect_vanishes, one_form, history, l_d, work, .. } = &mut **carried;
        let Work { increment, shift, next: p0, trial, weights, sum: left_out, .. } = work;
        left_out.fill(T::lift(0.0));
        let shift = (S::AFFINE && !*defect_vanishes).then_some(&*shift);
        match guess {
            Guess::Extrapolated => history.extrapolate(increment),
            Guess::Zero => increment.fill(T::lift(0.0)),
        }
        if let Some(shift) = shift {
            increment.iter_mut().zip(shift.iter()).for_each(|(delta, &shift)| *delta += shift);
        }
        if S::AFFINE {
            system.one_form(q, t, one_form);
        }
        add(defect, one_form, p0);
        let (points, storage) = ([&***q, &**p0], (solver, [trial, weights]));
        let departing = &mut Departing { l_d, system, interval: step.interval(), q0: q };
        let judge = Convergence::new(method.stopping, method.stopping.max_iterations);
        solve_by_newton(departing, system, points, increment, storage, judge, statistics)?;
        if let Some(shift) = shift {
            subtract(increment, shift);
        }
        if S::AFFINE && !method.is_midpoint() { self.evaluate_at_node(statistics) } else { Ok(()) }
    }

    /// Evaluates ∇H at q_σ, of affine α and a defect.
    fn evaluate_at_node(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { step, q, carried: Carried { l_d, work, .. }, .. } = self;
        add(&work.shift, &work.increment, &mut work.trial);
        l_d.place(step.h, [q, &work.trial]);
        let node = &mut l_d.work;
        step.system.hamiltonian_gradient(&node.point, step.node_time(), &mut node.gradient);
        statistics.gradients += 1;
        // A collision there shows in the gradient.
        norm::finite(&node.point).and(norm::finite(&node.gradient))
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Carried<S, T> {
    /// Moves to q1 = q0 + K⁻¹c0 + s, and to c1 = K'Δ − σh∇H(q_σ): for affine α.
    fn arrive(&mut self, step: &Step<'_, S, T>, q: &mut Vector<S, T>) -> Result<(), StepFailure> {
        let Self { defect, defect_vanishes, history, product, l_d, rest, work, .. } = self;
        let Work { shift, increment, trial, sum: left_out, next, .. } = work;
        let delta = if *defect_vanishes {
            &*increment
        } else {
            add(shift, increment, trial);
            &*trial
        };
        match step.method.summation {
            Summation::Compensated => rest.move_by(q, [delta, left_out], next)?,
            Summation::Plain => {
                scratch!(next = step.system, *next);
                add(q, delta, next);
                norm::finite(next)?;
                q.copy_from_slice(next);
            }
        }
        match product {
            _ if *defect_vanishes => {}
            None => negate(defect),
            Some(product) => {
                product.apply(step.system, delta, defect);
                let right = step.method.sigma * step.h;
                for (c, &gradient) in defect.iter_mut().zip(l_d.work.gradient.iter()) {
                    *c -= right * gradient;
                }
            }
        }
        history.push(increment);
        Ok(())
    }

    /// Moves to q1 = q0 + Δ, and to c1 = α(q_σ) + σh ∂L/∂q − α(q1).
    fn arrive_on_curved(
        &mut self,
        step: &Step<'_, S, T>,
        q: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { defect, one_form, history, orientation, l_d, work, .. } = self;
        let Work { increment, trial: end_form, next, .. } = work;
        let (system, end) = (step.system, step.t + step.h);
        let right_h = step.method.sigma * step.h;
        l_d.place(step.h, [q, increment]);
        let node = &mut l_d.work;
        let [gradient, momentum] = [&mut node.gradient, &mut node.momentum];
        system.gradient(&node.point, &node.velocity, step.node_time(), gradient, momentum);
        statistics.gradients += 1;
        add(q, increment, next);
        norm::finite(next)?;
        system.one_form(next, end, end_form);
        let (gradient, momentum) = (&l_d.work.gradient, &mut l_d.work.momentum);
        for i in 0..q.len() {
            momentum[i] += right_h * gradient[i] - end_form[i];
        }
        norm::finite(momentum)?;
        orientation.pass(system, &[], (next, end))?;
        q.copy_from_slice(next);
        defect.copy_from_slice(momentum);
        one_form.copy_from_slice(end_form);
        history.push(increment);
        Ok(())
    }
}
