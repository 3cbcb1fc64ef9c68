//! Steps that are looked at where they end, and taken back where they must not lead.
//!
//! A formula may be no number beyond some place, and its derivative still be one, as that of a logarithm is;
//! and a step that ends there needs nothing of its end, if it is one of the midpoint rule. Of a system with
//! such a formula the domain is looked at where each step ends. Many steps are kept at once: from where they
//! have begun they are taken again up to the last good one.
//!
//! Of a system whose time is transformed the physical time goes on in each step, and it still does at the
//! end. A motion reaches no zero of ρ = dt/dτ in a finite τ, so a step that crosses one is an error of its
//! length. A step that ends where ρ is not positive is taken back, and one in which the physical time runs
//! backwards because ρ was negative in between.

use crate::error::StepFailure;
use crate::methods::{Clock, Method, Step};
use crate::run::Stepper;
use crate::scalar::norm::reported;
use crate::system::start::extended;
use crate::{Lagrangian, Real};

/// How many steps are taken before the next point is kept.
const BLOCK: u64 = 64;

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<S, M, T> {
    /// Takes `count` steps from the present time of `clock`, or as many as succeed and lead where they may.
    pub(super) fn steps_seen(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        // The physical time is compared with that at the start of each step.
        let block = if S::TIME_TRANSFORMED { 1 } else { BLOCK };
        let (mut taken, mut end, mut lost) = (0, count, None);
        while taken < end {
            let (begun, before) = (taken, self.statistics);
            self.keep();
            let last = end.min(begun + block);
            while taken < last {
                // At one place, where it is put in line.
                let Self { method, memory, q, statistics, .. } = self;
                let (t, h) = (clock.after(taken).time(), clock.step_size());
                method.step(Step { system, q, t, h, statistics }, memory)?;
                statistics.steps += 1;
                taken += 1;
                if let Err(failure) = self.look(system, clock.after(taken)) {
                    // Up to there steps have succeeded, and are taken once more.
                    self.go_back();
                    self.statistics = before;
                    (lost, end, taken) = (Some(failure), taken - 1, begun);
                    break;
                }
            }
        }
        lost.map_or(Ok(()), Err)
    }

    /// Keeps the present point, if steps may be taken back.
    #[inline]
    pub(super) fn keep(&mut self) {
        if let Some(kept) = &mut self.kept {
            kept.take(&self.q, &self.memory);
        }
    }

    /// Goes back to the point that was kept last, without allocation.
    pub(super) fn go_back(&mut self) {
        if let Some(kept) = &self.kept {
            kept.go_back(&mut self.q, &mut self.memory);
        }
    }

    /// Whether a step may end at the present state, at the time of `clock`.
    ///
    /// # Errors
    /// [`StepFailure::TimeRate`] and [`StepFailure::LeftDomain`].
    #[inline]
    pub(super) fn look(&self, system: &S, clock: Clock<T>) -> Result<(), StepFailure> {
        if S::TIME_TRANSFORMED
            && let Some(kept) = &self.kept
        {
            let [time, _] = extended(system);
            let mean = (self.q[time] - kept.q[time]) / clock.step_size();
            let rate = system.time_transform(&self.q).map_or(mean, |transform| transform.rate);
            // What is not a number is not positive.
            let leads_forward = mean > T::lift(0.0) && rate > T::lift(0.0);
            if !leads_forward {
                let least = if mean < rate { mean } else { rate };
                return Err(StepFailure::TimeRate { rate: reported(least) });
            }
        }
        if S::HAS_DOMAIN && !system.domain(&self.q, clock.time()).is_finite() {
            return Err(StepFailure::LeftDomain);
        }
        Ok(())
    }
}
