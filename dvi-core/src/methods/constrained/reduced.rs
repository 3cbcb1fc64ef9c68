//! The step of the trapezoidal rule for its impulses alone, where L is separable: RATTLE.
//!
//! p½ = p0 + (h/2)F(q0) + G(q0)ᵀι0      q1 = q0 + h M⁻¹p½, with g(q1) = 0
//! p1 = p½ + (h/2)F(q1) + G(q1)ᵀι1, with G(q1) M⁻¹p1 + ∂g/∂t = 0
//!
//! h ι0 is found by Newton's method, whose matrix is G(q1) M⁻¹ G(q0)ᵀ, and ι1 from linear equations with
//! G(q1) M⁻¹ G(q1)ᵀ. Steps are looked at quickly: what passes would pass a close look too. The step for all
//! unknowns takes those that do not, and says why they fail.
//!
//! A fast path: a step of a mass on a sphere takes 286 instructions and 42 ns, and for all unknowns 8189 and
//! 529 ns (`cargo bench -p dvi-kernels --bench instructions`, with this path and without).

mod arrival;
mod place;
mod rows;

use super::memory::Impulses;
use crate::mechanics::constraints::{ConstrainedLagrangian, ConstraintSolver};
use crate::mechanics::mass::Mass;
use crate::memory::{Memory, lasting};
use crate::methods::{Clock, Steps};
use crate::scalar::norm;
use crate::scalar::passes::multiply;
use crate::solve::Stopping;
use crate::space::SquareMatrix;
use crate::state::Statistics;
use crate::{ConstrainedSystem, Real, Space, Vector};
use arrival::Begin;
use place::{Arrival, Place};
use rows::{combine, fill};

/// With more constraints the equations for all unknowns are cheaper.
const FEW: usize = 10;

/// With more entries of G a step has its work space in the run, and else on the stack, where it can stay in
/// registers.
const SHORT: usize = 64;

/// Where a run is that takes such steps, and work space.
#[derive(Debug)]
pub(super) struct Reduced<S: ConstrainedSystem, T: Real> {
    pub(super) here: Place<S, T>,
    pub(super) mass: Mass<S, T>,
    /// Whether the determinant of G M⁻¹ Gᵀ is positive where the run begins.
    is_positive: bool,
    /// Whether such steps are taken: not where a coordinate is light against others where the run begins,
    /// as rounding errors of its large momenta within a step would be velocities across the constraints.
    pub(super) is_open: bool,
    work: Arrival<S, T>,
}

lasting!([S: ConstrainedSystem, T: Real] Reduced<S, T>, T; part here, flag is_positive, flag is_open);

impl<S: ConstrainedLagrangian<T>, T: Real> Reduced<S, T> {
    /// At (`q`, `v`, `t`) with the momentum `p`; `None` where steps for all unknowns are better: with many
    /// constraints, and with a mass matrix that is diagonal and not positive.
    pub(super) fn new(
        system: &S,
        solver: &ConstraintSolver<S, T>,
        [q, v, p]: [&[T]; 3],
        t: T,
    ) -> Option<Self> {
        let mass = Mass::new(system, q, t).ok()?;
        let are_positive = |all: &[T]| all.iter().all(|&one| one > T::lift(0.0));
        if system.multipliers().dimension() > FEW || !mass.reciprocals().is_none_or(are_positive) {
            return None;
        }
        let (here, work) = (Place::new(system), Arrival::new(system));
        let is_open = !solver.has_light_coordinates(system, [q, v], t);
        let mut new = Self { here, mass, is_positive: true, is_open, work };
        new.stand(system, [q, p], t, &system.multipliers().vectors());
        let (Place { rows, solved, squares, .. }, gram) = (&new.here, &mut new.work.gram);
        fill(gram, [rows, solved], squares);
        new.is_open &= gram.factor().is_ok();
        new.is_positive = gram.is_positive();
        Some(new)
    }

    /// Moves to a point with the momentum p, where a step with these impulses has led.
    #[inline]
    pub(super) fn stand(&mut self, system: &S, [q, p]: [&[T]; 2], t: T, impulses: &Impulses<S, T>) {
        let Self { here, mass, work, .. } = self;
        here.p.copy_from_slice(p);
        for (impulse, last) in here.impulses.iter_mut().zip(impulses) {
            impulse.copy_from_slice(last);
        }
        system.force(q, &[], t, &mut here.force);
        here.constrain(system, q, t, &mut work.values);
        here.measure(mass);
    }

