//! A run that a step control moves on, step by step, and back.

use crate::error::StepFailure;
use crate::methods::{Carries, Clock, Method, Step, Tolerance};
use crate::run::Stepper;
use crate::scalar::norm::reported;
use crate::shown::shown;
use crate::state::Statistics;
use crate::system::start::is_length;
use crate::{Lagrangian, Real, System};

/// A run as its [`StepControl`](super::StepControl) sees it: a point that can be moved on and, if the
/// control [rejects](super::StepControl::REJECTS) steps, back.
pub struct ControlledRun<'a, S: System, M: Carries<S, T>, T: Real> {
    pub(in crate::run) system: &'a S,
    pub(in crate::run) stepper: &'a mut Stepper<S, M, T>,
}

impl<'a, S: Lagrangian<T>, M: Method<S, T>, T: Real> ControlledRun<'a, S, M, T> {
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
    /// As [`Method::velocity`].
    #[inline]
    pub fn velocity(&self, t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.stepper.velocity(self.system, t, v)
    }

    /// Takes a step from time `t` to `t + h`, without allocation.
    ///
    /// # Errors
    /// [`StepFailure::StepLength`] if `t + h` is `t`, or not finite, or `h` is below the smallest number
    /// that has all digits; else as [`Method::step`]. Nothing has moved then.
    /// [`StepFailure::LeftDomain`]: a control that takes another step [goes back](Self::go_back) first.
    #[inline]
    pub fn step(&mut self, t: T, h: T) -> Result<(), StepFailure> {
        let end = t + h;
        if end == t || !end.is_finite() || !is_length(h) {
            return Err(StepFailure::StepLength { h: reported(h) });
        }
        let Stepper { method, memory, q, statistics, .. } = &mut *self.stepper;
        method.step(Step { system: self.system, q, t, h, statistics }, memory)?;
        self.stepper.look(self.system, Clock::new(t, h).after(1))
    }

    /// An estimate of the error of the last step, from time `t` of length `h` where steps usually have
    /// another, in units of `tolerance`, without allocation; infinite if the method has none.
    ///
    /// # Errors
    /// As [`Method::local_error`].
    pub fn local_error(&mut self, t: T, [h, usual]: [T; 2], tolerance: Tolerance) -> Result<T, StepFailure> {
        let Stepper { method, memory, statistics, .. } = &mut *self.stepper;
        method.local_error(self.system, memory, t, [h, usual], tolerance, statistics)
    }

    /// What the run has cost, for a control to count what it takes back and what it evaluates itself.
    pub fn statistics(&mut self) -> &mut Statistics {
        &mut self.stepper.statistics
    }

    /// Goes back to where the step of the control has begun, without allocation, if the control
    /// [rejects](super::StepControl::REJECTS) steps.
    pub fn go_back(&mut self) {
        self.stepper.go_back();
    }
}

shown!([S: Lagrangian<T>, M: Method<S, T>, T: Real] ControlledRun<'_, S, M, T>, |run| q: run.q());
