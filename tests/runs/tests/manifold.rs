//! What many steps along geodesics keep.

// Rotations are called R.
#![allow(non_snake_case)]

use approx::abs_diff_eq;
use dvi_core::discrete::Rule;
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_tests::zoo::manifold::{COUPLED, Coupled, CoupledState, coupled, cross, dot};

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
