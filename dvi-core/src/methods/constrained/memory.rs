//! Where a constrained run is, and its step for all unknowns.

use super::reduced::Reduced;
use crate::discrete::{Departing, DiscreteLagrangian, Ends, Interval, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::turning::Gradients;
use crate::mechanics::constraints::{
    At, Bordered, ConstrainedLagrangian, ConstraintSolver, Constraints, Lower, Multipliers, Tangent,
};
use crate::mechanics::orientation::MassOrientation;
use crate::memory::{Aside, Memory, lasting};
use crate::methods::{Step, Steps};
use crate::scalar::norm;
use crate::solve::{AtIncrement, Due, Guess, Stopping, from_either_guess, newton, sizes};
use crate::state::Statistics;
use crate::state::rates::is_similar;
use crate::{ConstrainedSystem, Real, Scalar, Space, Vector};

/// Where a constrained run is, what its next step is guessed from, and work space.
#[derive(Debug)]
pub struct ConstrainedMemory<S: ConstrainedSystem, L, T: Real> {
    here: Place<S, T>,
    /// Δ − h v0 of the last step, and h.
    bend: Vector<S, T>,
    last_step: T,
    /// Of constraints of positions.
    gradients: Option<Gradients<S, T>>,
    /// Whether the determinant of the equations for the velocity is positive.
    is_positive: bool,
    /// If the mass matrix depends on the state.
    orientation: Option<MassOrientation<S, T>>,
    l_d: L,
    solver: ConstraintSolver<S, T>,
    arrival: Arrival<S, T>,
    /// Where the run is instead of `here`, if its steps are solved for the impulses alone and that is open.
    reduced: Option<Aside<Reduced<S, T>>>,
}

/// The impulses of the constraints at both ends of a step.
pub(super) type Impulses<S, T> = [Multipliers<S, T>; 2];

/// The momentum and the velocity at a point of a run, and the impulses of the step that has led there.
#[derive(Debug)]
struct Place<S: ConstrainedSystem, T: Real> {
    p: Vector<S, T>,
    v: Vector<S, T>,
    impulses: Impulses<S, T>,
}

/// The end of a step as it is being found.
#[derive(Debug)]
struct Arrival<S: ConstrainedSystem, T: Real> {
    increment: Vector<S, T>,
    /// In which the iteration judges coordinates.
    weights: Vector<S, T>,
    q: Vector<S, T>,
    place: Place<S, T>,
    work: Vector<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    fn new(system: &S) -> Self {
        let [p, v] = system.space().vectors();
        Self { p, v, impulses: system.multipliers().vectors() }
    }
}

impl<S: ConstrainedSystem, L, T: Real> ConstrainedMemory<S, L, T> {
    /// The discrete momentum at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        self.open().map_or(&self.here.p, |reduced| &reduced.here.p)
    }

    fn open(&self) -> Option<&Aside<Reduced<S, T>>> {
        self.reduced.as_ref().filter(|reduced| reduced.is_open)
    }

    /// The Lagrange multipliers λ of the last step, one for each constraint, so that G(q)ᵀλ is the force of
    /// the constraints. With a symmetric rule they are those in the middle of the step, to order h². Zero
    /// before the first.
    pub fn multipliers(&self) -> impl Iterator<Item = T> + '_ {
        let [first, last] = self.impulses();
        let (h, zero) = (self.last_step, T::lift(0.0));
        first.iter().zip(last).map(move |(&first, &last)| if h == zero { zero } else { (first + last) / h })
    }

    /// The impulses G(q)ᵀι of the constraints at the beginning and at the end of the last step, as numbers
    /// ι, one for each constraint.
    pub fn impulses(&self) -> [&[T]; 2] {
        let here = &self.here.impulses;
        self.open().map_or(here, |reduced| &reduced.here.impulses).each_ref().map(|ends| &ends[..])
    }
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Place<S, T> {
    lasting!(T; numbers p, numbers v, vectors impulses);
}

impl<S: ConstrainedSystem, L, T: Real> Memory<T> for ConstrainedMemory<S, L, T> {
    lasting!(
        T; part here, numbers bend, number last_step, part solver, parts gradients, parts orientation,
        parts reduced
    );
}

impl<S: ConstrainedLagrangian<T>, L: DiscreteLagrangian<S, T>, T: Real> ConstrainedMemory<S, L, T> {
    /// At (`q`, `v`, `t`).
    pub(super) fn new(system: &S, l_d: L, [q, v]: [&[T]; 2], t: T) -> Result<Self, StartError> {
        let [bend, increment, weights, next, mut work] = system.space().vectors();
        let (mut here, mut solver) = (Place::new(system), ConstraintSolver::new(system, q, v, t));
        let Place { p, v: velocity, impulses: [_, impulse] } = &mut here;
        system.gradient(q, v, t, &mut work, p);
        velocity.copy_from_slice(v);
        let tangent = Tangent { p, v: velocity, impulse, work: &mut work };
        solver.tangent(system, At { q, t }, tangent).map_err(StartError::Starter)?;
        impulse.fill(T::lift(0.0));
        let orientation = (!S::CONSTANT_MASS).then(|| MassOrientation::new(system, q, v, t));
        Ok(Self {
            here,
            bend,
            last_step: T::lift(0.0),
            gradients: S::Kind::OF_POSITIONS.then(|| Gradients::new(system, At { q, t }, v)),
            is_positive: solver.is_positive(),
            orientation: orientation.transpose().map_err(StartError::Starter)?,
            l_d,
            solver,
            arrival: Arrival { increment, weights, q: next, place: Place::new(system), work },
            reduced: None,
        })
    }

    /// Solves the steps of Störmer and Verlet for the impulses alone from (`q`, `v`, `t`) on, if that can be
    /// done.
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn reduce(&mut self, system: &S, [q, v]: [&[T]; 2], t: T) {
        self.reduced = Reduced::new(system, &self.solver, [q, v, &self.here.p], t).map(Aside::from);
    }

    /// Sets `v` to the velocity where the run is.
    pub(super) fn velocity(&self, v: &mut [T]) {
        match self.open() {
            Some(reduced) => reduced.mass.solve(&reduced.here.p, v),
            None => v.copy_from_slice(&self.here.v),
        }
    }

    /// Takes steps for the impulses alone, as [`Reduced::stride`]; none if they are not reduced.
    #[inline(never)]
    pub(super) fn stride(&mut self, steps: Steps<'_, S, T>, stopping: Stopping) -> Option<u64> {
        self.reduced.as_mut()?.stride(steps, stopping, &mut self.last_step)
    }

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
        newton(stopping, statistics, |due, statistics| {
            due.prepare(system, weights, q, increment);
            statistics.linearizations += 1;
            statistics.factorisations += 1;
            let span = Span { system, interval, ends: Ends { q0: q, delta: increment } };
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
        for ((next, &q), &delta) in next.iter_mut().zip(q).zip(increment.iter()) {
            *next = q + delta;
        }
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
        let span = Span { system, interval, ends: Ends { q0: q, delta: increment } };
        l_d.derivatives(span, work, p, statistics)?;
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
