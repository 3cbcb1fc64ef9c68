//! Newmark's method: stability, and failures.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, failing};

fn planet() -> KeplerState {
    KeplerState { x: 1.0, y: 0.1, dot_x: -0.2, dot_y: 1.1 }
}

#[test]
fn average_acceleration_is_stable_at_every_step() -> Outcome {
    let (system, start) = (Spring { stiffness: 1.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut run = Integrator::new(&system, Newmark::new(0.25), 50.0, start)?;
    for _ in 0..1000 {
        run.advance()?;
        assert!(abs_diff_eq!(run.energy(), 0.5, epsilon = 1e-11), "{}", run.energy());
    }
    Ok(())
}

#[test]
fn a_beta_out_of_range_is_refused() {
    for beta in [-0.1, 0.6, f64::NAN] {
        let failure = Integrator::new(&KEPLER, Newmark::new(beta), 0.1, planet()).err();
        assert!(matches!(failure, Some(StartError::Parameter { name: "beta", .. })), "{failure:?}");
    }
}

#[test]
fn failures_are_values_and_keep_the_last_good_state() -> Outcome {
    // Straight into the sun, which a step of length 2 hits exactly: p½ = −¾ − ¼.
    let fall = KeplerState { x: 2.0, y: 0.0, dot_x: -0.75, dot_y: 0.0 };
    let (_, error) = failing(&KEPLER, Newmark::new(0.0), 2.0, fall)?;
    assert!(matches!(error.failure, StepFailure::NotFinite { .. }), "{error:?}");
    let stopping = Stopping { max_iterations: 2, ..Stopping::default() };
    for solver in [Solver::FixedPoint, Solver::Automatic] {
        let (_, error) =
            failing(&KEPLER, Newmark { solver, stopping, ..Newmark::new(0.25) }, 0.5, planet())?;
        assert!(
            matches!(error.failure, StepFailure::NotConverged { iterations: 2, .. }),
            "{solver:?}: {error:?}"
        );
    }
    Ok(())
}
