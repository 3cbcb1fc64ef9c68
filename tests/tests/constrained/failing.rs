//! How steps with constraints fail.

use dvi_core::prelude::*;
use dvi_tests::failing;
use dvi_tests::zoo::constrained::*;

use super::{Outcome, PENDULUM};

/// A bead on a circle that runs away along the axis of it, and out of the numbers.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 + x.exp(),
    constraint = y * y + z * z - 1.0,
)]
#[derive(Clone, Copy, Debug)]
struct Runaway;

/// Many steps at once end where the same steps one by one end, with the same failure and at the same state.
#[test]
fn what_is_no_number_ends_many_steps_where_it_arises() -> Outcome {
    let start = RunawayState { x: 0.0, y: 1.0, z: 0.0, dot_x: 1.0, dot_y: 0.0, dot_z: 1.0 };
    let [mut together, mut alone] = [
        Integrator::new(&Runaway, Rattle::default(), 0.1, start)?,
        Integrator::new(&Runaway, Rattle::default(), 0.1, start)?,
    ];
    let Err(failed) = together.take_steps(1000) else { return Err("numbers without an end".into()) };
    let Err(error) = (0..1000).try_for_each(|_| alone.advance()) else {
        return Err("numbers without an end".into());
    };
    assert!(matches!(error.failure, StepFailure::NotFinite { coordinate: 0, .. }), "{error}");
    // What is no number is not equal to itself.
    assert_eq!(format!("{failed:?}"), format!("{error:?}"));
    assert!(together.statistics().steps > 5, "{error}");
    assert_eq!(together.statistics(), alone.statistics());
    assert_eq!(together.state(), alone.state());
    Ok(())
}

/// A step that fails names the reason, and the run stays where it was.
#[test]
fn a_step_that_is_too_long_fails_and_leaves_the_state() -> Outcome {
    fn fails<M: Method<Pendulum, f64>>(method: M, h: f64) -> Outcome<StepFailure> {
        let start = PendulumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: -1.0 };
        let (run, error) = failing(&PENDULUM, method, h, start)?;
        assert_eq!((run.steps(), run.state()), (0, start));
        Ok(error.failure)
    }
    for h in [1.2, 2.0, 5.0, 1e3] {
        for failure in [
            fails(Rattle::default(), h)?,
            fails(Constrained::new(Quadrature::trapezoid()), h)?,
            fails(Constrained::new(Midpoint), h)?,
        ] {
            let is_explained = matches!(
                failure,
                StepFailure::Turned { constraint: 0 }
                    | StepFailure::NotConverged { .. }
                    | StepFailure::RedundantConstraint { constraint: 0, .. }
            );
            assert!(is_explained, "h = {h}: {failure}");
        }
    }
    Ok(())
}

/// A bead on a curve whose height is a logarithm, and another coordinate.
#[lagrangian(
    coordinates(x, y, other),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(other).powi(2)) / 2.0 - slope * x,
    constraint = y - weight * x.ln(),
)]
#[derive(Clone, Copy, Debug)]
struct Curve {
    slope: f64,
    weight: f64,
}

#[test]
fn a_constraint_that_is_no_number_is_named() -> Outcome {
    fn ends<M: Method<Curve, f64> + Copy>(method: M, sees_coordinates: bool) -> Outcome {
        let undefined = |error: StartError| match error {
            StartError::UndefinedConstraint { constraint, value } => value.is_nan().then_some(constraint),
            other => panic!("{other}"),
        };
        let beyond = CurveState { x: -1.0, y: 0.0, other: 0.0, dot_x: 0.0, dot_y: 0.0, dot_other: 0.0 };
        let (system, at_one) = (Curve { slope: 4.0, weight: 1.0 }, CurveState { x: 1.0, ..beyond });
        for begun in [
            Integrator::new(&system, method, 0.1, beyond).map(drop),
            Integrator::new(&Curve { weight: f64::NAN, ..system }, method, 0.1, at_one).map(drop),
            system.multipliers_at(0.0, &beyond).map(drop),
        ] {
            assert_eq!(begun.map_err(undefined), Err(Some(0)));
        }
        // A step that leads to x < 0.
        let mut run = Integrator::new(&system, method, 2.0, at_one)?;
        let Err(error) = run.take_steps(100) else { return Err("x cannot become negative".into()) };
        let is_named = matches!(error.failure, StepFailure::UndefinedConstraint { constraint: 0, .. });
        // What RATTLE sees is the coordinate that the constraint has taken along.
        assert!(
            is_named
                || sees_coordinates && matches!(error.failure, StepFailure::NotFinite { coordinate: 0, .. }),
            "{error}"
        );
        Ok(())
    }
    ends(Constrained::new(Midpoint), false)?;
    ends(Rattle::default(), true)
}
