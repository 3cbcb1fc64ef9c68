//! Galerkin's methods: what is refused, what a step costs, steps of different lengths, and nine nodes.

use approx::assert_abs_diff_eq;
use core::f64::consts::{PI, TAU};
use dvi_core::Space;
use dvi_core::discrete::Frequency;
use dvi_core::methods::Step;
use dvi_core::prelude::*;
use dvi_examples::models::{Bodies, BodiesState};
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, apart, larger, refused_option};

const PENDULUMS: DoublePendulum = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 9.81 };

#[test]
fn what_cannot_be_done_is_refused() {
    fn refused<S: RegularLagrangian, F: Frequency>(
        (system, start): (S, S::State<f64>),
        method: Galerkin<3, F>,
        expected: &str,
    ) {
        assert_eq!(refused_option(Integrator::new(&system, method, 0.1, start)), expected);
    }
    let method = Galerkin::<3>::new();
    let pendulums = || (PENDULUMS, DoublePendulumState { a: 1.1, b: -0.4, dot_a: 0.3, dot_b: 0.9 });
    let kepler = || (KEPLER, pericentre(0.3));
    for reading in [Reading::LeftFrozen, Reading::Variational] {
        refused(kepler(), method.phase_fitted(Radial(reading)), "this reading of the frequency");
    }
    refused(pendulums(), method.phase_fitted(Radial(Reading::Averaged)), "a frequency read from the motion");
    refused(pendulums(), Galerkin { solver: Solver::FixedPoint, ..method }, "Solver::FixedPoint");
    let resonant = method.phase_fitted(Constant(PI));
    let failure = Integrator::new(&KEPLER, resonant, 1.0, pericentre(0.3)).err();
    assert!(matches!(failure, Some(StartError::Starter(StepFailure::Resonance { .. }))), "{failure:?}");
    refused(kepler(), method.phase_fitted(Constant(-1.0)), "omega");
}

#[test]
fn newton_stands_by() -> Outcome {
    let (system, start) = (Spring { stiffness: 100.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut stiff = Integrator::new(&system, Galerkin::<4>::new(), 0.5, start)?;
    stiff.take_steps(20)?;
    assert!(stiff.statistics().factorisations > 0);
    Ok(())
}

/// Steps of these lengths there, and of their negatives back.
fn check_variable<S: RegularLagrangian, const NODES: usize>(
    system: &S,
    method: Galerkin<NODES>,
    [q, v]: [&[f64]; 2],
) -> Outcome {
    let mut point = Space::vector(system.space());
    point.copy_from_slice(q);
    let mut memory = method.begin(system, &point, v, 0.0, 0.1)?;
    let momentum = memory.p().to_vec();
    let mut statistics = Statistics::default();
    let (lengths, mut t) = ([0.1, 0.09, 0.1, 0.03, 0.2, 0.01], 0.0);
    let back = lengths.iter().rev().map(|h| -h);
    for h in lengths.iter().copied().chain(back) {
        method.step(Step { system, q: &mut point, t, h, statistics: &mut statistics }, &mut memory)?;
        t += h;
    }
    let error = larger(apart(&point, q), apart(memory.p(), &momentum));
    assert!(error < 1e-12, "{}: {error:e}", S::REPORT.system);
    Ok(())
}

#[test]
fn steps_of_different_lengths_may_follow_one_another() -> Outcome {
    check_variable(&KEPLER, Galerkin::<9>::new(), [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable(&PENDULUMS, Galerkin::<4>::new(), [&[1.1, -0.4], &[0.3, 0.9]])?;
    let chain = RunTimeChain { mass: vec![1.0, 1.5, 0.7], coupling: 0.2 };
    check_variable(&chain, Galerkin::<9>::new(), [&[0.1, -0.2, 0.4, 0.3], &[0.5, 0.0, -0.1, 0.2]])
}

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
