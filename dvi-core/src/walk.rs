//! Many explicit steps at once, with the state in local arrays that the compiler can keep in registers.
//!
//! The points are examined once in a block of steps. A number that is not finite stays so from step to step, so
//! that nothing is missed; the steps of the block are then taken once more, one by one, to find the last good
//! point.

use crate::error::StepFailure;

/// Steps between two examinations.
pub(crate) const BLOCK: u64 = 256;

/// Where in a block the points begin that are looked at.
const WATCHED: u64 = BLOCK - 4;

/// A state that moves from step to step, and the place where its last good value is kept.
pub(crate) trait Walk {
    /// Takes the step with this number; numbers begin at zero.
    fn step(&mut self, number: u64);
    /// Looks at the point before the step with this number, one of the last four of a block.
    fn watch(&mut self, _number: u64) {}
    /// Whether the run may go on where a block begins, with the step of this number.
    ///
    /// # Errors
    /// Any [`StepFailure`]; the run then ends at the present point.
    fn admit(&mut self, _number: u64) -> Result<(), StepFailure> {
        Ok(())
    }
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

/// Takes `count` steps after `before` steps of the run, or as many as succeed, and returns how many; the last good
/// state has been kept. Blocks begin at the same steps, however many are taken at once.
#[inline(always)]
pub(crate) fn walk(mut state: impl Walk, before: u64, count: u64) -> (u64, Result<(), StepFailure>) {
    if count == 1 && (1..WATCHED).contains(&(before % BLOCK)) {
        // The usual case of a run that is read at each step.
        state.step(0);
        return match state.examine(1) {
            Ok(()) => {
                state.keep();
                (1, Ok(()))
            }
            Err(failure) => (0, Err(failure)),
        };
    }
    let (mut taken, mut block) = (0, BLOCK);
    while taken < count {
        let position = (before + taken) % BLOCK;
        if position == 0
            && let Err(failure) = state.admit(taken)
        {
            return (taken, Err(failure));
        }
        let steps = block.min(count - taken).min(BLOCK - position);
        let unseen = WATCHED.saturating_sub(position).min(steps);
        for number in taken..taken + unseen {
            state.step(number);
        }
        for number in taken + unseen..taken + steps {
            state.watch(number);
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
