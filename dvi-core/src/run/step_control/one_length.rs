//! Steps of one length.

use super::{ControlledRun, StepControl};
use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, Method};
use crate::scalar::norm::reported;
use crate::system::start::validate_step;
use crate::{Lagrangian, Real, System};

/// The length h of all steps of a run, as [`Integrator::new`](crate::run::Integrator::new) takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneLength<T>(pub(in crate::run) T);

impl<S: System, T: Real> Carries<S, T> for OneLength<T> {
    type Memory = ();
}

impl<S: Lagrangian<T>, T: Real> StepControl<S, T> for OneLength<T> {
    type Suited<C> = C;

    const ONE_LENGTH: bool = true;

    fn begin(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<((), T), StartError> {
        self.begin_again(system, q, v, t)?;
        if t + self.0 == t { Err(StartError::Step { h: reported(self.0) }) } else { Ok(((), self.0)) }
    }

    fn begin_again(&self, _system: &S, _q: &[T], _v: &[T], t: T) -> Result<(), StartError> {
        validate_step(t, self.0)
    }

    fn step<M: Method<S, T>>(
        &self,
        _memory: &mut (),
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure> {
        run.step(t, self.0).map(|()| self.0)
    }

    /// It is faster than one after the other where a method can keep its state in registers.
    #[inline]
    fn steps<M: Method<S, T>>(
        &self,
        _memory: &mut (),
        run: &mut ControlledRun<'_, S, M, T>,
        count: u64,
    ) -> Result<(), StepFailure> {
        let clock = run.stepper.clock();
        // One of the two is not compiled.
        if S::TIME_TRANSFORMED || S::HAS_DOMAIN {
            run.stepper.steps_seen(run.system, clock, count)
        } else {
            run.stepper.steps(run.system, clock, count)
        }
    }
}
