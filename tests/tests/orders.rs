//! Orders of convergence, by regression.

use dvi_core::prelude::*;
use dvi_tests::configurations::leapfrogging;
use dvi_tests::systems::PointVorticesState;

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
