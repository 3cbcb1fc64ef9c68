//! Where a run is, and how it takes a step: many with a quick look at each, in registers, or one with a
//! close look.

use super::arrival::{Arrival, Begin, Place};
use super::{Rattle, RattleMemory};
use crate::error::StepFailure;
use crate::memory::{Memory, lasting};
use crate::methods::{Step, Steps};
use crate::scalar::norm;
use crate::solve::{Convergence, Guess, Quick, from_either_guess};
use crate::state::Statistics;
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Separable, Space};

/// What is kept of a point of the run, and what the next step is guessed from.
#[derive(Debug)]
pub(super) struct Point<S: ConstrainedSystem, T: Real> {
    pub(super) here: Place<S, T>,
    pub(super) last_step: T,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Point<S, T> {
    lasting!(T; part here, number last_step);
}

impl<S: ConstrainedSystem, T: Real> Point<S, T> {
    pub(super) fn new(system: &S) -> Self {
        Self { here: Place::new(system), last_step: T::lift(0.0) }
    }

    /// The impulse of a step of length `h` is guessed to be so many times that of the last one.
    fn ratio(&self, h: T) -> T {
        let zero = T::lift(0.0);
        if self.last_step == zero { zero } else { h / self.last_step }
    }
}

/// With more entries of G a step has its work space in the run, and else on the stack, where it can stay in
/// registers.
const SHORT: usize = 64;

impl<S: ConstrainedSystem, T: Real> RattleMemory<S, T> {
    /// Whether steps may be taken on the stack. All but the last two questions are answered when compiled.
    pub(super) fn strides(&self, system: &S) -> bool
    where
        S: HolonomicLagrangian<T>,
    {
        let entries = system.space().dimension() * system.multipliers().dimension();
        let is_short =
            <S::Space as Space>::ON_STACK && <S::Multipliers as Space>::ON_STACK && entries <= SHORT;
        is_short && self.refinement.is_none() && self.is_metric == S::DIAGONAL_MASS
    }
}

impl Rattle {
    /// Takes steps with a quick look at each as long as they succeed from the guess that the last one gives,
    /// at most `count`, and returns how many; none at all, if they lead to what is no number. What no other
    /// function sees may stay in registers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn stride<S: HolonomicLagrangian<T> + Separable<T>, T: Real>(
        &self,
        steps: Steps<'_, S, T>,
        memory: &mut RattleMemory<S, T>,
    ) -> Option<u64> {
        let Steps { system, q, clock, count, statistics } = steps;
        let RattleMemory { point, mass, is_positive, .. } = memory;
        let (is_metric, is_positive) = (S::DIAGONAL_MASS, *is_positive);
        let (h, stopping) = (clock.step_size(), self.stopping);
        let (mut at, mut from, mut work) = (q.clone(), Point::new(system), Arrival::new(system));
        from.restore(point);
        // The last impulse is the guess: of the first step, as if that one had been as long.
        let ratio = from.ratio(h);
        from.here.impulses.first.iter_mut().for_each(|impulse| *impulse *= ratio);
        let trusts_pivot = is_metric && system.multipliers().dimension() == 1;
        let (mut taken, mut iterations) = (0, 0);
        while taken < count {
            let (t, q, here) = (clock.after(taken).time(), &at, &from.here);
            let begin =
                Begin { system, mass, is_metric, is_positive, trusts_pivot, q, here, t, h, stopping };
            work.guess(T::lift(1.0), &from.here.impulses.first);
            let mut of_step = Statistics::default();
            let shaken = work.shake::<Quick<T>>(&begin, &mut of_step);
            if shaken.and_then(|()| work.rattle::<Quick<T>>(&begin)).is_err() {
                break;
            }
            at.copy_from_slice(&work.q);
            from.here.restore(&work.place);
            iterations += of_step.iterations;
            taken += 1;
        }
        if taken > 0 {
            norm::finite(&from.here.p).and(norm::finite(&at)).ok()?;
            from.last_step = h;
            q.copy_from_slice(&at);
            point.restore(&from);
            statistics.gradients += taken;
            statistics.iterations += iterations;
        }
        Some(taken)
    }

    /// Takes a step with a close look, in the work space of the run.
    #[inline(never)]
    pub(super) fn take<S: HolonomicLagrangian<T> + Separable<T>, T: Real>(
        &self,
        step: Step<'_, S, T>,
        memory: &mut RattleMemory<S, T>,
    ) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let RattleMemory { point, mass, is_metric, is_positive, refinement, work } = memory;
        let (here, stopping, trusts_pivot) = (&point.here, self.stopping, false);
        let (is_metric, is_positive) = (*is_metric, *is_positive);
        let begin = Begin { system, mass, is_metric, is_positive, trusts_pivot, q, here, t, h, stopping };
        // Newton's method finds the nearest of several solutions: from the last impulse, and else from none.
        from_either_guess(|guess| {
            let ratio = match guess {
                Guess::Extrapolated => point.ratio(h),
                Guess::Zero => T::lift(0.0),
            };
            work.guess(ratio, &point.here.impulses.first);
            work.shake::<Convergence<T>>(&begin, statistics)
        })?;
        work.rattle::<Convergence<T>>(&begin)?;
        statistics.gradients += 1;
        if let Some(refinement) = refinement {
            work.refine(system, mass, t + h, refinement)?;
        }
        q.copy_from_slice(&work.q);
        point.here.restore(&work.place);
        point.last_step = h;
        Ok(())
    }
}
