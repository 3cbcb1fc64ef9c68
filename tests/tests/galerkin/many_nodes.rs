//! Nine nodes, and ∂L/∂q at the interior ones in lanes.

use approx::assert_abs_diff_eq;
use core::f64::consts::TAU;
use dvi_core::prelude::*;
use dvi_examples::models::{Bodies, BodiesState};
use dvi_tests::zoo::regular::*;

use super::Outcome;

#[test]
fn a_step_needs_each_force_once_an_iteration_and_the_last_one_once() -> Outcome {
    let method = Galerkin { summation: Summation::Compensated, ..Galerkin::<9>::new() }.in_lanes();
    let mut nine = Integrator::new(&KEPLER, method, TAU / 40.0, pericentre(0.3))?;
    let mut gauss = Integrator::new(&KEPLER, Gauss::<8>::new().in_lanes(), TAU / 40.0, pericentre(0.3))?;
    nine.take_steps(400)?;
    gauss.take_steps(400)?;
    let [nine, gauss] = [nine.statistics(), gauss.statistics()];
    assert_eq!(nine.gradients, 7 * nine.iterations + nine.steps);
    // The method of the same order has eight stages.
    assert!(nine.iterations <= gauss.iterations && nine.gradients < gauss.gradients, "{nine:?} {gauss:?}");
    assert_eq!((nine.linearizations, nine.factorisations), (0, 0));
    Ok(())
}

/// Bodies at rest, side by side.
fn row<const N: usize>() -> (Bodies<N>, BodiesState<N>) {
    let r = core::array::from_fn(|j| {
        [1.0, 0.2, -0.1].map(|scale| scale * (j as f64 + 0.1 * ((j * j) as f64).sin()))
    });
    (Bodies { g: 1e-3, mass: [1.0; N] }, BodiesState { r, dot_r: [[0.0; 3]; N] })
}

#[test]
fn a_matrix_of_many_coordinates_has_a_place() {
    // What Rust gives to a thread, where nothing is optimised.
    let on_small_stack = std::thread::Builder::new().stack_size(2 << 20).spawn(|| {
        let (system, start) = row::<32>();
        for solver in [Solver::Automatic, Solver::Newton, Solver::NewtonKrylov] {
            let method = Galerkin { solver, ..Galerkin::<9>::new() };
            Integrator::new(&system, method, 0.1, start).expect("a matrix of 768 unknowns");
        }
        let method = Galerkin { solver: Solver::FixedPoint, ..Galerkin::<9>::new() }.in_lanes();
        let mut run = Integrator::new(&system, method, 0.1, start).expect("a fixed point needs no matrix");
        run.take_steps(3).expect("three steps");
        // Both ways find the same step.
        let (system, start) = row::<12>();
        let [newton, fixed_point] = [Solver::Newton, Solver::FixedPoint].map(|solver| {
            let method = Galerkin { solver, ..Galerkin::<9>::new() };
            let mut run = Integrator::new(&system, method, 0.1, start).expect("it starts");
            run.take_steps(1).expect("a step");
            run.q().to_vec()
        });
        for (a, b) in newton.iter().zip(&fixed_point) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-13 * 12.0);
        }
    });
    assert!(on_small_stack.expect("a thread").join().is_ok());
}
