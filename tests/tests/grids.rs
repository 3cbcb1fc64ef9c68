//! Arrays of numbers with two indices, beside the same in one, and beside closed forms.

use std::error::Error;
use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::{IndexError, LengthError};
use dvi_tests::Outcome;

use crate::records::read_again;

/// A lattice on a torus with friction, with sizes as the system has them.
macro_rules! lattice {
    ($name:ident [$($generics:tt)*] $n:expr, $m:expr, { $($field:ident: $type:ty),* }) => {
        #[lagrangian(
            coordinates(q[$n][$m]),
            lagrangian = sum(0..$n, |i| sum(0..$m, |j| dot(q[i][j]).powi(2) / 2.0
                - (at(i + 1, j) - at(i, j)).powi(2) / 2.0 - (at(i, j + 1) - at(i, j)).powi(2) / 2.0
                - k[i][j] * q[i][j].powi(4) / 4.0)),
            dissipation = sum(0..$n, |i| sum(0..$m, |j| dot(q[i][j]).powi(2) / 20.0)),
            momenta(p = sum(0..$n, |i| sum(0..$m, |j| dot(q[i][j])))),
            let = { let at = |i, j| q[i % $n][j % $m]; },
        )]
        struct $name<$($generics)*> { $($field: $type,)* k: Vec<Vec<f64>> }
    };
}

lattice!(Constant [const N: usize, const M: usize] N, M, {});
lattice!(RunTime [] n, m, { n: usize, m: usize });
lattice!(Rows [const M: usize] n, M, { n: usize });

/// The same with one index.
#[lagrangian(
    coordinates(q[n * m]),
    lagrangian = sum(0..n, |i| sum(0..m, |j| dot(q[m * i + j]).powi(2) / 2.0
        - (at(i + 1, j) - at(i, j)).powi(2) / 2.0 - (at(i, j + 1) - at(i, j)).powi(2) / 2.0
        - k[i][j] * q[m * i + j].powi(4) / 4.0)),
    dissipation = sum(0..n, |i| sum(0..m, |j| dot(q[m * i + j]).powi(2) / 20.0)),
    let = { let at = |i, j| q[m * (i % n) + j % m]; },
)]
struct Flat {
    n: usize,
    m: usize,
    k: Vec<Vec<f64>>,
}

const N: usize = 3;

fn rows<const M: usize>(of: fn(f64) -> f64) -> [[f64; M]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| of((M * i + j) as f64)))
}

fn vectors<const M: usize>(rows: &[[f64; M]]) -> Vec<Vec<f64>> {
    rows.iter().map(|row| row.to_vec()).collect()
}

/// Positions, velocities, and factors of the potential.
fn point<const M: usize>() -> [[[f64; M]; N]; 3] {
    [rows(|x| (1.3 * x).sin()), rows(|x| (2.1 * x).cos() / 2.0), rows(|x| 1.0 + (0.7 * x).sin() / 2.0)]
}

/// The positions and velocities after 200 steps, as flat slices.
fn moved<S, M>(system: &S, method: M, start: S::State<f64>) -> Result<[Vec<f64>; 2], Box<dyn Error>>
where
    S: Lagrangian,
    M: Method<S, f64>,
{
    let mut run = Integrator::new(system, method, 0.05, start)?;
    run.take_steps(200)?;
    Ok([run.q().to_vec(), run.v().to_vec()])
}

#[test]
fn two_indices_are_one_with_the_same_numbers() -> Outcome {
    // Long enough for packs of terms.
    const M: usize = 37;
    let [q, dot_q, k] = point::<M>();
    let k = vectors(&k);
    let flat = Flat { n: N, m: M, k: k.clone() };
    let start = FlatState { q: q.as_flattened().into(), dot_q: dot_q.as_flattened().into() };
    let expected = moved(&flat, Variational::midpoint(), start)?;

    let constant = Constant::<N, M> { k: k.clone() };
    assert_eq!(moved(&constant, Variational::midpoint(), ConstantState { q, dot_q })?, expected);
    let rows = Rows::<M> { n: N, k: k.clone() };
    let start = RowsState { q: q.into(), dot_q: dot_q.into() };
    assert_eq!(moved(&rows, Variational::midpoint(), start)?, expected);
    let [q, dot_q] = [q, dot_q].map(|rows| vectors(&rows));
    let run_time = RunTime { n: N, m: M, k };
    assert_eq!(moved(&run_time, Variational::midpoint(), RunTimeState { q, dot_q })?, expected);
    Ok(())
}

/// Springs on a torus.
#[lagrangian(
    coordinates(q[N][m]),
    lagrangian = sum(0..N, |i| sum(0..m, |j| (dot(q[i][j]).powi(2)
        - (q[(i + 1) % N][j] - q[i][j]).powi(2) - (q[i][(j + 1) % m] - q[i][j]).powi(2)) / 2.0)),
)]
struct Springs<const N: usize> {
    m: usize,
}

/// The angle that an oscillator of this frequency turns by in a step of the Störmer–Verlet method,
/// sin(Ω/2) = ω h/2.
fn turned(omega: f64, h: f64) -> f64 {
    2.0 * (omega * h / 2.0).asin()
}

/// The entries of each row move together.
#[lagrangian(
    coordinates(q[N][M]),
    lagrangian = sum(0..N, |i| sum(0..M, |j| (dot(q[i][j]).powi(2) - k[i][j] * q[i][j].powi(2)) / 2.0)),
    constraint(i in 0..N, j in 0..M - 1) = q[i][j] - q[i][j + 1],
)]
struct Rigid<const N: usize, const M: usize> {
    k: [[f64; M]; N],
}

