//! Affine one-forms: α(q_σ) − α(q0) = σDαΔ with one constant matrix Dα, so that a step is
//!
//! KΔ = c0 − (1−σ)h∇H(q_σ)        K  = σDα − (1−σ)(Dα)ᵀ
//! c1 = K'Δ − σh∇H(q_σ)           K' = σ(Dα)ᵀ − (1−σ)Dα
//!
//! At σ = 0 and σ = 1 no gradient of the unknown point occurs: explicit. At σ = ½, K' = −K and c1 = −c0;
//! with c0 = 0 the scheme is the implicit midpoint rule.

use super::Step;
use super::leapfrog::{self, add};
use super::memory::{SigmaMemory, Work};
use crate::discrete::{Ends, OneNode, solve_by_newton};
use crate::error::StepFailure;
use crate::mechanics::combination::Inverse;
use crate::methods::Clock;
use crate::scalar::norm;
use crate::scalar::simd::{apart_if, widest_if};
use crate::solve::{Convergence, Course, Due, Guess, Iteration, Judge, Quick, iterate, repeat, sizes};
use crate::space::scratch;
use crate::state::Statistics;
use crate::state::history::History;
use crate::state::summation::{Carried, Summation};
use crate::{DegenerateLagrangian, Linear, Real, Space, Vector};

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn step<S: DegenerateLagrangian<T>, T: Real>(
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
        match step.method.summation {
            Summation::Plain => implicit(step, memory, q, statistics)?,
            Summation::Compensated => compensated(step, memory, q, statistics)?,
        }
    }
    memory.monitor.steps += 1;
    Ok(())
}

/// σ = 1: DαΔ = c0, c1 = (Dα)ᵀΔ − h∇H(q1).
#[inline(never)]
fn explicit_right<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, inverse, product, l_d, work, .. } = memory;
    scratch!(delta = step.system, work.increment);
    scratch!(next = step.system, work.next);
    scratch!(gradient = step.system, l_d.work.gradient);
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

/// Adds the increment to `q` if the result is finite.
#[cfg_attr(not(debug_assertions), inline(always))]
fn advance<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    q: &mut Vector<S, T>,
    increment: &[T],
    carried: &mut Carried<S, T>,
    storage: &mut Vector<S, T>,
) -> Result<(), StepFailure> {
    if step.method.summation == Summation::Compensated {
        return carried.move_by(q, increment, storage);
    }
    scratch!(next = step.system, *storage);
    add(q, increment, next);
    norm::finite(next)?;
    q.copy_from_slice(next);
    Ok(())
}

/// Kept out of line, so that the explicit step does not set up a frame for it.
#[inline(never)]
fn implicit<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    solve(step, memory, q, statistics, |attempt, _, statistics| attempt.fixed_point(statistics))
}

/// The same with compensated sums.
#[inline(never)]
fn compensated<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    solve(step, memory, q, statistics, |attempt, carried, statistics| {
        attempt.compensated_fixed_point(carried, statistics)
    })
}

/// An implicit step with this fixed point, to which is passed what rounding has left out of the coordinates.
#[cfg_attr(not(debug_assertions), inline(always))]
fn solve<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
    fixed_point: impl FnOnce(&mut Attempt<'_, S, T>, &Carried<S, T>, &mut Statistics) -> Result<(), StepFailure>,
) -> Result<(), StepFailure> {
    if !memory.defect_vanishes {
        memory.shift_by_defect(step.system);
    }
    let SigmaMemory {
        ladder, defect, defect_vanishes, one_form, history, inverse, l_d, work, carried, ..
    } = memory;
    let budget = step.budget(ladder, q.len());
    let defect = (!*defect_vanishes).then_some(&*defect);
    let mut attempt = Attempt { step, q, defect, one_form, history, inverse, l_d, work, budget };
    let fixed_point = |attempt: &mut Attempt<'_, S, T>, statistics: &mut Statistics| {
        fixed_point(attempt, carried, statistics)
    };
    ladder.solve(&mut attempt, statistics, fixed_point, Attempt::newton)?;
    finish(step, memory, q)
}

