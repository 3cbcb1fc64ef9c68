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

use crate::error::{StartError, StepFailure};
use crate::memory::{Aside, Memory};
use crate::methods::{Carries, Clock, Method, Step};
use crate::run::Stepper;
use crate::scalar::norm::reported;
use crate::system::start::extended;
use crate::{Lagrangian, Real, System, Vector};

/// Where the steps at hand have begun.
pub(super) struct Kept<S: System, M: Carries<S, T>, T: Real> {
    pub(super) q: Vector<S, T>,
    pub(super) memory: M::Memory,
}

/// How many steps are taken before the next point is kept.
const BLOCK: u64 = 64;

impl<S: Lagrangian<T>, M: Carries<S, T>, T: Real> Kept<S, M, T> {
    /// For a run from `q` whose memory `begin` makes.
    ///
    /// # Errors
    /// Those of `begin`.
    pub(super) fn new(
        q: &Vector<S, T>,
        begin: impl FnOnce() -> Result<M::Memory, StartError>,
    ) -> Result<Self, StartError> {
        Ok(Self { q: q.clone(), memory: begin()? })
    }

    /// The same, if the steps of its system are looked at.
    ///
    /// # Errors
    /// Those of `begin`.
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn if_looked_at(
        q: &Vector<S, T>,
        begin: impl FnOnce() -> Result<M::Memory, StartError>,
    ) -> Result<Option<Aside<Self>>, StartError> {
        if !(S::TIME_TRANSFORMED || S::HAS_DOMAIN) {
            return Ok(None);
        }
        Ok(Some(Self::new(q, begin)?.into()))
    }
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<S, M, T> {
    /// Takes `count` steps from the present time of `clock`, or as many as succeed and lead where they may.
    pub(super) fn steps_looked_at(
        &mut self,
        system: &S,
        clock: Clock<T>,
        count: u64,
        mut kept: Option<&mut Kept<S, M, T>>,
    ) -> Result<(), StepFailure> {
        // The physical time is compared with that at the start of each step.
        let block = if S::TIME_TRANSFORMED { 1 } else { BLOCK };
        let (mut taken, mut end, mut lost) = (0, count, None);
        while taken < end {
            let (begun, before) = (taken, self.statistics);
            if let Some(kept) = &mut kept {
                self.keep(kept);
            }
            let last = end.min(begun + block);
            while taken < last {
                // At one place, where it is put in line.
                let Self { method, memory, q, statistics, .. } = self;
                let (t, h) = (clock.after(taken).time(), clock.step_size());
                method.step(Step { system, q, t, h, statistics }, memory)?;
                statistics.steps += 1;
                taken += 1;
                if let Err(failure) = self.look(system, clock.after(taken), kept.as_deref()) {
                    let Some(kept) = &kept else { return Err(failure) };
                    // Up to there steps have succeeded, and are taken once more.
                    self.return_to(kept);
                    self.statistics = before;
                    (lost, end, taken) = (Some(failure), taken - 1, begun);
                    break;
                }
            }
        }
        lost.map_or(Ok(()), Err)
    }

    pub(super) fn keep(&self, kept: &mut Kept<S, M, T>) {
        kept.q.copy_from_slice(&self.q);
        kept.memory.restore(&self.memory);
    }

    pub(super) fn return_to(&mut self, kept: &Kept<S, M, T>) {
        self.q.copy_from_slice(&kept.q);
        self.memory.restore(&kept.memory);
    }

    /// Whether a step may end at the present state, at the time of `clock`, where it has begun at `kept`.
    ///
    /// # Errors
    /// [`StepFailure::TimeRate`] and [`StepFailure::LeftDomain`].
    #[inline]
    pub(super) fn look(
        &self,
        system: &S,
        clock: Clock<T>,
        kept: Option<&Kept<S, M, T>>,
    ) -> Result<(), StepFailure> {
        if S::TIME_TRANSFORMED
            && let Some(kept) = kept
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
