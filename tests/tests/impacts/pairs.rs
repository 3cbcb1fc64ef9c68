//! Families with two indices: discs that collide with each other in the plane.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dvi_core::prelude::*;
use dvi_core::{ConstrainedSystem, Space, UnilateralLagrangian};

use super::Outcome;

/// Discs in a box, declared with one family for all pairs; `$size` is written as the system has it.
macro_rules! discs {
    ($(#[$attribute:meta])* $name:ident [$($generics:tt)*] $size:expr, { $($field:ident: $type:ty),* }) => {
        $(#[$attribute])*
        #[lagrangian(
            coordinates(x[$size], y[$size]),
            lagrangian = sum(0..$size, |i| m[i] * (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
            impact(i in 0..$size, j in i + 1..$size) = (x[i] - x[j]).hypot(y[i] - y[j]) - 2.0 * r,
            impact(i in 0..$size) = 1.0 - r - x[i].abs(),
            impact(i in 0..$size) = 1.0 - r - y[i].abs(),
            momenta(p_x = sum(0..$size, |i| m[i] * dot(x[i]))),
        )]
        struct $name<$($generics)*> { $($field: $type,)* r: f64 }
    };
}

discs!(Literal [] 4, { m: [f64; 4] });
discs!(Constant [const N: usize] N, { m: [f64; N] });
discs!(RunTime [] n, { n: usize, m: Vec<f64> });

/// The same with a family for each difference of numbers.
#[lagrangian(
    coordinates(x[4], y[4]),
    lagrangian = sum(0..4, |i| m[i] * (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
    impact(i in 1..4) = gap(i, i - 1),
    impact(i in 2..4) = gap(i, i - 2),
    impact = gap(3, 0),
    impact(i in 0..4) = 1.0 - r - x[i].abs(),
    impact(i in 0..4) = 1.0 - r - y[i].abs(),
    let = { let gap = |i, j| (x[j] - x[i]).hypot(y[j] - y[i]) - 2.0 * r; },
)]
struct ByDifferences {
    m: [f64; 4],
    r: f64,
}

const M: [f64; 4] = [1.0, 2.0, 0.5, 1.5];
const X: [f64; 4] = [-0.6, -0.1, 0.3, 0.7];
const Y: [f64; 4] = [0.2, -0.4, 0.5, -0.1];
const DOT_X: [f64; 4] = [0.9, -0.3, 0.4, -1.1];
const DOT_Y: [f64; 4] = [-0.2, 0.8, -0.7, 0.3];
const R: f64 = 0.12;

#[test]
fn discs_are_the_same_however_their_pairs_are_declared() -> Outcome {
    let (steps, h, method) = (1000, 0.01, Impacts::reflecting(Variational::midpoint()));
    let (x, y, dot_x, dot_y) = (X, Y, DOT_X, DOT_Y);
    let apart = ByDifferences { m: M, r: R };
    let mut expected = Integrator::new(&apart, method, h, ByDifferencesState { x, y, dot_x, dot_y })?;
    let energy = expected.energy();
    expected.take_steps(steps)?;
    assert!(expected.memory().total() > 30, "{} impacts", expected.memory().total());
    assert_relative_eq!(expected.energy(), energy, max_relative = 1e-12);

    let literal = Literal { m: M, r: R };
    let mut run = Integrator::new(&literal, method, h, LiteralState { x, y, dot_x, dot_y })?;
    run.take_steps(steps)?;
    assert_eq!(run.memory().total(), expected.memory().total());
    assert_abs_diff_eq!(run.q(), expected.q(), epsilon = 1e-9);
    assert_relative_eq!(run.energy(), energy, max_relative = 1e-12);

    let constant = Constant { m: M, r: R };
    let mut other = Integrator::new(&constant, method, h, ConstantState { x, y, dot_x, dot_y })?;
    other.take_steps(steps)?;
    assert_eq!(other.q(), run.q());

    let run_time = RunTime { n: 4, m: M.to_vec(), r: R };
    let [x, y, dot_x, dot_y] = [x, y, dot_x, dot_y].map(|entries| entries.to_vec());
    let mut other = Integrator::new(&run_time, method, h, RunTimeState { x, y, dot_x, dot_y })?;
    other.take_steps(steps)?;
    assert_eq!(other.q(), run.q());
    Ok(())
}

/// The surfaces stand in the order of the pairs, and have the gradients of their own pair.
#[test]
fn members_are_numbered_row_by_row() {
    let n = 5;
    let discs = RunTime { n, m: vec![1.0; n], r: R };
    let q: Vec<f64> = (0..2 * n).map(|k| (1.3 * k as f64).sin()).collect();
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j])).collect();
    let m = discs.multipliers().dimension();
    assert_eq!(m, pairs.len() + 2 * n);
    let mut gaps = vec![0.0; m];
    discs.gap(&q, 0.0, &mut gaps);
    for (number, [i, j]) in pairs.iter().enumerate() {
        let expected = (q[*i] - q[*j]).hypot(q[n + i] - q[n + j]) - 2.0 * R;
        assert_abs_diff_eq!(gaps[number], expected, epsilon = 1e-15);
    }
    for i in 0..2 * n {
        assert_abs_diff_eq!(gaps[pairs.len() + i], 1.0 - R - q[i].abs(), epsilon = 1e-15);
    }
}

