//! Many steps at once end at the failure of one step after the other, bit by bit.

use dvi_core::DegenerateLagrangian;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::bits;
use dvi_tests::systems::*;

/// The failure with zero for what is no number, which equals nothing, and no zero is reported.
fn comparable(mut error: StepError) -> StepError {
    if let StepFailure::NotFinite { value, .. } = &mut error.failure
        && value.is_nan()
    {
        *value = 0.0;
    }
    error
}

/// Compares one run in pieces with one step by step, up to `steps` or the first failure.
fn check<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    start: S::State<f64>,
    h: f64,
    steps: u64,
) -> Outcome<Option<StepError>> {
    let mut single = Integrator::new(system, method, h, start.clone())?;
    let mut failure = None;
    while single.steps() < steps && failure.is_none() {
        failure = single.advance().err();
    }
    for piece in [1, 3, 64, 1000, steps] {
        let mut pieces = Integrator::new(system, method, h, start.clone())?;
        let mut found = None;
        while pieces.steps() < steps && found.is_none() {
            found = pieces.take_steps(piece.min(steps - pieces.steps())).err();
        }
        assert_eq!(found.map(comparable), failure.map(comparable), "in pieces of {piece}");
        assert_eq!(pieces.statistics(), single.statistics(), "in pieces of {piece}");
        assert_eq!(bits(pieces.q()), bits(single.q()), "in pieces of {piece}");
        assert_eq!(bits(pieces.memory().defect()), bits(single.memory().defect()), "in pieces of {piece}");
    }
    Ok(failure)
}

/// Whatever becomes of the parasitic mode.
fn unlimited() -> Sigma {
    Sigma { parasitic_limit: None, ..Sigma::leapfrog() }
}

#[test]
fn a_failure_inside_of_a_piece_is_that_of_the_step() -> Outcome {
    // The parasitic mode of this gauge grows by 7/3 a step, until the numbers overflow.
    let failure = check(&Oblique, unlimited(), ObliqueState { x: 1.0, y: 0.0 }, 0.1, 10_000)?;
    let Some(StepError { step, failure: StepFailure::NotFinite { .. }, .. }) = failure else {
        return Err(format!("{failure:?}").into());
    };
    assert!(step > 500 && !step.is_multiple_of(64), "step {step}");
    let lost = check(&Oblique, Sigma::leapfrog(), ObliqueState { x: 1.0, y: 0.0 }, 0.1, 300)?;
    assert!(
        matches!(lost, Some(StepError { step: 11, failure: StepFailure::ParasiticMode { .. }, .. })),
        "{lost:?}"
    );
    Ok(())
}

#[test]
fn skipping_states_does_not_skip_a_failure() -> Outcome {
    let start = ObliqueState { x: 1.0, y: 0.0 };
    let run = Integrator::new(&Oblique, unlimited(), 0.1, start)?;
    let states: Vec<_> = run.step_by(100).take(100).collect();
    assert!(states.len() > 5 && states.len() < 30);
    assert!(matches!(states.last(), Some(Err(StepError { .. }))));
    let mut run = Integrator::new(&Oblique, unlimited(), 0.1, start)?;
    let third = run.nth(2).ok_or("a state")??;
    assert_eq!((run.steps(), [third.x, third.y].as_slice()), (3, run.q()));
    Ok(())
}
