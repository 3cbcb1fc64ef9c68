//! The steps of an integrator, and its states one after the other.

use core::fmt::Debug;

#[cfg(feature = "alloc")]
use super::Checkpoint;
use super::begun::{Begun, begun};
use super::clock::Time;
use super::{Between, ControlledRun, Integrator, Run, StepControl, Stepper};
use crate::error::{StartError, StepError};
#[cfg(feature = "alloc")]
use crate::memory::{Memory, Record};
use crate::methods::{Clock, Method};
use crate::shown::shown;
use crate::state::Statistics;
use crate::system::StateOf;
#[cfg(feature = "alloc")]
use crate::system::start::velocities;
use crate::{Held, Lagrangian, Real, Vector};

impl<H, M, T: Real, C> Run for Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>>,
    M: Method<H::System, T>,
    C: StepControl<H::System, T>,
{
    type System = H::System;
    type Scalar = T;

    #[inline]
    fn system(&self) -> &H::System {
        self.system.held()
    }

    #[inline]
    fn between(&mut self) -> (&H::System, &mut dyn Between<H::System, T>) {
        (self.system.held(), &mut self.stepper)
    }

    #[inline]
    fn q(&self) -> &[T] {
        &self.stepper.q
    }

    fn v(&self) -> Vector<H::System, T> {
        self.stepper.known_velocity(self.system())
    }

    #[inline]
    fn statistics(&self) -> Statistics {
        self.stepper.statistics
    }

    #[inline]
    fn take_steps(&mut self, count: u64) -> Result<(), StepError> {
        let Self { system, stepper, control, control_memory } = self;
        let mut run = ControlledRun { system: system.held(), stepper };
        let taken = control.steps(control_memory, &mut run, count);
        taken.map_err(|failure| stepper.error(system.held(), stepper.time.h, failure))
    }

    #[cfg(feature = "alloc")]
    fn checkpoint(&self) -> Checkpoint<T> {
        let mut record = Record::new();
        self.stepper.memory.save(&mut record);
        self.control_memory.save(&mut record);
        self.stepper.time.save(&mut record);
        let v = &self.v()[..velocities(self.system())];
        Checkpoint::of([self.q(), v], [self.time(), self.step_size()], self.statistics(), record)
    }

    /// Of steps of one length t₀ + steps · h, of others their sum, compensated: rounding errors do not add
    /// up.
    #[inline]
    fn time(&self) -> T {
        self.stepper.clock().time()
    }

    #[inline]
    fn step_size(&self) -> T {
        self.stepper.time.h
    }

    #[inline]
    fn clock(&self) -> Option<Clock<T>> {
        C::ONE_LENGTH.then(|| self.stepper.clock())
    }

    fn set_state(&mut self, t: T, state: StateOf<H, T>) -> Result<(), StartError> {
        let Self { system, stepper: Stepper { method, memory, statistics, .. }, control, .. } = &*self;
        let Begun { q, memory: begun, kept, control_memory, time, .. } =
            begun(system.held(), method, control, t, &state)?;
        let (memory, steps) = (method.begun_anew(memory, begun), statistics.steps);
        let stepper = &mut self.stepper;
        (stepper.q, stepper.memory, stepper.kept, stepper.failed) = (q, memory, kept, false);
        (self.control_memory, stepper.time) = (control_memory, Time::new(t, time.h, steps));
        Ok(())
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T>, T: Real, C> Iterator for Integrator<H, M, T, C>
where
    C: StepControl<S, T>,
{
    type Item = Result<S::State<T>, StepError>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.nth(0)
    }

    /// Skips `n` states without building them and yields the next. Unlike elsewhere, a failure on the way is
    /// not skipped but yielded.
    #[inline]
    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        if self.stepper.failed {
            return None;
        }
        Some(self.take_steps(n as u64 + 1).and_then(|()| self.stepper.try_state(self.system.held())))
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T>, T: Real, C: StepControl<S, T>>
    core::iter::FusedIterator for Integrator<H, M, T, C>
{
}

shown! {
    [H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T> + Debug, T: Real, C: StepControl<S, T>]
    Integrator<H, M, T, C>, |run|
    system: S::REPORT.system,
    method: run.stepper.method,
    control: run.control,
    time: run.time(),
    step_size: run.step_size(),
    state: run.state(),
    statistics: run.stepper.statistics
}
