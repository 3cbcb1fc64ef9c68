//! What runs of all kinds have in them.

use super::clock::Time;
use crate::error::{StepError, StepFailure};
use crate::memory::Aside;
use crate::methods::{Carries, Clock, Here, Kept, Method, Steps};
use crate::state::Statistics;
use crate::system::start::step_error;
use crate::{Lagrangian, Real, Space as _, State as _, System, Vector};

/// A method that steps a system, and the point that it has reached. It does not know the system: the run
/// that it is part of does.
pub(crate) struct Stepper<S: System, M: Carries<S, T>, T: Real> {
    pub(crate) method: M,
    pub(crate) memory: M::Memory,
    pub(crate) q: Vector<S, T>,
    pub(super) time: Time<T>,
    pub(crate) statistics: Statistics,
    pub(crate) failed: bool,
    /// Where the steps at hand have begun, if they may be taken back.
    pub(super) kept: Option<Aside<PointOf<S, M, T>>>,
    /// If states in between are asked for: where steps have begun, where the next one begins, and where a
    /// part of the last one leads.
    pub(super) points: Option<[Aside<PointOf<S, M, T>>; 3]>,
}

/// A point of a run of a method on a system.
pub(super) type PointOf<S, M, T> = Kept<Vector<S, T>, <M as Carries<S, T>>::Memory>;

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<S, M, T> {
    /// The clock at the present time.
    #[inline]
    pub(super) fn clock(&self) -> Clock<T> {
        self.time.after(self.statistics.steps)
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`.
    #[inline]
    pub(crate) fn velocity(&self, system: &S, t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.method.velocity(Here { system, q: &self.q, t }, &self.memory, v)
    }

    /// Takes `count` steps from the present time of `clock`, or as many as succeed.
    #[inline]
    pub(crate) fn steps(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        let Self { method, memory, q, statistics, .. } = self;
        method.steps(Steps { system, q, clock, count, statistics }, memory)
    }

    #[cold]
    pub(crate) fn error(&mut self, system: &S, h: T, failure: StepFailure) -> StepError {
        let time = self.clock().time();
        self.failed = true;
        let failure = self.explained(system, failure, time, h);
        step_error(system, self.statistics.steps, time, failure)
    }

    /// The current state.
    ///
    /// # Errors
    /// Where a regular system has no velocities.
    pub(crate) fn try_state(&mut self, system: &S) -> Result<S::State<T>, StepError> {
        let mut v = system.space().vector();
        match self.velocity(system, self.clock().time(), &mut v) {
            Ok(()) => Ok(S::State::read(&|block| system.block_len(block), &self.q, &v)),
            Err(failure) => Err(self.error(system, T::lift(0.0), failure)),
        }
    }

    /// The velocity at the current point: not a number where there is none.
    pub(crate) fn known_velocity(&self, system: &S) -> Vector<S, T> {
        let mut v = system.space().vector();
        if S::REGULAR && self.velocity(system, self.clock().time(), &mut v).is_err() {
            v.fill(T::lift(f64::NAN));
        }
        v
    }
}
