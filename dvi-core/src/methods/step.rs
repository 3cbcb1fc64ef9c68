//! The step of equations for the increment Δ of a motion on T*Q,
//!
//! 0 = p0 + r(q0, Δ)      q1 = q0 + Δ      p1 = p0 + s(q0, Δ)
//!
//! A scheme says r, its derivative, and s: of a discrete Lagrangian r = D₁L_d and s = (D₁ + D₂)L_d. If L =
//! ½ v·M v − V(q, t), these are impulses I of forces, and what the interpolation makes of the kinetic
//! energy:
//!
//! r = I⁻ + M((A − K) q0 − KΔ)/h      s = I⁻ + I⁺ + M((A − K) q0 + (C − K) q1)/h
//!
//! What belongs to no scheme stands here: the guess of Δ; the fixed point Δ ← Δ + (h/κ)M⁻¹(p0 + r) where M
//! is constant, and Newton's method behind it or alone; what is looked at where a step ends; and the sums.

mod equations;
mod memory;

use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::phase::{Arrival, Inertial, PhasePoint};
use crate::scalar::norm;
use crate::scalar::passes::{add, blocks};
use crate::scalar::simd::wide_if;
use crate::solve::{Convergence, Guess, Ladder, Linearize, Stopping};
use crate::solve::{sizes, solve_by_fixed_point, solve_by_newton};
use crate::space::Sink;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{Lagrangian, Linear, NondegenerateLagrangian, Real, Space, System, Vector};

pub(super) use equations::{Begin, Equations, Kinetic, Share, set_force};

pub(super) use memory::{Carried, PhaseMemory, Work};

/// A step, and what it changes.
pub(super) struct Attempt<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) interval: Interval<T>,
    pub(super) stopping: Stopping,
    pub(super) summation: Summation,
    pub(super) q: &'a mut Vector<S, T>,
    pub(super) carried: &'a mut Carried<S, T>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> Attempt<'_, S, T> {
    /// Takes the step by what `ladder` has.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn take<E: Equations<S, T>>(
        self,
        equations: &mut E,
        ladder: &mut Ladder<Linear<S, T>>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        // A slow contraction is given up as soon as Newton's method would be cheaper.
        let budget = ladder.budget(self.stopping.max_iterations, 24 + self.q.len());
        ladder.solve(
            &mut (self, equations),
            statistics,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |(step, equations), statistics| {
                let criterion = (step.stopping, budget);
                match step.summation {
                    Summation::Plain => step.by_fixed_point::<true, E>(*equations, criterion, statistics),
                    Summation::Compensated => step.compensated(*equations, criterion, statistics),
                }
            },
            |(step, equations), solver, guess, statistics| {
                step.by_newton(*equations, solver, guess, statistics)
            },
        )
    }

    #[inline(never)]
    fn compensated<E: Equations<S, T>>(
        &mut self,
        equations: &mut E,
        criterion: (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.by_fixed_point::<false, E>(equations, criterion, statistics)
    }

    /// A step by the fixed point, with M as its matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn by_fixed_point<const PLAIN: bool, E: Equations<S, T>>(
        &mut self,
        equations: &mut E,
        criterion: (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, interval, q, carried, .. } = self;
        let Carried { phase, inertial, work } = &mut **carried;
        // What no other function sees may stay in registers.
        let mut on_stack;
        let work: &mut Work<S, T> = if <S::Space as Space>::ON_STACK {
            on_stack = Work::new(*system);
            &mut on_stack
        } else {
            work
        };
        wide_if!(!<S::Space as Space>::ON_STACK, {
            let begin = Begin { system: *system, interval: *interval, q, phase, mass: &inertial.mass };
            let mut coefficients = equations.begin(&begin, &mut work.node)?;
            let mut scheme = (equations, &mut coefficients);
            iterate_by_mass::<PLAIN, _, _, _>(&mut scheme, &begin, work, criterion, statistics)?;
            arrive::<PLAIN, _, _, _>(scheme, (*system, *interval), q, (phase, inertial), work, statistics)
        })
    }

    /// A step by Newton's method from a guess.
    #[inline(never)]
    fn by_newton<E: Equations<S, T>>(
        &mut self,
        equations: &mut E,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, interval, stopping, q, carried, .. } = self;
        let Carried { phase, inertial, work } = &mut **carried;
        let mass = &inertial.mass;
        let begin = Begin { system: *system, interval: *interval, q, phase, mass };
        let Work { node, increment, trial, weights, .. } = work;
        let coefficients = &mut equations.begin(&begin, node)?;
        match guess {
            Guess::Extrapolated => phase.guess(mass, interval.h, E::READS_VELOCITY, increment),
            Guess::Zero => increment.fill(T::lift(0.0)),
        }
        let mut posed = Posed { equations, coefficients, begin: &begin, node };
        let (points, storage) = ([&***q, &phase.p], (solver, [trial, weights]));
        let judge = Convergence::new(*stopping, stopping.max_iterations);
        solve_by_newton(&mut posed, *system, points, increment, storage, judge, statistics)?;
        arrive::<false, _, _, _>(
            (equations, coefficients),
            (*system, *interval),
            q,
            (phase, inertial),
            work,
            statistics,
        )
    }
}

/// Equations and their coefficients.
type WithCoefficients<'a, S, T, E> = (&'a mut E, &'a mut <E as Equations<S, T>>::Coefficients);

