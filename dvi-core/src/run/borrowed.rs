//! Runs behind a reference or in a box.

#[cfg(feature = "alloc")]
use super::Checkpoint;
use super::Run;
use super::between::Between;
use crate::error::{StartError, StepError};
use crate::methods::Clock;
use crate::state::Statistics;
use crate::{System, Vector};

/// What holds or borrows a run is one.
macro_rules! run {
    ($Borrowed:ty) => {
        impl<R: Run + ?Sized> Run for $Borrowed {
            type System = R::System;
            type Scalar = R::Scalar;

            #[inline]
            fn system(&self) -> &R::System {
                (**self).system()
            }

            #[inline]
            fn between(&mut self) -> (&R::System, &mut dyn Between<R::System, R::Scalar>) {
                (**self).between()
            }

            #[inline]
            fn q(&self) -> &[R::Scalar] {
                (**self).q()
            }

            #[inline]
            fn v(&self) -> Vector<R::System, R::Scalar> {
                (**self).v()
            }

            #[inline]
            fn statistics(&self) -> Statistics {
                (**self).statistics()
            }

            #[inline]
            fn take_steps(&mut self, count: u64) -> Result<(), StepError> {
                (**self).take_steps(count)
            }

            #[inline]
            fn time(&self) -> R::Scalar {
                (**self).time()
            }

            #[inline]
            fn step_size(&self) -> R::Scalar {
                (**self).step_size()
            }

            #[inline]
            fn clock(&self) -> Option<Clock<R::Scalar>> {
                (**self).clock()
            }

            fn set_state(
                &mut self,
                t: R::Scalar,
                state: <R::System as System>::State<R::Scalar>,
            ) -> Result<(), StartError> {
                (**self).set_state(t, state)
            }

            #[cfg(feature = "alloc")]
            fn checkpoint(&self) -> Checkpoint<R::Scalar> {
                (**self).checkpoint()
            }
        }
    };
}

run!(&mut R);
#[cfg(feature = "alloc")]
run!(alloc::boxed::Box<R>);
