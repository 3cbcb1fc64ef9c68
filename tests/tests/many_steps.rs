//! Many steps at once are the same steps, bit by bit, and end at the same failure.

use dvi_core::DegenerateLagrangian;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::bits;
use dvi_tests::configurations::quasi_periodic;
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
fn pieces_of_any_length_give_the_same_run() -> Outcome {
    let (vortices, start) = quasi_periodic();
    for method in [Sigma::leapfrog(), Sigma::new(1.0), Sigma::midpoint()] {
        assert_eq!(check(&vortices, method, start, 0.05, 300)?, None);
    }
    let oblique = ObliqueState { x: 1.0, y: 0.0 };
    assert_eq!(check(&Oblique, unlimited(), oblique, 0.1, 300)?, None);
    let lost = check(&Oblique, Sigma::leapfrog(), oblique, 0.1, 300)?;
    assert!(
        matches!(lost, Some(StepError { step: 11, failure: StepFailure::ParasiticMode { .. }, .. })),
        "{lost:?}"
    );
    let many = ManyVortices { gamma: vortices.gamma.to_vec() };
    let many_start = ManyVorticesState { x: start.x.to_vec(), y: start.y.to_vec() };
    assert_eq!(check(&many, Sigma::leapfrog(), many_start, 0.05, 300)?, None);
    let a = [[0.3, 1.0, 0.1, -0.4], [-1.1, 0.2, 0.5, 0.3], [0.2, -0.6, 0.1, 1.2], [0.5, 0.1, -0.9, 0.4]];
    let dense = Quadratic { a, s: [[1.0, 0.1, 0.0, 0.2]; 4], quartic: 0.1 };
    assert_eq!(check(&dense, unlimited(), QuadraticState { z: [0.1, 0.2, -0.1, 0.3] }, 0.01, 20)?, None);
    Ok(())
}

#[test]
fn a_failure_inside_of_a_piece_is_that_of_the_step() -> Outcome {
    // The parasitic mode of this gauge grows by 7/3 a step, until the numbers overflow.
    let failure = check(&Oblique, unlimited(), ObliqueState { x: 1.0, y: 0.0 }, 0.1, 10_000)?;
    let Some(StepError { step, failure: StepFailure::NotFinite { .. }, .. }) = failure else {
        return Err(format!("{failure:?}").into());
    };
    assert!(step > 500 && !step.is_multiple_of(64), "step {step}");
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