/// Rows of other shapes: ranges that grow, that end before they begin, that go on backwards, in three kinds
/// of sizes.
#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |i| dot(x[i]).powi(2)) / 2.0,
    impact(i in 1..n, j in 0..i) = x[i] - x[j] + 100.0,
    impact(i in 0..n, j in i + 2..n) = x[i] * 2.0 - x[j] + 100.0,
    impact(i in 0..n, j in 2..2 * i) = x[i] * 3.0 - x[(i + j) % n] + 100.0,
    impact(i in 1..n - 1, j in i - 1..=i + 1) = x[i] * 4.0 - x[j] * x[j] + 100.0,
    impact(k in 0..n, l in 0..m) = x[k] * 5.0 - (l as f64) + 100.0,
)]
struct Shapes {
    n: usize,
    m: usize,
}

#[test]
fn rows_of_any_length_are_counted() {
    for (n, m) in [(1, 0), (2, 1), (3, 0), (4, 3), (7, 2)] {
        let system = Shapes { n, m };
        let x: Vec<f64> = (0..n).map(|k| (0.7 + 1.9 * k as f64).cos()).collect();
        let mut expected = Vec::new();
        expected.extend((1..n).flat_map(|i| (0..i).map(move |j| [i, j])).map(|[i, j]| x[i] - x[j] + 100.0));
        let ahead = (0..n).flat_map(|i| (i + 2..n).map(move |j| [i, j]));
        expected.extend(ahead.map(|[i, j]| x[i] * 2.0 - x[j] + 100.0));
        let growing = (0..n).flat_map(|i| (2..2 * i).map(move |j| [i, j]));
        expected.extend(growing.map(|[i, j]| x[i] * 3.0 - x[(i + j) % n] + 100.0));
        let beside = (1..n.saturating_sub(1)).flat_map(|i| (i - 1..=i + 1).map(move |j| [i, j]));
        expected.extend(beside.map(|[i, j]| x[i] * 4.0 - x[j] * x[j] + 100.0));
        let all = (0..n).flat_map(|k| (0..m).map(move |l| (k, l as f64)));
        expected.extend(all.map(|(k, l)| x[k] * 5.0 - l + 100.0));
        let mut gaps = vec![0.0; system.multipliers().dimension()];
        system.gap(&x, 0.0, &mut gaps);
        assert_abs_diff_eq!(gaps.as_slice(), expected.as_slice(), epsilon = 1e-13);
    }
}
