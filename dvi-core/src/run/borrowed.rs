//! Runs behind a reference or in a box.

#[cfg(feature = "alloc")]
use super::Checkpoint;
use super::Run;
use super::between::Between;
use super::dense::StateOf;
use crate::Vector;
use crate::error::{StartError, StepError};
use crate::methods::Clock;
use crate::state::Statistics;

/// Functions that are those of what `self` points to.
macro_rules! forwarded {
    ($(
        $(#[$when:meta])?
        fn $name:ident($this:ident: $This:ty $(, $argument:ident: $Type:ty)*) -> $Out:ty;
    )*) => {$(
        $(#[$when])?
        #[inline]
        fn $name($this: $This $(, $argument: $Type)*) -> $Out {
            (**$this).$name($($argument),*)
        }
    )*};
}

/// What holds or borrows a run is one.
macro_rules! run {
    ($Borrowed:ty) => {
        impl<R: Run + ?Sized> Run for $Borrowed {
            type System = R::System;
            type Scalar = R::Scalar;

            forwarded! {
                fn system(self: &Self) -> &R::System;
                fn between(self: &mut Self) -> (&R::System, &mut dyn Between<R::System, R::Scalar>);
                fn q(self: &Self) -> &[R::Scalar];
                fn v(self: &Self) -> Vector<R::System, R::Scalar>;
                fn statistics(self: &Self) -> Statistics;
                fn take_steps(self: &mut Self, count: u64) -> Result<(), StepError>;
                fn time(self: &Self) -> R::Scalar;
                fn step_size(self: &Self) -> R::Scalar;
                fn clock(self: &Self) -> Option<Clock<R::Scalar>>;
                fn set_state(self: &mut Self, t: R::Scalar, state: StateOf<R>) -> Result<(), StartError>;
                #[cfg(feature = "alloc")]
                fn checkpoint(self: &Self) -> Checkpoint<R::Scalar>;
            }
        }
    };
}

run!(&mut R);
#[cfg(feature = "alloc")]
run!(alloc::boxed::Box<R>);
