//! A run that a step control moves on, step by step, and back.

use core::fmt;

use crate::error::{StartError, StepFailure};
use crate::memory::Aside;
use crate::methods::{Carries, Clock, Step, Tolerance, VariableStep};
use crate::run::Stepper;
use crate::run::kept::Kept;
use crate::scalar::norm::reported;
use crate::system::start::is_length;
use crate::{Lagrangian, Real, System, Vector};

/// A run as its [`StepControl`](super::StepControl) sees it: a point that can be moved on and, if the
/// control [rejects](super::StepControl::REJECTS) steps, back.
pub struct ControlledRun<'a, S: System, M: Carries<S, T>, T: Real> {
    system: &'a S,
    pub(super) stepper: &'a mut Stepper<S, M, T>,
    kept: &'a mut KeptSteps<S, M, T>,
}

/// What a run keeps of the steps that it may take back.
pub(super) struct KeptSteps<S: System, M: Carries<S, T>, T: Real> {
    /// What the control can go back to.
    by_control: Option<Kept<S, M, T>>,
    /// If steps are looked at: where the one at hand has begun.
    looked_at: Option<Aside<Kept<S, M, T>>>,
}

impl<S: Lagrangian<T>, M: Carries<S, T>, T: Real> KeptSteps<S, M, T> {
    pub(super) fn new(
        q: &Vector<S, T>,
        rejects: bool,
        begin: impl Fn() -> Result<M::Memory, StartError>,
    ) -> Result<Self, StartError> {
        let by_control = rejects.then(|| Kept::new(q, &begin)).transpose()?;
        Ok(Self { by_control, looked_at: Kept::if_looked_at(q, begin)? })
    }
}

impl<'a, S: Lagrangian<T>, M: VariableStep<S, T>, T: Real> ControlledRun<'a, S, M, T> {
    #[inline]
    pub(super) fn new(
        system: &'a S,
        stepper: &'a mut Stepper<S, M, T>,
        kept: &'a mut KeptSteps<S, M, T>,
    ) -> Self {
        Self { system, stepper, kept }
    }

    /// The system.
    pub fn system(&self) -> &'a S {
        self.system
    }

    /// The current coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.stepper.q
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`; degenerate systems have
    /// none, and `v` stays as it is.
    ///
    /// # Errors
    /// As [`Method::velocity`](crate::methods::Method::velocity).
    #[inline]
    pub fn velocity(&self, t: T, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.stepper.velocity(self.system, t, v)
    }

    /// Takes a step from time `t` to `t + h`, without allocation.
    ///
    /// # Errors
    /// [`StepFailure::StepLength`] if `t + h` is `t`, or not finite, or `h` is below the smallest number
    /// that has all digits; [`StepFailure::LeftDomain`]; else as
    /// [`Method::step`](crate::methods::Method::step). Nothing has moved then.
    #[inline]
    pub fn step(&mut self, t: T, h: T) -> Result<(), StepFailure> {
        let end = t + h;
        if end == t || !end.is_finite() || !is_length(h) {
            return Err(StepFailure::StepLength { h: reported(h) });
        }
        // Not compiled where steps are not looked at.
        if S::HAS_DOMAIN
            && let Some(kept) = &mut self.kept.looked_at
        {
            self.stepper.keep(kept);
        }
        let Stepper { method, memory, q, statistics, .. } = &mut *self.stepper;
        method.step(Step { system: self.system, q, t, h, statistics }, memory)?;
        if S::HAS_DOMAIN
            && let Some(kept) = &self.kept.looked_at
            && let Err(failure) = self.stepper.look(self.system, Clock::new(t, h).after(1), Some(kept))
        {
            self.stepper.return_to(kept);
            return Err(failure);
        }
        Ok(())
    }

    /// An estimate of the error of the last step, from time `t` of length `h` where steps usually have
    /// another, in units of `tolerance`, without allocation; `None` if the method has none.
    ///
    /// # Errors
    /// As [`VariableStep::local_error`].
    pub fn local_error(
        &mut self,
        t: T,
        [h, usual]: [T; 2],
        tolerance: Tolerance,
    ) -> Result<Option<T>, StepFailure> {
        let Stepper { method, memory, statistics, .. } = &mut *self.stepper;
        method.local_error(self.system, memory, t, [h, usual], tolerance, statistics)
    }

    /// Keeps the present point, to [go back](Self::go_back) to it. Nothing happens if the control does not
    /// reject steps.
    pub fn keep(&mut self) {
        if let Some(kept) = &mut self.kept.by_control {
            self.stepper.keep(kept);
        }
    }

    /// Goes back to the point that was kept, without allocation.
    pub fn go_back(&mut self) {
        if let Some(kept) = &self.kept.by_control {
            self.stepper.return_to(kept);
        }
    }
}

impl<S: Lagrangian<T>, M: VariableStep<S, T> + fmt::Debug, T: Real> fmt::Debug
    for ControlledRun<'_, S, M, T>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ControlledRun")
            .field("system", &S::REPORT.system)
            .field("method", &self.stepper.method)
            .field("q", &self.stepper.q)
            .finish_non_exhaustive()
    }
}
