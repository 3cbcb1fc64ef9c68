//! Failures are values, and the last good state is kept.

use super::Outcome;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

const KEPLER: Kepler = Kepler { mu: 1.0 };

fn state(x: f64, dot_y: f64) -> KeplerState {
    KeplerState { x, y: 0.0, dot_x: 0.0, dot_y }
}

#[test]
fn steps_and_starts_that_are_none_are_refused() {
    for h in [0.0, f64::NAN, f64::INFINITY] {
        let error = Integrator::new(&KEPLER, Variational::trapezoid(), h, state(1.0, 1.0)).err();
        assert!(matches!(error, Some(StartError::Step { .. })), "{error:?}");
    }
    let error = Integrator::new(&KEPLER, Variational::trapezoid(), 0.1, state(1.0, f64::NAN)).err();
    assert!(matches!(error, Some(StartError::NotFinite { coordinate: 3, .. })), "{error:?}");
    let collided = Integrator::new(&KEPLER, Variational::simpson(), 0.1, state(0.0, 1.0)).err();
    assert!(matches!(collided, Some(StartError::Starter(StepFailure::NotFinite { .. }))), "{collided:?}");
    for omega in [-1.0, f64::NAN, f64::INFINITY] {
        let method = Variational::simpson().phase_fitted(Constant(omega));
        let error = Integrator::new(&KEPLER, method, 0.1, state(1.0, 1.0)).err();
        assert!(matches!(error, Some(StartError::Parameter { name: "omega", .. })), "{error:?}");
    }
    let method = Variational::simpson().phase_fitted(PerCoordinate([1.0]));
    let error = Integrator::new(&KEPLER, method, 0.1, state(1.0, 1.0)).err();
    assert!(
        matches!(error, Some(StartError::Parameter { name: "omega.len()", value: 1.0, .. })),
        "{error:?}"
    );
    let error = Integrator::new(&KEPLER, Variational::sigma(1.5), 0.1, state(1.0, 1.0)).err();
    assert!(matches!(error, Some(StartError::Parameter { name: "node", value: 1.5, .. })), "{error:?}");
}

#[test]
fn options_that_do_not_go_together_are_refused() {
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    let start: DoublePendulumState = DoublePendulumState { a: 1.0, b: 0.5, dot_a: 0.0, dot_b: 0.0 };
    let unsupported = |error: Option<StartError>| matches!(error, Some(StartError::Unsupported { .. }));
    let fitted = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    assert!(unsupported(Integrator::new(&pendulums, fitted, 0.1, start).err()));
    let fixed = Variational { solver: Solver::FixedPoint, ..Variational::simpson() };
    assert!(unsupported(Integrator::new(&pendulums, fixed, 0.1, start).err()));
    let method = Variational::simpson().phase_fitted(PerCoordinate([1.0, 1.0]));
    let both = Variational { fitting: Fitting::PhaseAndMomentum, ..method };
    assert!(unsupported(Integrator::new(&KEPLER, both, 0.1, state(1.0, 1.0)).err()));
}

/// Symmetric data meet at the origin after one step of 1.
#[test]
fn a_collision_ends_the_run_at_the_last_good_state() -> Outcome {
    // x = 1, F = −1: p½ = −½ + p, and with p = −½ the first step arrives at 0.
    let start: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: -0.5, dot_y: 0.0 };
    for count in [1, 10] {
        let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 1.0, start)?;
        let error = run.advance_by(count).err();
        assert!(
            matches!(error, Some(StepError { step: 0, failure: StepFailure::NotFinite { .. }, .. })),
            "{error:?}"
        );
        assert_eq!((run.q(), run.memory().p()), ([1.0, 0.0].as_slice(), [-0.5, 0.0].as_slice()));
    }
    Ok(())
}

#[test]
fn a_step_without_a_solution_is_an_error() -> Outcome {
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        let method = Variational { solver, ..Variational::midpoint() };
        // Radial infall through the centre with steps as long as the fall.
        let mut run = Integrator::new(&KEPLER, method, 0.4, state(0.3, 1e-3))?;
        let (mut last, mut error) = (run.q().to_vec(), None);
        while run.steps() < 1000 && error.is_none() {
            last = run.q().to_vec();
            error = run.advance().err();
        }
        assert!(error.is_some(), "{solver:?}");
        assert_eq!(run.q(), last, "{solver:?}");
    }
    Ok(())
}

/// At θ = 0 the angle φ has no mass.
#[test]
fn a_singular_mass_matrix_is_found() -> Outcome {
    let pendulum = SphericalPendulum { g: 1.0 };
    let start: SphericalPendulumState =
        SphericalPendulumState { theta: 0.0, phi: 0.3, dot_theta: 0.5, dot_phi: 0.0 };
    let run = Integrator::new(&pendulum, Variational::trapezoid(), 0.1, start)?;
    assert!(run.state().dot_phi.is_nan());
    let start: SphericalPendulumState =
        SphericalPendulumState { theta: -0.05, phi: 0.3, dot_theta: 1.0, dot_phi: 0.0 };
    let mut run = Integrator::new(&pendulum, Variational::midpoint(), 0.1, start)?;
    let error = run.advance().err();
    assert!(matches!(error, None | Some(StepError { step: 0, .. })));
    Ok(())
}
