//! Newmark's method: the potential of its own coordinates, and failures.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::Scalar;
use dvi_core::methods::PreservedForm;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, apart, failing, larger};
use num_dual::Dual64;

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

/// One Störmer–Verlet step for the potential Ṽ in q = x − βh² a, by its force, which at q is that at x.
#[test]
fn newmark_is_conjugate_to_verlet_in_the_modified_potential() -> Outcome {
    let h = 0.1;
    let force = |x: &[f64]| {
        let r3 = x[0].hypot(x[1]).powi(3);
        [-x[0] / r3, -x[1] / r3]
    };
    for beta in BETAS {
        let mut run = Integrator::new(&KEPLER, Newmark::new(beta), h, planet())?;
        let conjugate = |x: &[f64]| {
            let a = force(x);
            [x[0] - beta * h * h * a[0], x[1] - beta * h * h * a[1]]
        };
        for step in 0..50 {
            let (x0, p0) = (run.q().to_vec(), run.memory().p().to_vec());
            run.advance()?;
            let (a0, a1) = (force(&x0), force(run.q()));
            let (q0, q1, p1) = (conjugate(&x0), conjugate(run.q()), run.memory().p());
            for i in 0..2 {
                let half = p0[i] + 0.5 * h * a0[i];
                let error = larger((q0[i] + h * half - q1[i]).abs(), (half + 0.5 * h * a1[i] - p1[i]).abs());
                assert!(error < 1e-14, "beta = {beta}, step {step}: {error:e}");
            }
        }
        // So the momentum map of rotations is preserved at q, not at x.
        let angular = |x: &[f64], p: &[f64]| x[0] * p[1] - x[1] * p[0];
        let start = [1.0, 0.1];
        let kept =
            angular(&conjugate(run.q()), run.memory().p()) - angular(&conjugate(&start), &[-0.2, 1.1]);
        let moved = angular(run.q(), run.memory().p()) - angular(&start, &[-0.2, 1.1]);
        assert!(kept.abs() < 1e-13 && moved.abs() > 1e-7, "beta = {beta}: {kept:e} {moved:e}");
        // −∂Ṽ/∂q = F(x), where Ṽ(q) = V(x) + ½βh² F·F: along any curve x(s), dṼ/ds = −F(x)·dq/ds.
        let x = [Dual64::new(0.7, 0.3), Dual64::new(-0.4, 1.1)];
        let r3 = x[0].hypot(x[1]).powi(3);
        let f = [-x[0] / r3, -x[1] / r3];
        let scale = Dual64::from_re(beta * h * h);
        let potential = -Dual64::from_re(1.0) / x[0].hypot(x[1]) + scale * 0.5 * (f[0] * f[0] + f[1] * f[1]);
        let along: f64 = (0..2).map(|i| -f[i].re * (x[i] - scale * f[i]).eps).sum();
        assert_abs_diff_eq!(potential.eps, along, epsilon = 1e-14);
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
