//! What runs of all kinds have in them.

use core::fmt;

use crate::error::{StepError, StepFailure};
use crate::methods::{Carries, Clock, Method};
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::{Lagrangian, Real, Space as _, State as _, System, Vector};

/// A system, a method that steps it, and the point that they have reached. It does not know the time: the
/// run that it is part of does.
pub struct Stepper<'a, S: System, M: Carries<S, T>, T: Real> {
    pub(crate) system: &'a S,
    pub(crate) method: M,
    pub(crate) memory: M::Memory,
    pub(crate) q: Vector<S, T>,
    pub(crate) statistics: Statistics,
    pub(crate) failed: bool,
}

impl<S: System, M: Carries<S, T> + fmt::Debug, T: Real> fmt::Debug for Stepper<'_, S, M, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stepper")
            .field("system", &S::REPORT.system)
            .field("method", &self.method)
            .field("q", &self.q)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

impl<'a, S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<'a, S, M, T> {
    pub(crate) fn new(system: &'a S, method: M, memory: M::Memory, q: Vector<S, T>) -> Self {
        Self { system, method, memory, q, statistics: Statistics::default(), failed: false }
    }

    /// Goes on from another point, whose memory has just begun.
    pub(crate) fn move_to(&mut self, memory: M::Memory, q: Vector<S, T>) {
        (self.memory, self.q, self.failed) = (memory, q, false);
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`.
    #[inline]
    pub(crate) fn velocity(&self, t: T, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.method.velocity(self.system, &self.memory, &self.q, t, v)
    }

    /// Takes `count` steps from the present time of `clock`, or as many as succeed.
    #[inline]
    pub(crate) fn steps(&mut self, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        self.method.steps(self.system, &mut self.memory, &mut self.q, clock, count, &mut self.statistics)
    }

    #[cold]
    pub(crate) fn error(&mut self, time: T, h: T, failure: StepFailure) -> StepError {
        self.failed = true;
        let failure = self.explained(failure, time, h);
        StepError { step: self.statistics.steps, time: reported(time), failure }
    }

    /// The current state, which is reached at time `t`.
    ///
    /// # Errors
    /// Where a regular system has no velocities.
    pub(crate) fn try_state(&mut self, t: T) -> Result<S::State<T>, StepError> {
        let system = self.system;
        let mut v = system.space().vector();
        match self.velocity(t, &mut v) {
            Ok(()) => Ok(S::State::read(|block| system.block_len(block), &self.q, &v)),
            Err(failure) => Err(self.error(t, T::lift(0.0), failure)),
        }
    }

    /// Passes the velocity on, or nothing if the system is degenerate.
    pub(crate) fn with_velocity<R>(&self, t: T, read: impl FnOnce(&[T]) -> R) -> R {
        if !S::REGULAR {
            return read(&[]);
        }
        let mut v = self.system.space().vector();
        if self.velocity(t, &mut v).is_err() {
            v.fill(T::lift(f64::NAN));
        }
        read(&v)
    }
}
