//! Steps of the σ-family: precision, a given second point, and what a step costs.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::*;

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
fn an_explicit_step_costs_one_gradient_and_nothing_else() -> Outcome {
    let (system, start) = quasi_periodic();
    for sigma in [0.0, 1.0] {
        let mut run = Integrator::new(&system, Sigma::new(sigma), 0.01, start)?;
        for _ in 0..100 {
            run.advance()?;
        }
        let expected = dvi_core::state::Statistics { steps: 100, gradients: 100, ..Default::default() };
        assert_eq!(run.statistics(), expected, "sigma = {sigma}");
    }
    Ok(())
}

#[test]
fn an_implicit_step_by_fixed_point_needs_no_matrix() -> Outcome {
    let (system, start) = quasi_periodic();
    // To the end, where corrections no longer shrink, it takes 10.2 iterations; 8.3 leave a bias behind.
    for (tolerance, limit) in [(1e-12, 5), (Stopping::default().tolerance, 11)] {
        let stopping = Stopping { tolerance, ..Stopping::default() };
        let mut run = Integrator::new(&system, Sigma { stopping, ..Sigma::midpoint() }, 0.1, start)?;
        for _ in 0..1000 {
            run.advance()?;
        }
        let statistics = run.statistics();
        assert_eq!((statistics.linearizations, statistics.factorisations), (0, 0));
        assert_eq!(statistics.gradients, statistics.iterations);
        assert!(statistics.iterations < limit * statistics.steps, "{statistics:?}");
    }
    Ok(())
}

#[test]
fn newton_takes_over_where_the_fixed_point_is_slow() -> Outcome {
    let (system, start) = quasi_periodic();
    let fixed_point = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
    let mut slow = Integrator::new(&system, fixed_point, 0.5, start)?;
    let mut automatic = Integrator::new(&system, Sigma::midpoint(), 0.5, start)?;
    for _ in 0..100 {
        slow.advance()?;
        automatic.advance()?;
    }
    assert!(slow.statistics().iterations > 20 * 100);
    assert!(automatic.statistics().factorisations > 100);
    let apart = dvi_tests::apart(slow.q(), automatic.q());
    assert!(apart < 1e-10, "{apart:e}");
    Ok(())
}
