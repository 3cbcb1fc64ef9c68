//! Runs taken together whose systems have parameters of their own are, bit for bit, the runs alone.

use core::sync::atomic::{AtomicU64, Ordering};
use dvi_tests::Outcome;

use dvi_core::Scalar;
use dvi_core::prelude::*;
use dvi_tests::configurations::quasi_periodic;

use super::same_as_alone;

/// Holds runs together against the runs alone, and how many of them fail against what is expected.
macro_rules! in_lanes {
    ($systems:expr, $method:expr, $h:expr, $failed:expr) => {{
        let systems = &$systems;
        let runs: Vec<_> = systems.iter().map(|(system, start)| (system, start.clone())).collect();
        let strides = [1, 7, 300, 2, 61];
        let errors = same_as_alone::<8, _, _>(&runs, &$method, $h, &strides)?;
        assert_eq!(errors.iter().flatten().count(), $failed);
    }};
}

/// Two bodies on springs.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |j| m[j] * dot(x[j]).powi(2) / 2.0 - k * x[j] * x[j] / 2.0)
        - (x[1] - x[0]).powi(4) * count / weight(k),
    functions(weight = [weight, no_slope, no_slope]),
)]
#[derive(Clone, Debug, PartialEq)]
struct Springs<P = f64> {
    m: [P; 2],
    k: P,
    count: usize,
}

static EVALUATIONS: AtomicU64 = AtomicU64::new(0);

/// 1, and counts how often it is asked for.
fn weight<T: Scalar>(_: T) -> T {
    EVALUATIONS.fetch_add(1, Ordering::Relaxed);
    T::lift(1.0)
}

fn no_slope<T: Scalar>(_: T) -> T {
    T::lift(0.0)
}

fn springs(j: u32) -> (Springs, SpringsState) {
    let f = 1.0 + 0.1 * f64::from(j);
    let system = Springs { m: [f, 2.0 / f], k: 1.5 / f, count: 4 };
    (system, SpringsState { x: [0.1 * f, 0.4], dot_x: [0.0, 0.2] })
}

#[test]
fn masses_and_forces_stand_in_lanes() -> Outcome {
    let mut systems: Vec<_> = (0..11).map(springs).collect();
    in_lanes!(systems, Variational::trapezoid(), 0.05, 0);
    // One evaluation for all runs of a pack, each of which takes three alone when it begins.
    let evaluations = |count: usize| -> Result<u64, StartError> {
        let runs = systems[..count].iter();
        let mut runs = runs
            .map(|(system, start)| Integrator::new(system, Variational::trapezoid(), 0.05, *start))
            .collect::<Result<Vec<_>, _>>()?;
        let before = EVALUATIONS.load(Ordering::Relaxed);
        let results = Together::<8, _, _>::new(&runs[0]).take_steps(&mut runs, 5000);
        assert!(results.iter().all(Result::is_ok));
        Ok(EVALUATIONS.load(Ordering::Relaxed) - before)
    };
    assert_eq!(evaluations(8)?, evaluations(1)?);
    // Of another power than the others.
    systems[3].0.count = 2;
    systems[7].0.count = 2;
    in_lanes!(systems, Variational::trapezoid(), 0.05, 0);
    Ok(())
}

/// Vortices whose strengths differ.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
)]
#[derive(Clone, Debug, PartialEq)]
struct Vortices<const N: usize, P = f64> {
    gamma: [P; N],
}

/// An oscillator whose one-form is not antisymmetric.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = a * x * d(y) + (a - 1.0) * y * d(x),
    hamiltonian = (x * x + b * y * y) / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
struct Oblique<P = f64> {
    a: P,
    b: P,
}

#[test]
fn one_forms_and_energies_stand_in_lanes() -> Outcome {
    let (_, start) = quasi_periodic();
    let vortices = |j: u32| {
        let gamma = [1.0 + 0.01 * f64::from(j), 1.0, 1.0 - 0.02 * f64::from(j), 0.9];
        (Vortices { gamma }, VorticesState { x: start.x, y: start.y })
    };
    let mut systems: Vec<_> = (0..10).map(vortices).collect();
    for h in [0.05, 0.4] {
        in_lanes!(systems, Sigma::midpoint(), h, 0);
    }
    let free = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    in_lanes!(systems, free, 0.05, 0);
    // A step too long for two that are near each other, and no strength at all.
    systems[4].1.x[1] = systems[4].1.x[0] + 1e-3;
    systems[4].1.y[1] = systems[4].1.y[0];
    in_lanes!(systems, Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() }, 0.1, 1);

    let oblique = |j: u32| {
        let system = Oblique { a: 0.6 + 0.02 * f64::from(j), b: 1.0 + 0.1 * f64::from(j) };
        (system, ObliqueState { x: 1.0, y: 0.3 })
    };
    let systems: Vec<_> = (0..9).map(oblique).collect();
    in_lanes!(systems, Sigma::midpoint(), 0.1, 0);
    Ok(())
}

