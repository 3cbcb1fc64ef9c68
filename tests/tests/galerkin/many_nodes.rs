//! Six to nine nodes, of orders 10 to 16, and ∂L/∂q at the interior nodes in lanes.

use approx::abs_diff_eq;
use core::f64::consts::TAU;
use dvi_core::prelude::*;
use dvi_examples::models::{Bodies, BodiesState};
use dvi_tests::zoo::regular::*;

use super::Outcome;

type Failed = Box<dyn core::error::Error>;

/// Compensated, as long steps ask for.
fn compensated<const S: usize>() -> Galerkin<S>
where
    Galerkin<S>: Tabulated,
{
    Galerkin { summation: Summation::Compensated, ..Galerkin::new() }
}

/// The phase error of a step on the oscillator, from that of many: the angle from the exact motion.
fn phase_error<const S: usize>(u: f64) -> Result<f64, Failed>
where
    Galerkin<S>: Tabulated,
{
    let steps = 400;
    let (system, start) = (Spring { stiffness: 1.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut run = Integrator::new(&system, compensated::<S>(), u, start)?;
    run.take_steps(steps)?;
    let SpringState { x, dot_x } = run.state();
    let (sin, cos) = (u * steps as f64).sin_cos();
    Ok((x * sin + dot_x * cos).atan2(x * cos - dot_x * sin).abs() / steps as f64)
}

/// Steps so long that rounding lets the errors be seen: the phase error of a step is of order h²ˢ⁻¹.
#[test]
fn orders_are_ten_to_sixteen_on_the_oscillator() -> Outcome {
    fn check<const S: usize>(tenths: core::ops::RangeInclusive<u32>) -> Outcome
    where
        Galerkin<S>: Tabulated,
    {
        let mut errors = Vec::new();
        for u in tenths.map(|k| 0.1 * f64::from(k)) {
            errors.push((u, phase_error::<S>(u)?));
        }
        let found = convergence_order(&errors).ok_or("no slope")?;
        assert!(abs_diff_eq!(found, (2 * S - 1) as f64, epsilon = 0.1), "{S} nodes: {found}, {errors:?}");
        assert_eq!(Galerkin::<S>::new().order(), 2 * S - 2);
        Ok(())
    }
    check::<6>(8..=26)?;
    check::<7>(11..=26)?;
    check::<8>(15..=26)?;
    check::<9>(20..=28)
}

#[test]
fn a_step_needs_each_force_once_an_iteration_and_the_last_one_once() -> Outcome {
    let mut nine = Integrator::new(&KEPLER, compensated::<9>().in_lanes(), TAU / 40.0, pericentre(0.3))?;
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
            assert!(abs_diff_eq!(a, b, epsilon = 1e-13 * 12.0), "{a} and {b}");
        }
    });
    assert!(on_small_stack.expect("a thread").join().is_ok());
}
