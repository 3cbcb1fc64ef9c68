//! Newmark's method: the potential of its own coordinates, and failures.

use approx::abs_diff_eq;
use dvi_core::methods::PreservedForm;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, apart, failing};

const BETAS: [f64; 4] = [1.0 / 12.0, 1.0 / 6.0, 0.25, 0.5];

fn planet() -> KeplerState {
    KeplerState { x: 1.0, y: 0.1, dot_x: -0.2, dot_y: 1.1 }
}

#[test]
fn newmark_with_beta_zero_is_verlet() -> Outcome {
    let newmark = Newmark::new(0.0);
    assert_eq!((newmark.order(), newmark.preserved_form()), (2, PreservedForm::Canonical));
    let mut a = Integrator::new(&KEPLER, newmark, 0.01, planet())?;
    let mut b = Integrator::new(&KEPLER, Variational::trapezoid(), 0.01, planet())?;
    a.take_steps(1000)?;
    b.take_steps(1000)?;
    assert!(apart(a.q(), b.q()) < 1e-14 && apart(a.memory().p(), b.memory().p()) < 1e-14);
    assert_eq!((a.statistics().gradients, a.statistics().iterations), (1000, 0));
    Ok(())
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

/// The momentum map of rotations is preserved at q = x − βh² a, where a is the acceleration at x, and not at
/// x.
#[test]
fn the_angular_momentum_is_kept_in_conjugate_coordinates() -> Outcome {
    let (h, angular) = (0.1, |x: &[f64], p: &[f64]| x[0] * p[1] - x[1] * p[0]);
    for beta in BETAS {
        let mut run = Integrator::new(&KEPLER, Newmark::new(beta), h, planet())?;
        run.take_steps(50)?;
        let conjugate = |x: &[f64]| {
            let r3 = x[0].hypot(x[1]).powi(3);
            [0, 1].map(|i| x[i] + beta * h * h * x[i] / r3)
        };
        let (x, p, start) = (run.q(), run.memory().p(), [1.0, 0.1]);
        let kept = angular(&conjugate(x), p) - angular(&conjugate(&start), &[-0.2, 1.1]);
        let moved = angular(x, p) - angular(&start, &[-0.2, 1.1]);
        assert!(kept.abs() < 1e-13 && moved.abs() > 1e-7, "beta = {beta}: {kept:e} {moved:e}");
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
