//! What many steps along geodesics keep.

// Rotations are called R.
#![allow(non_snake_case)]

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::discrete::Rule;
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_tests::zoo::manifold::{COUPLED, Coupled, CoupledState, FREE, TOP, coupled, cross, dot, tilted};

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn rotations_stay_orthogonal_and_unit_vectors_of_length_one() {
    let mut run = Integrator::new(&COUPLED, Geodesic::trapezoid(), 0.02, coupled())
        .expect("a step that is short enough");
    for _ in 0..100 {
        run.take_steps(1000).expect("a step that is short enough");
        let CoupledState { R, s, dot_s, .. } = run.state();
        assert!(rotations::defect(&R) < 2e-15, "{:e}", rotations::defect(&R));
        assert!(abs_diff_eq!(norm(&s), 1.0, epsilon = 1e-15), "{:e}", norm(&s) - 1.0);
        assert!(dot(s, dot_s).abs() < 1e-15);
    }
}

#[test]
fn a_free_body_keeps_its_angular_momentum_in_space() {
    let mut run = Integrator::new(&FREE, Geodesic::midpoint(), 0.1, tilted([0.1, 1.2, 0.05]))
        .expect("a step that is short enough");
    let before: Vec<f64> = (0..3).map(|k| run.momentum(k).expect("declared")).collect();
    let energy = run.energy();
    let mut changes = 0.0_f64;
    for _ in 0..100 {
        run.take_steps(1000).expect("a step that is short enough");
        for (k, before) in before.iter().enumerate() {
            assert!(
                abs_diff_eq!(run.momentum(k).expect("declared"), before, epsilon = 1e-12),
                "{k}: {}",
                run.momentum(k).expect("declared") - before
            );
        }
        changes = changes.max((run.energy() - energy).abs());
    }
    assert!(changes < 2e-3 * energy, "{changes:e}");
}

/// The symmetric top has two momenta, and the energy as the third integral.
#[test]
fn a_top_keeps_its_integrals() {
    for h in [0.02, 0.01] {
        let mut run = Integrator::new(&TOP, Geodesic::trapezoid(), h, tilted([0.3, 0.2, 6.0]))
            .expect("a step that is short enough");
        let [vertical, spin] = [2, 3].map(|k| run.momentum(k).expect("declared"));
        let energy = run.energy();
        let mut largest = [0.0_f64; 2];
        for part in &mut largest {
            for _ in 0..10_000 {
                run.take_steps(5).expect("a step that is short enough");
                *part = part.max((run.energy() - energy).abs());
            }
            assert_abs_diff_eq!(run.momentum(2).expect("declared"), vertical, epsilon = 1e-11);
            assert_abs_diff_eq!(run.momentum(3).expect("declared"), spin, epsilon = 1e-11);
        }
        // Bounded, and of second order: measured 0.1 h² E.
        assert!(largest[1] < 1.02 * largest[0], "{largest:?}");
        assert!(largest[0] < 2.0 * h * h * energy, "{largest:?}");
    }
}

/// Without gravity the system of all kinds is symmetric under rotations of space.
#[test]
fn a_system_of_all_kinds_keeps_its_angular_momentum() {
    let system = Coupled { gravity: 0.0, ..COUPLED };
    for rule in [Quadrature::trapezoid(), Quadrature::simpson(), Quadrature::sigma(0.3)] {
        let mut run = Integrator::new(&system, Geodesic::new(rule), 0.05, coupled())
            .expect("a step that is short enough");
        let before = angular_momentum(&run);
        run.take_steps(10_000).expect("a step that is short enough");
        let after = angular_momentum(&run);
        for (before, after) in before.iter().zip(after) {
            assert!(abs_diff_eq!(*before, after, epsilon = 1e-11), "{rule:?}: {:e}", before - after);
        }
    }
}

/// R p_R + p_s + x × p_x
fn angular_momentum(run: &Integrator<&Coupled, Geodesic<impl Rule>, f64>) -> [f64; 3] {
    let (p, CoupledState { R, x, .. }) = (run.memory().p(), run.state());
    let part = |at: usize| [p[at], p[at + 1], p[at + 2]];
    let (body, rod, centre) = (rotations::apply(&R, part(0)), part(9), cross(x, part(12)));
    [0, 1, 2].map(|k| body[k] + rod[k] + centre[k])
}
