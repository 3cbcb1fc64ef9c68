//! Starts and steps that are none, sizes that are known at run time, and what is generated.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_examples::models::{SphericalPendulum, SphericalPendulumState, SphericalPendulumStateOf};
use dvi_tests::Outcome;
use dvi_tests::zoo::manifold::{Body, BodyState, BodyStateOf, FREE, UNEVEN};
use num_dual::Dual64;

fn refused<S: ManifoldLagrangian>(system: &S, state: S::State<f64>) -> (&'static str, f64) {
    match Integrator::new(system, Geodesic::trapezoid(), 0.1, state) {
        Err(StartError::OffManifold { block, defect, .. }) => (block, defect),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it began"),
    }
}

#[test]
fn starts_off_the_manifold_are_named_with_their_defect() {
    let omega_R = [0.1, 0.2, 0.3];
    let mut stretched = rotations::exp([0.3, 0.1, 0.0]);
    stretched.iter_mut().for_each(|entry| *entry *= 1.0 + 1e-9);
    let (block, defect) = refused(&FREE, BodyState { R: stretched, omega_R });
    assert!(block == "R" && (defect - 2e-9).abs() < 1e-12, "{block} {defect:e}");
    let mirror = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0];
    assert_eq!(refused(&FREE, BodyState { R: mirror, omega_R }), ("R", 2.0));
    let pendulum = SphericalPendulum { gravity: 1.0 };
    let (block, defect) = refused(&pendulum, SphericalPendulumState { s: [0.0, 0.6, 0.9], dot_s: [0.0; 3] });
    assert!(block == "s" && (defect - 0.17).abs() < 1e-12, "{block} {defect:e}");
    let (_, defect) =
        refused(&pendulum, SphericalPendulumState { s: [0.0, 0.6, 0.8], dot_s: [0.3, 0.1, 0.0] });
    assert_abs_diff_eq!(defect, 0.06 / 0.1_f64.sqrt(), epsilon = 1e-12);
}