/// A step as it is being solved: `work.increment` becomes s, and the gradient of the node ∇H(q_σ).
struct Attempt<'a, S: DegenerateLagrangian<T>, T: Real> {
    step: &'a Step<'a, S, T>,
    q: &'a Vector<S, T>,
    /// c0, unless it is zero.
    defect: Option<&'a Vector<S, T>>,
    one_form: &'a mut Vector<S, T>,
    history: &'a History<S, T>,
    inverse: &'a Inverse<S, T>,
    l_d: &'a mut OneNode<S, T>,
    work: &'a mut Work<S, T>,
    budget: usize,
}

impl<S: DegenerateLagrangian<T>, T: Real> Attempt<'_, S, T> {
    /// s ← −(1−σ)h K⁻¹∇H(q0 + σK⁻¹c0 + σs).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fixed_point(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        widest_if(
            !<S::Space as Space>::ON_STACK,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || {
                self.repeat(
                    Quick::of(Course::fixed_point(self.step.method.stopping, self.budget)),
                    statistics,
                )
            },
        )
        .or_else(|failure| self.carefully(failure, statistics))
    }

    /// The same where the quick look has given up.
    #[cold]
    #[inline(never)]
    fn carefully(&mut self, failure: StepFailure, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let StepFailure::NotConverged { .. } = failure else { return Err(failure) };
        self.repeat(Convergence::fixed_point(self.step.method.stopping, self.budget), statistics)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn repeat(
        &mut self,
        convergence: impl Judge<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, q, defect, history, inverse, l_d, work, .. } = self;
        let sigma = step.method.sigma;
        let node = &mut l_d.work;
        scratch!(increment = step.system, node.velocity);
        scratch!(trial = step.system, work.trial);
        scratch!(weights = step.system, work.weights);
        scratch!(point = step.system, node.point);
        scratch!(gradient = step.system, node.momentum);
        history.extrapolate(increment);
        // Where the iteration would be without s.
        let origin: &[T] = if defect.is_none() {
            q
        } else {
            for ((next, &q), &shift) in work.next.iter_mut().zip(q.iter()).zip(work.shift.iter()) {
                *next = q + sigma * shift;
            }
            &work.next
        };
        let midpoints = Placed { step, inverse, q, origin, increment, trial, weights, point, gradient };
        repeat(convergence, statistics, midpoints)?;
        work.increment.copy_from_slice(increment);
        node.gradient.copy_from_slice(gradient);
        norm::finite(increment)
    }

    /// The same from what rounding has left out of q0 too, until nothing is left to gain.
    fn compensated_fixed_point(
        &mut self,
        carried: &Carried<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, q, defect, history, inverse, l_d, work, budget, .. } = self;
        let Work { increment, trial, weights, shift, next: total, .. } = &mut **work;
        if defect.is_none() {
            shift.fill(T::lift(0.0));
        }
        history.extrapolate(increment);
        let convergence = Convergence::fixed_point(step.method.stopping.exhaustive(), *budget);
        iterate(convergence, statistics, |due, statistics| {
            due.prepare(step.system, weights, q, increment);
            for ((total, &shift), &s) in total.iter_mut().zip(shift.iter()).zip(increment.iter()) {
                *total = step.method.sigma * (shift + s);
            }
            carried.add(q, total, &mut l_d.work.point);
            step.system.hamiltonian_gradient(&l_d.work.point, step.node_time(), &mut l_d.work.gradient);
            statistics.gradients += 1;
            inverse.solve(step.system, &l_d.work.gradient, trial);
            Ok(sizes::renew(weights, increment, trial))
        })?;
        norm::finite(increment)
    }

    /// Newton on Δ, of which s and ∇H(q_σ) are left as the fixed point does.
    #[inline]
    fn newton(
        &mut self,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, q, defect, one_form, history, l_d, work, .. } = self;
        guess.begin(&mut work.increment, |increment| history.extrapolate(increment));
        step.system.one_form(q, step.t, one_form);
        work.next.copy_from_slice(one_form);
        if let Some(defect) = defect {
            add_to(&mut work.next, defect);
            add_to(&mut work.increment, &work.shift);
        }
        let Work { increment, next: p0, trial, weights, .. } = &mut **work;
        let (points, storage) = ([&***q, &**p0], (solver, [trial, weights]));
        let stopping = step.method.stopping;
        solve_by_newton(
            *l_d,
            step.system,
            step.interval(),
            points,
            increment,
            storage,
            stopping,
            statistics,
        )?;
        if !step.method.is_midpoint() {
            l_d.place(step.interval(), Ends { q0: q, delta: &work.increment });
            let node = &mut l_d.work;
            step.system.hamiltonian_gradient(&node.point, step.node_time(), &mut node.gradient);
            statistics.gradients += 1;
        }
        if defect.is_some() {
            for (delta, &shift) in work.increment.iter_mut().zip(work.shift.iter()) {
                *delta -= shift;
            }
        }
        Ok(())
    }
}

