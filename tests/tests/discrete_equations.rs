//! Steps of the σ-family: in single precision, and from a given second point.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::PointVorticesStateOf;

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
