//! Steps of the σ-family: in single precision, and from a given second point; and orders by regression.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::configurations::{leapfrogging, quasi_periodic};
use dvi_tests::systems::{PointVorticesState, PointVorticesStateOf};

#[test]
fn single_precision_steps_to_its_own_rounding() -> Outcome {
    let (system, state) = quasi_periodic();
    let narrow = PointVorticesStateOf { x: state.x.map(|x| x as f32), y: state.y.map(|y| y as f32) };
    let mut single = Integrator::new(&system, Sigma::<f32>::midpoint(), 0.05, narrow)?;
    let mut double = Integrator::new(&system, Sigma::midpoint(), 0.05, state)?;
    for _ in 0..40 {
        single.advance()?;
        double.advance()?;
    }
    for (a, b) in single.q().iter().zip(double.q()) {
        assert!(abs_diff_eq!(f64::from(*a), b, epsilon = 2e-5), "{a} and {b}");
    }
    Ok(())
}

#[test]
fn a_given_second_point_is_reached() -> Outcome {
    let (system, first) = quasi_periodic();
    let mut exact = Integrator::new(&system, Gauss::<3>::new(), 0.05, first)?;
    exact.advance()?;
    for sigma in [0.0, 0.3, 0.5, 1.0] {
        let method = Sigma::new(sigma);
        let mut run = Integrator::from_two_points(&system, method, 0.05, first, exact.state())?;
        run.advance()?;
        let apart = dvi_tests::apart(run.q(), exact.q());
        assert!(apart < 4e-15, "sigma = {sigma}: {apart:e}");
    }
    Ok(())
}

#[test]
fn regression_finds_slopes_and_refuses_what_has_none() {
    let power = |h: f64| (h, 3.0 * h.powf(2.5));
    let order = convergence_order(&[power(0.1), power(0.2), power(0.7)]);
    assert!(order.is_some_and(|order| (order - 2.5).abs() < 1e-13));
    assert_eq!(convergence_order(&[]), None);
    assert_eq!(convergence_order(&[(0.1, 1.0)]), None);
    assert_eq!(convergence_order(&[(0.1, 1.0), (0.1, 2.0)]), None);
    assert_eq!(convergence_order(&[(0.1, 0.0), (0.2, 1.0)]), None);
    assert_eq!(convergence_order(&[(0.1, f64::NAN), (0.2, 1.0)]), None);
}

#[test]
fn a_second_point_without_an_energy_is_refused() {
    let (system, start) = leapfrogging();
    let second = PointVorticesState { x: [0.5, 0.5, -1.0, 1.0], y: [0.0, 0.0, -2.0, -2.0] };
    let run = Integrator::from_two_points(&system, Sigma::leapfrog(), 0.1, start, second);
    assert!(matches!(run.err(), Some(StartError::Undefined { .. })));
}
