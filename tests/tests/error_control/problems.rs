//! Twelve motions, four of them not smooth: errors at the end are within 30 tolerances.

use core::f64::consts::{PI, SQRT_2};

use dvi_core::field::{Axis, Spline};
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_tests::systems::{PointVortices, PointVorticesState};
use dvi_tests::zoo::gauges::{OneSided, OneSidedState};
use dvi_tests::zoo::regular::{
    HenonHeiles, HenonHeilesState, RestrictedThreeBody, RestrictedThreeBodyState,
};

use super::breaks::{Pushed, PushedState};
use super::seams::{Dry, DryState, Well, WellState};
use super::{DoublePendulum, DoublePendulumState, KEPLER, Outcome, larger, pericentre, values_at};

const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-12];

#[lagrangian(
    coordinates(x),
    lagrangian = (dot(x).powi(2) - x * x) / 2.0,
    force(x) = 2.0 * (1.0 - x * x) * dot(x),
)]
struct VanDerPol;

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - psi(x))]
pub(crate) struct Splined {
    pub(crate) psi: Spline<1>,
}

/// The largest error at time `end`, in units of what the tolerance allows there: ε (1 + |y|).
fn error<S: Lagrangian, M: VariableStep<S, f64>>(
    motion: (&S, &S::State<f64>),
    (method, control): (M, ErrorControl<'_>),
    (end, exact): (f64, &[f64]),
) -> Outcome<f64> {
    let state = values_at(motion, (method, control), end)?;
    assert_eq!(state.len(), exact.len());
    let allowed = |value: f64| control.tolerance.relative * (1.0 + value.abs());
    Ok(state
        .iter()
        .zip(exact)
        .fold(0.0, |most, (value, exact)| larger(most, (value - exact).abs() / allowed(*exact))))
}

/// Holds the errors of a motion at its end against 30 tolerances, those of two stages against 200: `exact`
/// are coordinates and, of a regular system, velocities.
pub(super) fn check_at<S: Lagrangian>(
    tolerances: &[f64],
    breaks: &[f64],
    motion: (&S, &S::State<f64>),
    end: (f64, &[f64]),
) -> Outcome
where
    Gauss<2>: VariableStep<S, f64>,
    Gauss<4>: VariableStep<S, f64>,
    Gauss<8>: VariableStep<S, f64>,
{
    let [mut two, mut four, mut eight] = [const { Vec::new() }; 3];
    for &tolerance in tolerances {
        let control = ErrorControl { breaks, ..ErrorControl::new(tolerance, 0.01) };
        // For the last one two stages would take as many steps as for all others.
        if tolerance > 1e-12 {
            two.push(error(motion, (Gauss::<2>::new(), control), end)?);
        }
        four.push(error(motion, (Gauss::<4>::new(), control), end)?);
        eight.push(error(motion, (Gauss::<8>::new(), control), end)?);
    }
    let name = S::REPORT.system;
    assert!(two.iter().all(|error| *error < 200.0), "{name}: {two:?}");
    assert!(four.iter().chain(&eight).all(|error| *error < 30.0), "{name}: {four:?} {eight:?}");
    Ok(())
}

fn check<S: Lagrangian>(motion: (&S, &S::State<f64>), end: (f64, &[f64])) -> Outcome
where
    Gauss<2>: VariableStep<S, f64>,
    Gauss<4>: VariableStep<S, f64>,
    Gauss<8>: VariableStep<S, f64>,
{
    check_at(&TOLERANCES, &[], motion, end)
}

/// The ends are by Gragg's extrapolation of order 18, in numbers of 64 bits or, of the restricted three
/// bodies, of 30 digits; with half as many steps more they are the same. Those of Kepler are from Kepler's
/// equation.
#[test]
fn errors_at_the_end_of_smooth_motions_are_within_thirty_tolerances() -> Outcome {
    check(
        (&KEPLER, &pericentre(0.6)),
        (20.0, &[-0.7700755784112404, 0.7883448169944244, -0.8941837319886915, -0.12346176415844096]),
    )?;
    check(
        (&KEPLER, &pericentre(0.9)),
        (20.0, &[-1.2952662509875743, 0.4003938963792322, -0.6775390924707566, -0.12708381542786862]),
    )?;
    // Nearly the period of the orbit of Arenstorf.
    check(
        (
            &RestrictedThreeBody { mu: 0.012277471 },
            &RestrictedThreeBodyState { x: 0.994, y: 0.0, dot_x: 0.0, dot_y: -2.0015851063790824 },
        ),
        (17.0, &[0.9412992937212814, 0.035312350938363636, 0.6983751692182714, -0.1852922833329095]),
    )?;
    check(
        (
            &DoublePendulum { mass: [1.0, 0.7], length: [1.0, 1.3], g: 9.81 },
            &DoublePendulumState { a: 1.0, b: -0.5, dot_a: 0.0, dot_b: 0.0 },
        ),
        (5.0, &[-0.07636996856662882, 0.44302122094488217, 3.625542874391284, -2.9129106266378675]),
    )?;
    check(
        (
            &PointVortices { gamma: [1.0, -0.5, 0.8, 1.5] },
            &PointVorticesState { x: [1.0, -1.0, -0.2, 0.3], y: [0.1, 0.0, 1.0, -0.9] },
        ),
        (
            20.0,
            &[
                [0.3183130542923656, 2.7836745573440207, 1.2974681426533974, 1.2170331401712846],
                [-1.36111574262563, 0.7859377993089018, 1.2741450008608066, 0.18984576106095688],
            ]
            .concat(),
        ),
    )?;
    check(
        (&HenonHeiles, &HenonHeilesState { x: 0.1, y: 0.3, dot_x: 0.35, dot_y: 0.2 }),
        (50.0, &[-0.04365473523222416, -0.287083680290677, -0.13309160201191736, -0.3657654121920469]),
    )?;
    check(
        (&VanDerPol, &VanDerPolState { x: 2.0, dot_x: 0.0 }),
        (20.0, &[-1.7283079289533112, 0.39788159580404836]),
    )?;
    check(
        (&OneSided { a: [-1.0; 2], b: [1.0; 2] }, &OneSidedState { x: 2.0, y: 0.5 }),
        (30.0, &[0.3380138710218476, 1.4463853991621933]),
    )
}

/// Closed forms but for the spline: there each cell is a motion of its own, by the same extrapolation, up to
/// the knot that ends it.
#[test]
fn errors_at_the_end_of_rough_motions_are_within_thirty_tolerances() -> Outcome {
    let after = 2.0 - SQRT_2;
    check(
        (&Well, &WellState { x: 1.0, dot_x: 0.0 }),
        (2.0, &[after * after / 2.0 - SQRT_2 * after, after - SQRT_2]),
    )?;
    check_at(
        &TOLERANCES,
        &[50.0, 50.2],
        (&Pushed { on: 50.0, off: 50.2 }, &PushedState { x: 0.0, dot_x: 0.0 }),
        (100.0, &[9.98, 0.2]),
    )?;
    check(
        (
            &Splined {
                psi: Spline::sample([Axis::uniform([-4.0, 4.0], 41)?], |[x]| {
                    0.1 * x * x + 0.3 * (3.0 * x).sin()
                })?,
            },
            &SplinedState { x: 3.0, dot_x: 0.0 },
        ),
        (50.0, &[3.0001294543221926, -0.0075387104383347]),
    )?;
    // Each half period takes 2μ from the amplitude.
    let (mu, halves) = (0.01, 6.0);
    let (amplitude, angle) = (1.0 - mu - 2.0 * mu * halves, 20.0 - halves * PI);
    check(
        (&Dry { friction: mu }, &DryState { x: 1.0, dot_x: 0.0 }),
        (20.0, &[mu + amplitude * angle.cos(), -amplitude * angle.sin()]),
    )
}
