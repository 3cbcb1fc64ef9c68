//! The step for all unknowns: Newton's method for Δ and ι0, and the tangent at the end for v1 and ι1.

use super::memory::{Arrival, ConstrainedMemory, Place};
use crate::discrete::quadrature::Rule;
use crate::discrete::{Departing, Interval, Span};
use crate::error::StepFailure;
use crate::mechanics::constraints::{At, Bordered, ConstrainedLagrangian, Lower, Tangent};
use crate::memory::Memory;
use crate::methods::Step;
use crate::scalar::{norm, passes};
use crate::solve::{AtIncrement, Due, Guess, Stopping, from_either_guess, newton, sizes};
use crate::state::Statistics;
use crate::state::rates::is_similar;
use crate::{Real, Scalar};

impl<S: ConstrainedLagrangian<T>, R: Rule, T: Real> ConstrainedMemory<S, R, T> {
    /// Takes a step for all unknowns.
    #[inline(never)]
    pub(super) fn take(&mut self, step: Step<'_, S, T>, stopping: Stopping) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let interval = Interval { t, h };
        self.stand();
        from_either_guess(|guess| {
            self.guess(h, guess);
            self.solve((system, q), interval, stopping, statistics)
        })?;
        self.arrive((system, q), interval, statistics)?;
        self.keep(system, q, [t, h]);
        Ok(())
    }

    /// Goes to where the run is.
    fn stand(&mut self) {
        let Self { here: Place { p, v, impulses }, bend, last_step, reduced, .. } = self;
        let Some(reduced) = reduced.as_ref().filter(|reduced| reduced.is_open) else { return };
        p.copy_from_slice(&reduced.here.p);
        reduced.mass.solve(p, v);
        for (impulse, last) in impulses.iter_mut().zip(&reduced.here.impulses) {
            impulse.copy_from_slice(last);
        }
        reduced.bend(*last_step, bend);
    }

    /// Sets Δ to a guess: that of the velocity, bent as in the step before. Newton's method finds the
    /// nearest of several solutions, so that no guess is extrapolated far.
    fn guess(&mut self, h: T, guess: Guess) {
        let Self { here: Place { v, impulses, .. }, bend, last_step, arrival, .. } = self;
        let ratio = match guess {
            Guess::Extrapolated if is_similar(h, *last_step) => h / *last_step,
            Guess::Extrapolated | Guess::Zero => T::lift(0.0),
        };
        for ((delta, &v), &bend) in arrival.increment.iter_mut().zip(v.iter()).zip(bend.iter()) {
            *delta = h * v + ratio * ratio * bend;
        }
        for (impulse, &last) in arrival.place.impulses[0].iter_mut().zip(impulses[0].iter()) {
            *impulse = ratio * last;
        }
    }

    /// Improves Δ and ι0 until q1 is on the constraints, and on the branch of the motion.
    fn solve(
        &mut self,
        (system, q): (&S, &[T]),
        interval: Interval<T>,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { here: Place { p, .. }, l_d, solver, is_positive, gradients, arrival, .. } = self;
        let Arrival { increment, weights, q: next, place, work } = arrival;
        let [impulse, _] = &mut place.impulses;
        newton(stopping, statistics, &mut |due, statistics| {
            due.prepare(system, weights, q, increment);
            statistics.linearizations += 1;
            statistics.factorisations += 1;
            let span = Span { system, interval, q0: q, delta: increment };
            let departing = &mut Departing { l_d, system, interval, q0: q };
            let upper = AtIncrement { equations: departing, p0: p, delta: increment, statistics };
            let lower = Lower::Step(span, [next, work]);
            let forces = Some(At { q, t: interval.t });
            let (multipliers, active) = (&**impulse, impulse.len());
            let equations = &mut Bordered { system, upper, lower, multipliers, forces, active };
            if *due == Due::Residual {
                let of = |k: usize| if k < q.len() { p[k] } else { T::lift(0.0) };
                let size = |k: usize| match k.checked_sub(q.len()) {
                    None => Scalar::abs(q[k]) + Scalar::abs(increment[k]),
                    Some(k) => impulse[k],
                };
                return solver.residual(equations, size, of);
            }
            solver.solve(equations, Scalar::abs(interval.h))?;
            solver.reduce(increment, impulse);
            Ok(sizes::largest(weights, solver.parts(q.len()).0))
        })?;
        passes::add(q, increment, next);
        norm::finite(next)?;
        // On the way from a step of no length the determinant of its equations changes its sign where
        // solutions meet.
        let is_odd = interval.h > T::lift(0.0) && (q.len() + impulse.len()) % 2 == 1;
        if solver.is_positive() != (*is_positive ^ is_odd) {
            return Err(StepFailure::Branch);
        }
        gradients.as_mut().map_or(Ok(()), |gradients| {
            let end = At { q: next, t: interval.time(T::lift(1.0)) };
            gradients.check(system, [At { q, t: interval.t }, end], increment)
        })
    }

    /// Finds p1 = p0 + (D₁ + D₂)L_d + G(q0)ᵀι0 + G(q1)ᵀι1 and v1.
    fn arrive(
        &mut self,
        (system, q): (&S, &[T]),
        interval: Interval<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { here: Place { p: p0, .. }, l_d, solver, arrival, orientation, .. } = self;
        let Arrival { increment, q: next, place, work, .. } = arrival;
        let Place { p, v, impulses: [first, last] } = place;
        p.fill(T::lift(0.0));
        work.fill(T::lift(0.0));
        let span = Span { system, interval, q0: q, delta: increment };
        l_d.derivatives(span, work, p, statistics);
        solver.add_impulse(system, At { q, t: interval.t }, first, p);
        for ((p, &p0), (v, &delta)) in p.iter_mut().zip(p0.iter()).zip(v.iter_mut().zip(increment.iter())) {
            *p += p0;
            *v = delta / interval.h;
        }
        let at = At { q: next, t: interval.time(T::lift(1.0)) };
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        solver.tangent(system, at, Tangent { p, v, impulse: last, work })?;
        orientation.as_mut().map_or(Ok(()), |orientation| orientation.check(system, next, v, at.t))
    }

    /// Moves to the end of the step.
    fn keep(&mut self, system: &S, q: &mut [T], [t, h]: [T; 2]) {
        let Self { here, bend, last_step, arrival, reduced, .. } = self;
        for ((bend, &delta), &v) in bend.iter_mut().zip(arrival.increment.iter()).zip(here.v.iter()) {
            *bend = delta - h * v;
        }
        q.copy_from_slice(&arrival.q);
        here.restore(&arrival.place);
        *last_step = h;
        if let Some(reduced) = reduced.as_mut().filter(|reduced| reduced.is_open) {
            reduced.stand(system, [q, &here.p], t + h, &here.impulses);
        }
    }
}
