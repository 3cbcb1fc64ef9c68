//! How runs with impacts end, and what they do not begin with.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dvi_core::prelude::*;
use dvi_tests::zoo::impacts::*;
use dvi_tests::{failing, refused_option};

use super::Outcome;

/// The last bounces of a ball take 2v e^k/g each, so that they end after √2 (1 + 2e/(1 − e)) when it falls
/// from a height of one.
#[test]
fn impacts_that_accumulate_end_the_run_where_the_ball_comes_to_rest() -> Outcome {
    for e in [0.3, 0.8, 0.95] {
        let method = Impacts { restitution: e, ..Impacts::reflecting(Variational::midpoint()) };
        let ball = Ball { m: 1.0 };
        let (run, error) = failing(&ball, method, 0.01, BallState { y: 1.0, dot_y: 0.0 })?;
        let rest = 2.0_f64.sqrt() * (1.0 + 2.0 * e / (1.0 - e));
        let StepFailure::Accumulation { surface: 0, impacts: 16, time } = error.failure else {
            return Err(error.into());
        };
        assert!(time < rest && rest - time < 0.01, "{time} for {rest}");
        // Its energy has been lost by e² at each bounce.
        let bounces = run.memory().total() as i32;
        assert_relative_eq!(run.energy(), e.powi(2 * bounces), epsilon = 0.0, max_relative = 1e-9);
        // Its impacts are those of the last good step.
        let impacts = run.memory().impacts();
        assert!(impacts.iter().all(|impact| (run.time() - impact.time - 0.005).abs() < 0.005 + 1e-12));
        assert!(!impacts.is_empty());
    }
    Ok(())
}

#[test]
fn a_body_that_lies_on_a_surface_is_no_impact() -> Outcome {
    let ball = Ball { m: 1.0 };
    let method = Impacts::reflecting(Variational::trapezoid());
    let (run, error) = failing(&ball, method, 0.1, BallState { y: 0.0, dot_y: 0.0 })?;
    assert_eq!(error.failure, StepFailure::Contact { surface: 0, gap: 0.0, rate: 0.0 });
    assert_eq!((run.steps(), run.state()), (0, BallState { y: 0.0, dot_y: 0.0 }));
    Ok(())
}

#[test]
fn a_body_may_begin_on_a_surface() -> Outcome {
    let ball = Ball { m: 1.0 };
    for (dot_y, impacts) in [(1.0_f64, 0), (-1.0, 1)] {
        let method = Impacts::reflecting(Variational::trapezoid());
        let mut run = Integrator::new(&ball, method, 0.1, BallState { y: 0.0, dot_y })?;
        run.advance()?;
        assert_eq!(run.memory().impacts().len(), impacts);
        assert_abs_diff_eq!(run.state().y, 0.095, epsilon = 1e-15);
    }
    Ok(())
}

#[test]
fn what_a_run_does_not_begin_with() -> Outcome {
    let ball = Ball { m: 1.0 };
    let begin = |method: Impacts<Variational<_, _>>, y: f64| {
        Integrator::new(&ball, method, 0.1, BallState { y, dot_y: 0.0 })
    };
    let plain = || Impacts::new(Variational::midpoint());
    assert_eq!(begin(plain(), -0.5).err(), Some(StartError::Beyond { surface: 0, gap: -0.5 }));
    for restitution in [0.0, -1.0, 1.5, f64::NAN] {
        let method = Impacts { restitution, ..Impacts::reflecting(Variational::midpoint()) };
        assert_eq!(refused_option(begin(method, 1.0)), "restitution");
    }
    // Of a collision that loses energy, of one with forces, and of a method without a discrete energy.
    let variational = "Collision::Variational";
    assert_eq!(refused_option(begin(Impacts { restitution: 0.5, ..plain() }, 1.0)), variational);
    let table = Integrator::new(&Table { a: 0.1 }, plain(), 0.1, TableState { y: 1.0, dot_y: 0.0 });
    assert_eq!(refused_option(table), variational);
    let galerkin = Impacts::new(Galerkin::<3>::new());
    let galerkin = Integrator::new(&ball, galerkin, 0.1, BallState { y: 1.0, dot_y: 0.0 });
    assert_eq!(refused_option(galerkin), variational);
    Ok(())
}

/// The gap √(1 − t) − … is no number behind t = 1.
#[test]
fn a_gap_that_is_no_number_ends_the_run() -> Outcome {
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, impact = x + (1.0 - t).sqrt())]
    struct Ceasing;
    let method = Impacts::new(Variational::midpoint());
    let (_, error) = failing(&Ceasing, method, 0.25, CeasingState { x: 1.0, dot_x: 0.0 })?;
    assert!([3, 4].contains(&error.step), "{error}");
    assert!(matches!(error.failure, StepFailure::Gap { surface: 0, .. }), "{error}");
    Ok(())
}
