//! Many explicit steps at once, with the state in local arrays that the compiler can keep in registers.
//!
//! The points are examined once in a block of steps. A number that is not finite stays so from step to step,
//! so that nothing is missed; the steps of the block are then taken once more, one by one, to find the last
//! good point.

use crate::error::StepFailure;

/// The largest number of steps between two examinations.
pub(crate) const BLOCK: u64 = 256;

/// A state that moves from step to step, and the place where its last good value is kept.
pub(crate) trait Walk {
    /// How many points are looked at before a block ends.
    const WATCHED: u64 = 0;
    /// Whether a block asks [`admit`](Self::admit) where it begins.
    const ADMITS: bool = false;
    /// Whether a single step has a short way of its own. It pays where the state is in registers; elsewhere
    /// the step would not be compiled into the loop.
    const ALONE: bool = true;
    /// Takes the step with this number; numbers begin at zero.
    fn step(&mut self, number: u64);
    /// The number of steps in the block at hand, a power of two up to [`BLOCK`].
    fn block(&self) -> u64 {
        BLOCK
    }
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

/// Takes `count` steps after `before` steps of the run, or as many as succeed, and returns how many; the
/// last good state has been kept. Blocks begin at the same steps, however many are taken at once.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn walk<W: Walk>(mut state: W, before: u64, count: u64) -> (u64, Result<(), StepFailure>) {
    let position = before & (state.block() - 1);
    let within = (position != 0 || !W::ADMITS) && position + W::WATCHED < state.block();
    if W::ALONE && count == 1 && within {
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
    let (mut taken, mut at_once) = (0, BLOCK);
    while taken < count {
        if W::ADMITS
            && (before + taken) & (state.block() - 1) == 0
            && let Err(failure) = state.admit(taken)
        {
            return (taken, Err(failure));
        }
        // What admits may have set another block.
        let block = state.block();
        let position = (before + taken) & (block - 1);
        let steps = at_once.min(count - taken).min(block - position);
        let unseen = block.saturating_sub(W::WATCHED).saturating_sub(position).min(steps);
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
                at_once = 1;
            }
        }
    }
    (taken, Ok(()))
}
