//! Seams within sums, at which no step is made to end: the estimate sees them, and errors at the end are
//! within 30 tolerances as those of other motions are. The same formulas with their terms written out have
//! steps that end at the seams.

use dvi_core::prelude::*;

use super::problems::check_at;
use super::{Outcome, values_at};

/// Bodies on springs of constant force: the force jumps.
#[lagrangian(coordinates(x[N]), lagrangian = sum(0..N, |i| dot(x[i]).powi(2) / 2.0 - x[i].abs()))]
struct Wells<const N: usize>;

/// Bodies under dry friction.
#[lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2) - (1.0 + 0.3 * i as f64) * x[i].powi(2)) / 2.0,
    dissipation = sum(0..N, |i| 0.02 * dot(x[i]).abs()),
)]
struct Rubbed<const N: usize>;

#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |i| dot(x[i]).powi(2) - (1.0 + 0.3 * i as f64) * x[i].powi(2)) / 2.0,
    dissipation = 0.02 * (dot(x[0]).abs() + dot(x[1]).abs() + dot(x[2]).abs()),
)]
struct RubbedOneByOne;

/// Springs between bodies in the plane that are nearer than 1: the force has kinks.
#[lagrangian(
    coordinates(r[N][2]),
    lagrangian = sum(0..N, |i| dot(r[i]).norm_squared() / 2.0 - r[i].norm_squared() / 8.0)
        - 15.0 * sum_pairs(0..N, |i, j| (1.0 - (r[i] - r[j]).norm()).max(0.0).powi(2)),
)]
struct Springs<const N: usize>;

#[lagrangian(
    coordinates(r[3][2]),
    lagrangian = sum(0..3, |i| dot(r[i]).norm_squared() / 2.0 - r[i].norm_squared() / 8.0)
        - 15.0 * (near(r[0] - r[1]) + near(r[0] - r[2]) + near(r[1] - r[2])),
    let = { let near = |d| (1.0 - d.norm()).max(0.0).powi(2); },
)]
struct SpringsOneByOne;

/// Beads between walls with the contacts of Hertz: the second derivative of the force is infinite.
#[lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2)) / 2.0
        - 20.0 * sum(0..N - 1, |i| (1.0 - (x[i + 1] - x[i])).max(0.0).powf(2.5))
        - 20.0 * ((0.5 - x[0]).max(0.0).powf(2.5) + (x[N - 1] - 2.8).max(0.0).powf(2.5)),
)]
struct Beads<const N: usize>;

#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |i| dot(x[i]).powi(2)) / 2.0
        - 20.0 * ((1.0 - (x[1] - x[0])).max(0.0).powf(2.5) + (1.0 - (x[2] - x[1])).max(0.0).powf(2.5))
        - 20.0 * ((0.5 - x[0]).max(0.0).powf(2.5) + (x[2] - 2.8).max(0.0).powf(2.5)),
)]
struct BeadsOneByOne;

const TOLERANCES: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];

/// By eight stages and a tolerance that is smaller than those.
fn fine() -> (Gauss<8>, ErrorControl<'static>) {
    (Gauss::<8>::new(), ErrorControl::new(1e-14, 0.01))
}

/// x and x' of a body that falls from `height` at rest, up and down a well.
fn in_a_well(height: f64, t: f64) -> [f64; 2] {
    let quarter = (2.0 * height).sqrt();
    let turns = ((t + quarter) / (2.0 * quarter)).floor();
    let since = t - turns * 2.0 * quarter;
    let side = if turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
    [side * (height - since * since / 2.0), -side * since]
}

#[test]
fn errors_with_jumps_within_sums_are_within_thirty_tolerances() -> Outcome {
    let x = [1.0, 0.7, 1.9];
    let exact = [0, 1].map(|part| x.map(|height| in_a_well(height, 10.0)[part])).concat();
    check_at(&TOLERANCES, &[], (&Wells::<3>, &WellsState { x, dot_x: [0.0; 3] }), (10.0, &exact))?;
    let (x, dot_x) = ([1.0, -0.8, 0.6], [0.1, 0.2, -0.1]);
    let exact = values_at((&RubbedOneByOne, &RubbedOneByOneState { x, dot_x }), fine(), 10.0)?;
    check_at(&TOLERANCES, &[], (&Rubbed::<3>, &RubbedState { x, dot_x }), (10.0, &exact))?;
    Ok(())
}

#[test]
fn errors_with_kinks_within_sums_are_within_thirty_tolerances() -> Outcome {
    let r = [[1.0, 0.0], [-0.8, 0.3], [0.1, 1.1]];
    let dot_r = [[-0.5, 0.1], [0.5, -0.2], [0.0, -0.6]];
    let exact = values_at((&SpringsOneByOne, &SpringsOneByOneState { r, dot_r }), fine(), 8.0)?;
    check_at(&TOLERANCES, &[], (&Springs::<3>, &SpringsState { r, dot_r }), (8.0, &exact))?;
    let (x, dot_x) = ([0.6, 1.5, 2.6], [1.0, 0.3, -0.7]);
    let exact = values_at((&BeadsOneByOne, &BeadsOneByOneState { x, dot_x }), fine(), 5.0)?;
    check_at(&TOLERANCES, &[], (&Beads::<3>, &BeadsState { x, dot_x }), (5.0, &exact))?;
    Ok(())
}