/// Sets the increment by the fixed point Δ ← Δ + (h/κ)M⁻¹(p0 + r), where M is constant.
#[cfg_attr(not(debug_assertions), inline(always))]
fn iterate_by_mass<const PLAIN: bool, S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>>(
    (equations, coefficients): &mut WithCoefficients<'_, S, T, E>,
    begin: &Begin<'_, S, T>,
    Work { node, increment, next, trial: impulse, weights, sum, .. }: &mut Work<S, T>,
    criterion: (Stopping, usize),
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let (h, is_explicit) = (begin.interval.h, S::SEPARABLE && equations.is_explicit());
    if !is_explicit {
        begin.phase.guess(begin.mass, h, E::READS_VELOCITY, increment);
    }
    solve_by_fixed_point(
        (begin.system, begin.q),
        [increment, next, weights],
        (!is_explicit).then_some(criterion),
        statistics,
        #[cfg_attr(not(debug_assertions), inline(always))]
        |[delta, change], weights, statistics| {
            if PLAIN {
                impulse.copy_from_slice(&begin.phase.p);
                equations.evaluate(begin, delta, Share::Left, (coefficients, node), impulse, statistics)?;
            } else {
                sum.fill(T::lift(0.0));
                equations.evaluate(begin, delta, Share::Left, (coefficients, node), sum, statistics)?;
                begin.phase.kick(sum, impulse);
            }
            let reciprocals = begin.mass.reciprocals();
            if reciprocals.is_none() {
                begin.mass.solve_in_place(impulse);
            }
            let Kinetic { mixed, left, per_stiffness, .. } = equations.kinetic(coefficients);
            let mut largest = T::lift(0.0);
            for block in blocks(delta.len()) {
                let (change, delta) = (&mut change[..block.len()], &mut delta[block.clone()]);
                let (impulse, q) = (&impulse[block.clone()], &begin.q[block.clone()]);
                let reciprocals = reciprocals.map(|reciprocals| &reciprocals[block.clone()]);
                for i in 0..change.len() {
                    let velocity = reciprocals.map_or(impulse[i], |reciprocals| impulse[i] * reciprocals[i]);
                    let mut missing = h * velocity;
                    if S::SEPARABLE && E::FITTED {
                        missing += left * q[i];
                    }
                    if S::SEPARABLE {
                        missing -= mixed * delta[i];
                    }
                    change[i] = missing * per_stiffness;
                }
                largest =
                    norm::larger(largest, sizes::improve(&weights[block], delta, change, sizes::added));
            }
            Ok(largest)
        },
    )
}

/// Moves to q1 = q0 + Δ and p1 = p0 + s; `PLAIN` says that sums are plain, where they need not be asked.
#[cfg_attr(not(debug_assertions), inline(always))]
fn arrive<const PLAIN: bool, S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>>(
    (equations, coefficients): WithCoefficients<'_, S, T, E>,
    (system, interval): (&S, Interval<T>),
    q: &mut Vector<S, T>,
    (phase, inertial): (&mut PhasePoint<S, T>, &mut Inertial<S, T>),
    Work { node, next, increment, trial: force, sum, .. }: &mut Work<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if PLAIN {
        add(q, increment, next);
    } else {
        phase.reach(q, increment, next);
    }
    let end = interval.time(T::lift(1.0));
    if S::SEPARABLE && equations.asks_ends() {
        set_force(system, next, end, force);
        statistics.gradients += 1;
    } else if S::SEPARABLE {
        force.copy_from_slice(&phase.force);
    }
    let begin = Begin { system, interval, q, phase, mass: &inertial.mass };
    sum.fill(T::lift(0.0));
    let share = Share::Both { force };
    equations.evaluate(&begin, increment, share, (coefficients, node), sum, statistics)?;
    if S::SEPARABLE && E::FITTED {
        let Kinetic { left, right, .. } = equations.kinetic(coefficients);
        for (v, (&q0, &q1)) in node.velocity.iter_mut().zip(q.iter().zip(next.iter())) {
            *v = left * q0 + right * q1;
        }
        begin.mass.multiply_add(T::lift(1.0) / interval.h, &node.velocity, sum);
    }
    if PLAIN {
        add(&phase.p, sum, &mut node.momentum);
    } else {
        phase.kick(sum, &mut node.momentum);
    }
    if !S::CONSTANT_MASS {
        norm::finite(next).and(norm::finite(&node.momentum))?;
        inertial.check(system, [next, increment], [end, interval.h], &mut node.velocity)?;
    }
    let to = Arrival { q: next, p: &node.momentum, force };
    if PLAIN {
        phase.advance_plainly(q, &to, increment, interval.h)
    } else {
        phase.advance(q, &to, [increment, sum], interval.h)
    }
}

/// Equations where a step begins, as Newton's method asks for them.
struct Posed<'a, 'b, S: Lagrangian<T>, T: Real, E: Equations<S, T>> {
    equations: &'a mut E,
    coefficients: &'a mut E::Coefficients,
    begin: &'a Begin<'b, S, T>,
    node: &'a mut NodeWork<S, T>,
}

impl<S: Lagrangian<T>, T: Real, E: Equations<S, T>> Linearize<T> for Posed<'_, '_, S, T, E> {
    fn linearize<K: Sink<T>>(
        &mut self,
        delta: &[T],
        r: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { equations, coefficients, begin, node } = self;
        equations.linearize(begin, delta, (coefficients, node), r, sink, statistics)
    }
}
