//! Many steps at once end at the failure of one step after the other, bit by bit.

use dvi_core::prelude::*;
use dvi_tests::systems::*;
use dvi_tests::{Outcome, bits};

const OSCILLATOR: Oscillator = Oscillator { omega: 1.0 };
const START: OscillatorState = OscillatorState { x: 1.0, y: 0.0 };

/// A run that is not stable, as |ωh| > 1: it grows in each step, until the numbers overflow.
fn begin(parasitic_limit: Option<f64>) -> Result<Integrator<&'static Oscillator, Sigma>, StartError> {
    Integrator::new(&OSCILLATOR, Sigma { parasitic_limit, ..Sigma::leapfrog() }, 1.2, START)
}

#[test]
fn a_failure_among_many_steps_is_that_of_the_step() -> Outcome {
    for (limit, least) in [(None, 500), (Some(0.5), 8)] {
        let (mut single, mut at_once) = (begin(limit)?, begin(limit)?);
        let error = (0..10_000).find_map(|_| single.advance().err()).ok_or("no error")?;
        let found = at_once.take_steps(10_000).err().ok_or("no error")?;
        assert_eq!((found.step, found.to_string()), (error.step, error.to_string()));
        assert_eq!((at_once.statistics(), bits(at_once.q())), (single.statistics(), bits(single.q())));
        assert!(error.step >= least && !error.step.is_multiple_of(64), "{error}");
    }
    Ok(())
}

#[test]
fn skipping_states_does_not_skip_a_failure() -> Outcome {
    let states: Vec<_> = begin(None)?.step_by(100).take(100).collect();
    assert!(states.len() > 5 && states.len() < 30);
    assert!(matches!(states.last(), Some(Err(StepError { .. }))));
    let mut run = begin(None)?;
    let third = run.nth(2).ok_or("a state")??;
    assert_eq!((run.steps(), [third.x, third.y].as_slice()), (3, run.q()));
    Ok(())
}