/// The fixed point as it is iterated. Long vectors are passed over once: each block of the next point is
/// placed as soon as its s is known.
struct Placed<'a, S: DegenerateLagrangian<T>, T: Real> {
    step: &'a Step<'a, S, T>,
    inverse: &'a Inverse<S, T>,
    q: &'a [T],
    origin: &'a [T],
    increment: &'a mut [T],
    trial: &'a mut [T],
    weights: &'a mut [T],
    point: &'a mut [T],
    gradient: &'a mut [T],
}

impl<S: DegenerateLagrangian<T>, T: Real> Placed<'_, S, T> {
    const IS_LONG: bool = !<S::Space as Space>::ON_STACK;
}

impl<S: DegenerateLagrangian<T>, T: Real> Iteration<T> for Placed<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        due.prepare(self.step.system, self.weights, self.q, self.increment);
        if Self::IS_LONG {
            place([self.origin, self.increment], self.step.method.sigma, self.point);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Self { step, inverse, origin, increment, trial, weights, point, gradient, .. } = self;
        let (system, sigma, time) = (step.system, step.method.sigma, step.node_time());
        if !Self::IS_LONG {
            place([origin, increment], sigma, point);
        }
        apart_if(
            Self::IS_LONG,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || system.hamiltonian_gradient(point, time, gradient),
        );
        let mut largest = T::lift(0.0);
        inverse.solve_in_blocks(
            system,
            gradient,
            trial,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |block, s| {
                let (origin, increment) = (&origin[block.clone()], &mut increment[block.clone()]);
                largest = norm::larger(largest, sizes::renew(&weights[block.clone()], increment, s));
                if Self::IS_LONG {
                    place([origin, increment], sigma, &mut point[block]);
                }
            },
        );
        Ok(largest)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self, times: u64, statistics: &mut Statistics) {
        statistics.gradients += times;
    }
}

/// Sets `point` to `origin` + σs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn place<T: Real>([origin, s]: [&[T]; 2], sigma: T, point: &mut [T]) {
    for ((point, &origin), &s) in point.iter_mut().zip(origin).zip(s) {
        *point = origin + sigma * s;
    }
}

fn add_to<T: Real>(sum: &mut [T], terms: &[T]) {
    for (sum, &term) in sum.iter_mut().zip(terms) {
        *sum += term;
    }
}

/// Moves to q1 = q0 + K⁻¹c0 + s and updates the defect.
#[cfg_attr(not(debug_assertions), inline(always))]
fn finish<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
) -> Result<(), StepFailure> {
    let SigmaMemory { defect, history, product, l_d, work, carried, defect_vanishes, .. } = memory;
    if *defect_vanishes {
        advance(step, q, &work.increment, carried, &mut work.next)?;
        history.push(&work.increment);
        return Ok(());
    }
    for ((delta, &s), &shift) in work.trial.iter_mut().zip(work.increment.iter()).zip(work.shift.iter()) {
        *delta = shift + s;
    }
    advance(step, q, &work.trial, carried, &mut work.next)?;
    history.push(&work.increment);
    match product {
        None => defect.iter_mut().for_each(|c| *c = -*c),
        Some(product) => {
            product.apply(step.system, &work.trial, defect);
            let right = step.method.sigma * step.h;
            for (c, &g) in defect.iter_mut().zip(l_d.work.gradient.iter()) {
                *c -= right * g;
            }
        }
    }
    Ok(())
}