#[test]
fn constraints_hold_between_entries() -> Outcome {
    const M: usize = 4;
    let [_, _, k] = point::<M>();
    let q = [[0.5; M], [-0.25; M], [1.0; M]];
    let (h, steps) = (0.1, 100);
    let start = RigidState { q, dot_q: [[0.0; M]; N] };
    let mut run = Integrator::new(Rigid { k }, Rattle::default(), h, start)?;
    run.take_steps(steps)?;
    for ((found, start), k) in run.state().q.iter().zip(&q).zip(&k) {
        let omega = (k.iter().sum::<f64>() / M as f64).sqrt();
        let expected = start.map(|start| start * (turned(omega, h) * steps as f64).cos());
        assert_abs_diff_eq!(found.as_slice(), expected.as_slice(), epsilon = 1e-11);
    }
    Ok(())
}

#[test]
fn entries_have_names_row_by_row() -> Outcome {
    let [q, dot_q, k] = point::<5>();
    let system = Constant::<N, 5> { k: vectors(&k) };
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    assert_eq!(names[..6], ["q[0][0]", "q[0][1]", "q[0][2]", "q[0][3]", "q[0][4]", "q[1][0]"]);
    assert_eq!((names.len(), names[29].as_str()), (30, "dot_q[2][4]"));
    assert!(Constant::<N, 5>::REPORT.to_string().contains("  q[N][M]\n"));
    let formulas = Constant::<N, 5>::REPORT.formulas;
    assert!(formulas.iter().any(|formula| formula.name == "∂L/∂dot(q[i][j])"));

    let state = ConstantState { q, dot_q };
    assert_eq!(read_again(&system, &state)?, [state]);
    let run_time = RunTime { n: N, m: 5, k: system.k };
    let state = RunTimeState { q: vectors(&q), dot_q: vectors(&dot_q) };
    assert_eq!(read_again(&run_time, &state)?, [state]);
    Ok(())
}

#[test]
fn rows_of_another_length_are_said_where_a_run_begins() {
    let [q, dot_q, k] = point::<5>().map(|rows| vectors(&rows));
    let begin = |system: RunTime, q: Vec<Vec<f64>>| {
        let start = RunTimeState { q, dot_q: dot_q.clone() };
        Integrator::new(system, Variational::midpoint(), 0.1, start)
            .map(|_| ())
            .expect_err("no such lattice")
    };
    let system = || RunTime { n: N, m: 5, k: k.clone() };
    let mut short = q.clone();
    short[1].pop();
    let error = begin(system(), short);
    let expected = LengthError { array: "q", row: Some(1), expected: 5, found: 4 };
    assert_eq!(error, StartError::Length(expected));
    assert_eq!(error.to_string(), "`q[1]` has length 4, but the system declares 5");
    let error = begin(system(), vec![vec![0.0; N]; 5]);
    assert_eq!(error, StartError::Length(LengthError { array: "q", row: None, expected: N, found: 5 }));
    let mut short = system();
    short.k[2].pop();
    assert_eq!(begin(short, q), StartError::Index(IndexError { array: "k", index: 4, len: 4 }));
}

/// Springs to what stands some places behind, and more that go below the last row.
#[lagrangian(
    coordinates(q[n][m]),
    lagrangian = sum(0..n, |i| sum(0..m, |j| dot(q[i][j]).powi(2) / 2.0)
        - sum(0..m - 1, |j| (q[i + below][j + behind] - q[i][j]).powi(2) / 2.0)
        - sum(0..more, |_| q[i + n][0].powi(2))),
)]
struct Behind {
    n: usize,
    m: usize,
    below: usize,
    behind: usize,
    more: usize,
}

#[test]
fn each_index_stays_below_a_size_of_its_own() -> Outcome {
    let begin = |below, behind, more| {
        let start = BehindState { q: vec![vec![0.0; 4]; 3], dot_q: vec![vec![0.0; 4]; 3] };
        let system = Behind { n: 3, m: 4, below, behind, more };
        Integrator::new(system, Variational::midpoint(), 0.1, start).map(|_| ())
    };
    // What no pass of a loop reads need not be there.
    begin(0, 1, 0)?;
    // The place behind the end of a row is the first one of the next row.
    let outside = |array, len| StartError::Index(IndexError { array, index: len as i64, len });
    assert_eq!(begin(0, 2, 0).err(), Some(outside("q[i]", 4)));
    assert_eq!(begin(1, 1, 0).err(), Some(outside("q", 3)));
    assert_eq!(begin(0, 1, 1).err(), Some(outside("q", 3)));
    Ok(())
}

#[test]
fn states_that_are_filled_again_have_their_rows() -> Outcome {
    let m = 7;
    let wave = |j: usize| (2.0 * PI * j as f64 / m as f64).cos();
    let q: Vec<Vec<f64>> = (0..N).map(|_| (0..m).map(wave).collect()).collect();
    let springs = Springs::<N> { m };
    let start = SpringsState { q, dot_q: vec![vec![0.0; m]; N] };
    let mut run = Integrator::new(&springs, Gauss::<4>::new(), 0.1, start)?;
    let height = |_: f64, state: &SpringsState| [state.q[2][0]];
    let event = run.events([Direction::Falling], height)?.next().ok_or("no event")??;
    // A quarter of the period 2π/ω, ω = 2 sin(π/m).
    assert_abs_diff_eq!(event.time, PI / 4.0 / (PI / m as f64).sin(), epsilon = 1e-9);
    Ok(())
}