/// Springs side by side, as many as there are.
#[lagrangian(
    coordinates(x[k.len()]),
    lagrangian = sum(0..k.len(), |j| dot(x[j]).powi(2) - k[j] * x[j] * x[j] - bend * table[j][1] * x[j].powi(4)) / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
struct Row<P = f64> {
    k: Vec<P>,
    table: Vec<[P; 2]>,
    bend: f64,
}

#[test]
fn vectors_of_one_length_stand_in_lanes() -> Outcome {
    let row = |j: u32| {
        let n = if j % 4 == 3 { 20 } else { 12 };
        let k = (0..n).map(|i| 1.0 + 0.1 * f64::from(i + j)).collect();
        let table = (0..n).map(|i| [0.0, 0.05 * f64::from(i % 3 + j)]).collect();
        let zero = vec![0.0; n as usize];
        let x = (0..n).map(|i| 0.2 * f64::from(i) - 1.0).collect();
        (Row { k, table, bend: if j < 8 { 1.0 } else { 0.5 } }, RowState { x, dot_x: zero })
    };
    in_lanes!((0..13).map(row).collect::<Vec<_>>(), Variational::trapezoid(), 0.05, 0);
    Ok(())
}

/// Parameters that are borrowed, or of two types: such systems share packs if they are equal.
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - k[0] * x * x) / 2.0)]
#[derive(Clone, Debug, PartialEq)]
struct Borrowed<'a, P = f64> {
    k: &'a [P],
}

/// As [`Borrowed`].
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - k * l * x * x) / 2.0)]
#[derive(Clone, Debug, PartialEq)]
struct Mixed<P, R: Copy> {
    k: P,
    l: R,
}

#[test]
fn systems_that_cannot_be_packed_are_taken_alone_unless_they_are_equal() -> Outcome {
    let numbers = [1.0, 1.0, 2.0, 1.0];
    let borrowed =
        |j: usize| (Borrowed { k: &numbers[j..] }, BorrowedState { x: 1.0, dot_x: 0.1 * j as f64 });
    in_lanes!((0..4).map(borrowed).collect::<Vec<_>>(), Variational::trapezoid(), 0.05, 0);
    let mixed = |j: usize| (Mixed { k: numbers[j], l: j % 2 }, MixedState { x: 1.0, dot_x: 0.1 * j as f64 });
    in_lanes!((0..4).map(mixed).collect::<Vec<_>>(), Variational::trapezoid(), 0.05, 0);
    Ok(())
}

/// No number: it has neither `Clone` nor `PartialEq`.
#[derive(Debug)]
struct Opaque;

/// What can be declared with parameters of a generic type beside other fields.
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - k * w[0] * x * x) / 2.0)]
#[derive(Debug)]
#[allow(dead_code)]
struct Beside<P = f64, const N: usize = 3> {
    k: P,
    w: [P; N],
    opaque: Opaque,
    #[cfg(any())]
    absent: Opaque,
}

/// A system whose `==` passes over a list that is in no formula.
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - k * x * x) / 2.0)]
#[derive(Clone, Debug)]
struct Noted<P = f64> {
    k: P,
    notes: Vec<P>,
}

impl PartialEq for Noted {
    fn eq(&self, other: &Self) -> bool {
        self.k == other.k
    }
}

#[test]
fn lists_of_other_lengths_share_no_pack_even_if_systems_say_that_they_are_equal() -> Outcome {
    let system = Beside { k: 1.0, w: [1.0; 2], opaque: Opaque };
    let mut run =
        Integrator::new(&system, Variational::trapezoid(), 0.1, BesideState { x: 1.0, dot_x: 0.0 })?;
    run.take_steps(3)?;
    let noted =
        |j: usize| (Noted { k: 1.0, notes: vec![0.0; j % 3] }, NotedState { x: 1.0, dot_x: 0.1 * j as f64 });
    in_lanes!((1..7).rev().map(noted).collect::<Vec<_>>(), Variational::trapezoid(), 0.05, 0);
    Ok(())
}