#[test]
fn a_step_by_half_a_turn_is_an_error_that_says_by_how_much() {
    let start = BodyState { R: rotations::exp([0.0; 3]), omega_R: [0.0, 0.0, 2.0] };
    let mut run = Integrator::new(&FREE, Geodesic::trapezoid(), 1.6, start).expect("begins");
    match run.take_steps(1).map_err(|error| error.failure) {
        Err(StepFailure::HalfTurn { block: "R", index: None, angle }) => {
            assert_abs_diff_eq!(angle, 3.2, epsilon = 1e-12);
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(run.state(), start);
    let mut run = Integrator::new(&FREE, Geodesic::trapezoid(), 1.5, start).expect("begins");
    assert!(run.take_steps(100).is_ok());
}

/// At rest, where a great circle has no direction.
#[test]
fn what_rests_begins_to_move() -> Outcome {
    let pendulum = SphericalPendulum { gravity: 2.0 };
    let start = SphericalPendulumState { s: [0.6, 0.0, -0.8], dot_s: [0.0; 3] };
    let mut run = Integrator::new(&pendulum, Geodesic::trapezoid(), 0.01, start)?;
    run.take_steps(1000)?;
    assert!((run.energy() + 1.6).abs() < 1e-4);
    // The hanging pendulum and the standing one stay where they are.
    for z in [-1.0, 1.0] {
        let still = SphericalPendulumState { s: [0.0, 0.0, z], dot_s: [0.0; 3] };
        let mut run = Integrator::new(&pendulum, Geodesic::midpoint(), 0.1, still)?;
        run.take_steps(100)?;
        assert_eq!(run.state(), still);
    }
    let body = BodyState { R: rotations::exp([0.4, 0.0, 0.0]), omega_R: [0.0; 3] };
    let mut run = Integrator::new(&UNEVEN, Geodesic::trapezoid(), 0.01, body)?;
    let energy = run.energy();
    assert_abs_diff_eq!(UNEVEN.energy_at(0.0, &body)?, energy, epsilon = 1e-15);
    run.take_steps(1000)?;
    assert_abs_diff_eq!(run.energy(), energy, epsilon = 1e-3);
    Ok(())
}

/// Mass matrices of which two eigenvalues change their signs together, which no determinant shows.
mod singular {
    use super::*;

    #[lagrangian(
        coordinates(s: S2),
        lagrangian = s[2] * (dot(s[0]).powi(2) + dot(s[1]).powi(2) + dot(s[2]).powi(2)) / 2.0,
    )]
    struct OnSphere;

    #[lagrangian(
        coordinates(R: SO3),
        lagrangian = (R[2][2] * (omega(R)[0].powi(2) + omega(R)[1].powi(2)) + omega(R)[2].powi(2)) / 2.0,
    )]
    struct OfBody;

    #[lagrangian(
        coordinates(s: S2, x, y),
        lagrangian = sum(0..3, |i| dot(s[i]).powi(2)) / 2.0 + x * (dot(x).powi(2) + dot(y).powi(2)) - 3.0 * x,
    )]
    struct OfNumbers;

    fn ends<S: ManifoldLagrangian>(system: &S, start: &S::State<f64>) {
        for h in [0.05, 0.01] {
            let mut run = Integrator::new(system, Geodesic::midpoint(), h, start.clone()).expect("begins");
            let energy = run.energy();
            let failure = run.take_steps((6.0 / h) as u64).map_err(|error| error.failure);
            // With short steps a motion may turn back before it comes there.
            let is_right = (run.energy() - energy).abs() < 0.05 * energy.abs();
            assert!(failure.is_err() || is_right, "h = {h}: {energy} became {}", run.energy());
            let is_seen = matches!(failure, Err(StepFailure::Orientation { matrix: "the mass matrix", .. }));
            assert!(is_seen || h < 0.05, "{failure:?}");
        }
    }

    #[test]
    fn what_is_singular_on_the_way_ends_the_run() {
        ends(&OnSphere, &OnSphereState { s: [0.6, 0.0, 0.8], dot_s: [0.8, 0.1, -0.6] });
        ends(&OfBody, &OfBodyState { R: rotations::exp([0.1, 0.0, 0.0]), omega_R: [1.0, 0.1, 0.2] });
        let [s, dot_s] = [[0.6, 0.0, 0.8], [0.0, 0.1, 0.0]];
        ends(&OfNumbers, &OfNumbersState { s, x: 1.0, y: 0.3, dot_s, dot_x: -0.5, dot_y: 0.2 });
    }
}

/// At rest, a great circle has no direction that could be differentiated.
#[test]
fn a_unit_vector_at_rest_has_no_derivatives_and_a_body_has() -> Outcome {
    let dual = |re: f64| Dual64::new(re, 0.0);
    let still = SphericalPendulumStateOf { s: [0.6, 0.0, -0.8].map(dual), dot_s: [0.0; 3].map(dual) };
    let pendulum = SphericalPendulum { gravity: 2.0 };
    let refused = Integrator::new(&pendulum, Geodesic::trapezoid(), dual(0.1), still);
    assert!(matches!(refused, Err(StartError::Unsupported { .. })));
    // A standing top whose axis begins to fall: to first order θ'' = (weight/inertia) θ.
    let top = Body { inertia: [1.0, 1.0, 0.5], tip: [0.0, 0.0, 1.0], weight: 1.5 };
    let tilt = rotations::exp([Dual64::new(0.0, 1.0), dual(0.0), dual(0.0)]);
    let start = BodyStateOf { R: tilt, omega_R: [dual(0.0); 3] };
    let mut run = Integrator::new(&top, Geodesic::trapezoid(), dual(0.001), start)?;
    run.take_steps(1000)?;
    let rate = 1.5_f64.sqrt();
    assert_abs_diff_eq!(run.state().omega_R[0].eps, rate * rate.sinh(), epsilon = 1e-5);
    assert_abs_diff_eq!(run.state().R[7].eps, rate.cosh(), epsilon = 1e-5);
    Ok(())
}
