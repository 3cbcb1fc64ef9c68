//! A step of −h undoes a step of h if a scheme says that it is symmetric, and not if it is of first
//! order. Runs go back from coordinates and velocities.

use dvi_laws::Case;
use dvi_laws::equations::apart;

use super::{Outcome, below, of_every_kind};

pub(super) fn steps_back_undo_steps(case: &Case) -> Outcome {
    const STEPS: u64 = 20;
    let (subject, start) = (&case.subject, case.subject.start.concat());
    if !case.is_plain() || case.has_hidden_state() {
        return Ok(());
    }
    let mut forth = case.run()?;
    forth.take_steps(STEPS)?;
    let mut back = case.begin([forth.time(), -subject.h], &forth.values())?;
    back.take_steps(STEPS)?;
    let lost = apart(&back.values(), &start);
    if case.symmetric {
        below(lost, 1e-13, "the way back misses the start")
    } else if case.order == 1 {
        below(-lost, -1e-6, "it goes back, and is of first order")
    } else {
        Ok(())
    }
}

of_every_kind!(steps_back_undo_steps);
