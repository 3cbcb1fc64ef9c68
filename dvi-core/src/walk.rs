//! Many explicit steps at once, with the state in local arrays that the compiler can keep in registers.
//!
//! The points are examined once in a block of steps. A number that is not finite stays so from step to step, so
//! that nothing is missed; the steps of the block are then taken once more, one by one, to find the last good
//! point.

use crate::error::StepFailure;

/// Steps between two examinations.
const BLOCK: u64 = 64;

/// A state that moves from step to step, and the place where its last good value is kept.
pub(crate) trait Walk {
    /// Takes the step with this number; numbers begin at zero.
    fn step(&mut self, number: u64);
    /// Whether all numbers are finite after `steps` steps.
    ///
    /// # Errors
    /// [`StepFailure::NotFinite`].
    fn examine(&mut self, steps: u64) -> Result<(), StepFailure>;
    /// Keeps the present state.
    fn keep(&mut self);
    /// Returns to the state that was kept.
    fn go_back(&mut self);
}

/// Takes `count` steps, or as many as succeed, and returns how many; the last good state has been kept.
#[inline(always)]
pub(crate) fn walk(mut state: impl Walk, count: u64) -> (u64, Result<(), StepFailure>) {
    let (mut taken, mut block) = (0, BLOCK);
    while taken < count {
        let steps = block.min(count - taken);
        for number in taken..taken + steps {
            state.step(number);
        }
        match state.examine(steps) {
            Ok(()) => {
                taken += steps;
                state.keep();
            }
            Err(failure) if steps == 1 => return (taken, Err(failure)),
            Err(_) => {
                state.go_back();
                block = 1;
            }
        }
    }
    (taken, Ok(()))
}