    /// Sets `bend` to Δ − h v0 of a step of length `h` with the last impulse.
    #[inline]
    pub(super) fn bend(&self, h: T, bend: &mut [T]) {
        let Place { force, rows, impulses, .. } = &self.here;
        bend.iter_mut().zip(force.iter()).for_each(|(bend, &force)| *bend = T::lift(0.5) * h * force);
        combine(rows, &impulses[0], bend);
        self.mass.solve_in_place(bend);
        multiply(bend, h);
    }

    /// Takes steps as long as they succeed from the guess that the last one gives, whose length was `last`,
    /// and returns how many; none at all, if they lead to what is no number. What no other function sees may
    /// stay in registers.
    #[inline]
    pub(super) fn stride(
        &mut self,
        steps: Steps<'_, S, T>,
        stopping: Stopping,
        last: &mut T,
    ) -> Option<u64> {
        let Steps { system, q, clock, count, statistics } = steps;
        let Self { here, mass, is_positive, is_open, work } = self;
        if !*is_open {
            return None;
        }
        let h = clock.step_size();
        // The impulse is guessed to be so many times that of the last step.
        let ratio = if *last == T::lift(0.0) { T::lift(0.0) } else { h / *last };
        let entries = system.space().dimension() * system.multipliers().dimension();
        let is_short =
            <S::Space as Space>::ON_STACK && <S::Multipliers as Space>::ON_STACK && entries <= SHORT;
        let walk = Walk { system, mass, is_positive: *is_positive, stopping, clock, count };
        let (taken, iterations) = if is_short {
            let (mut at, mut from, mut work) = (q.clone(), Place::new(system), Arrival::new(system));
            from.restore(here);
            multiply(&mut from.impulses[0], ratio);
            let walked = walk.along::<false>(&mut at, &mut from, &mut work, T::lift(1.0));
            if walked.0 > 0 {
                norm::finite(&from.p).and(norm::finite(&at)).ok()?;
                q.copy_from_slice(&at);
                here.restore(&from);
            }
            walked
        } else {
            walk.along::<true>(q, here, work, ratio)
        };
        if taken > 0 {
            *last = h;
            statistics.gradients += taken;
            statistics.iterations += iterations;
        }
        Some(taken)
    }
}

/// Steps to take.
struct Walk<'a, S: ConstrainedSystem, T: Real> {
    system: &'a S,
    mass: &'a Mass<S, T>,
    is_positive: bool,
    stopping: Stopping,
    clock: Clock<T>,
    count: u64,
}

impl<S: ConstrainedLagrangian<T>, T: Real> Walk<'_, S, T> {
    /// How many of them succeed, and in how many iterations. With `CHECKS` what is no number ends them.
    #[inline]
    fn along<const CHECKS: bool>(
        &self,
        at: &mut Vector<S, T>,
        from: &mut Place<S, T>,
        work: &mut Arrival<S, T>,
        mut ratio: T,
    ) -> (u64, u64) {
        let Self { system, mass, is_positive, stopping, clock, count } = *self;
        let (mut taken, mut iterations) = (0, 0);
        while taken < count {
            let (t, h) = (clock.after(taken).time(), clock.step_size());
            let begin = Begin { system, mass, is_positive, q: at, here: from, t, h, stopping };
            let mut of_step = Statistics::default();
            for (impulse, &last) in work.place.impulses[0].iter_mut().zip(from.impulses[0].iter()) {
                *impulse = ratio * last;
            }
            if work.shake(&begin, &mut of_step).and_then(|()| work.rattle(&begin)).is_none() {
                break;
            }
            if CHECKS && norm::finite(&work.place.p).and(norm::finite(&work.q)).is_err() {
                break;
            }
            at.copy_from_slice(&work.q);
            from.restore(&work.place);
            iterations += of_step.iterations;
            taken += 1;
            ratio = T::lift(1.0);
        }
        (taken, iterations)
    }
}
