//! Steps one after the other, as one task: so they can be compiled for the widest SIMD instructions as a
//! whole.

use crate::Real;
use crate::error::StepFailure;
use crate::methods::Clock;
use crate::scalar::simd::Task;

/// Up to `count` steps from the present time of a clock, by a closure that is
/// `#[cfg_attr(not(debug_assertions), inline(always))]` where it is written.
#[derive(Debug)]
pub(crate) struct Steps<T, F> {
    clock: Clock<T>,
    count: u64,
    step: F,
}

impl<T: Real, F: FnMut([T; 2]) -> Result<(), StepFailure>> Steps<T, F> {
    /// `step` gets the time at which it starts, and its length.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new(clock: Clock<T>, count: u64, step: F) -> Self {
        Self { clock, count, step }
    }
}

impl<T: Real, F: FnMut([T; 2]) -> Result<(), StepFailure>> Task for Steps<T, F> {
    /// How many have succeeded.
    type Output = (u64, Result<(), StepFailure>);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(mut self) -> Self::Output {
        for taken in 0..self.count {
            if let Err(failure) = (self.step)([self.clock.after(taken).time(), self.clock.step_size()]) {
                return (taken, Err(failure));
            }
        }
        (self.count, Ok(()))
    }
}
