//! Steps of a system whose time is transformed: in each the physical time goes on, and it still does at the end.
//!
//! A motion reaches no zero of ρ = dt/dτ in a finite τ, so a step that crosses one is an error of its length. A step that ends
//! where ρ is not positive is taken back, and one in which the physical time runs backwards because ρ was negative in between.

use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, Clock, Method};
use crate::run::Stepper;
use crate::scalar::norm::reported;
use crate::state::memory::{Aside, Memory};
use crate::system::start::extended;
use crate::{Lagrangian, Real, System, Vector};

/// Where the step at hand has begun.
pub(super) struct Kept<S: System, M: Carries<S, T>, T: Real> {
    q: Vector<S, T>,
    memory: M::Memory,
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Kept<S, M, T> {
    /// For a run from `q` whose memory `begin` makes, if the time of its system is transformed.
    ///
    /// # Errors
    /// Those of `begin`.
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn for_transformed(
        q: &Vector<S, T>,
        begin: impl FnOnce() -> Result<M::Memory, StartError>,
    ) -> Result<Option<Aside<Self>>, StartError> {
        if !S::TIME_TRANSFORMED {
            return Ok(None);
        }
        Ok(Some(Self { q: q.clone(), memory: begin()? }.into()))
    }
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<'_, S, M, T> {
    /// Takes `count` steps from the present time of `clock`, or as many as succeed and lead forward in the physical time.
    pub(super) fn steps_forward(
        &mut self,
        clock: Clock<T>,
        count: u64,
        kept: &mut Kept<S, M, T>,
    ) -> Result<(), StepFailure> {
        for taken in 0..count {
            kept.q.copy_from_slice(&self.q);
            kept.memory.restore(&self.memory);
            self.steps(clock.after(taken), 1)?;
            let [time, _] = extended(self.system);
            let mean = (self.q[time] - kept.q[time]) / clock.step_size();
            let rate = self.system.time_transform(&self.q).map_or(mean, |transform| transform.rate);
            // What is not a number is not positive.
            let leads_forward = mean > T::lift(0.0) && rate > T::lift(0.0);
            if !leads_forward {
                let least = if mean < rate { mean } else { rate };
                self.q.copy_from_slice(&kept.q);
                self.memory.restore(&kept.memory);
                self.statistics.steps -= 1;
                return Err(StepFailure::TimeRate { rate: reported(least) });
            }
        }
        Ok(())
    }
}
