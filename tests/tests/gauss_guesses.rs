//! Where forces have a kink, the polynomial through the stages of a Gauss step leads far away in the next
//! one, out of tables too. The stages then begin once more from where the step begins.

use dvi_core::field::{Axis, Spline};
use dvi_core::prelude::*;
use dvi_tests::{Outcome, larger};

use crate::error_control::problems::{Splined, SplinedState};

/// On [−1, 1]: 2x², with deviations of a hundredth that jump from point to point.
fn rough() -> Outcome<Spline<1>> {
    let mut point = 0.0;
    let value = |[x]: [f64; 1]| {
        point += 1.0;
        2.0 * x * x + 0.01 * f64::sin(point * point)
    };
    Ok(Spline::sample([Axis::uniform([-1.0, 1.0], 21)?], value)?)
}

/// The motion of [`Splined`] of a degenerate system.
#[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = y * y / 2.0 + psi(x))]
struct TabulatedFlow {
    psi: Spline<1>,
}

/// The place at the end of each step of a run in twenty times as many steps of order four.
fn reference<S: Lagrangian>(system: &S, start: S::State<f64>, h: f64, steps: usize) -> Outcome<Vec<f64>>
where
    Gauss<2>: Method<S, f64>,
{
    const PARTS: u64 = 20;
    let mut fine = Integrator::new(system, Gauss::<2>::new(), h / PARTS as f64, start)?;
    let mut places = Vec::new();
    for _ in 0..steps {
        fine.take_steps(PARTS)?;
        places.push(fine.q()[0]);
    }
    Ok(places)
}

/// How far a run is from the reference, as the largest difference of a coordinate at the end of a step.
/// Stages in lanes have the same numbers.
fn error<S: Lagrangian, M: Method<S, f64>, L: Method<S, f64>>(
    system: &S,
    (one_by_one, in_lanes): (M, L),
    start: S::State<f64>,
    h: f64,
    reference: &[f64],
) -> Outcome<f64> {
    let mut one_by_one = Integrator::new(system, one_by_one, h, start.clone())?;
    let mut in_lanes = Integrator::new(system, in_lanes, h, start)?;
    let mut largest = 0.0;
    for place in reference {
        one_by_one.advance()?;
        in_lanes.advance()?;
        assert_eq!(one_by_one.q()[0].to_bits(), in_lanes.q()[0].to_bits());
        largest = larger(largest, (one_by_one.q()[0] - place).abs());
    }
    Ok(largest)
}

#[test]
fn steps_of_many_stages_stay_in_a_rough_table() -> Outcome {
    let (regular, degenerate) = (Splined { psi: rough()? }, TabulatedFlow { psi: rough()? });
    let start = SplinedState { x: -0.9, dot_x: 0.0 };
    let start_of_flow = TabulatedFlowState { x: -0.9, y: 0.0 };
    let motion = reference(&regular, start, 0.2, 200)?;
    let flow = reference(&degenerate, start_of_flow, 0.2, 200)?;
    let methods = (Gauss::<8>::new(), Gauss::<8>::new().in_lanes());
    let of_regular = error(&regular, methods, start, 0.2, &motion)?;
    let of_degenerate = error(&degenerate, methods, start_of_flow, 0.2, &flow)?;
    assert!(larger(of_regular, of_degenerate) < 2e-3, "{of_regular:e} {of_degenerate:e}");
    Ok(())
}
