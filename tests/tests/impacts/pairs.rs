//! Families with two indices: discs that collide with each other in the plane.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dvi_core::prelude::*;
use dvi_core::{ConstrainedSystem, Space, UnilateralLagrangian};

use super::Outcome;

/// Discs in a box.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |i| m[i] * (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
    impact(i in 0..n, j in i + 1..n) = (x[i] - x[j]).hypot(y[i] - y[j]) - 2.0 * r,
    impact(i in 0..n) = 1.0 - r - x[i].abs(),
    impact(i in 0..n) = 1.0 - r - y[i].abs(),
)]
struct Discs {
    n: usize,
    m: Vec<f64>,
    r: f64,
}

const R: f64 = 0.12;

#[test]
fn discs_keep_their_energy() -> Outcome {
    let discs = Discs { n: 4, m: vec![1.0, 2.0, 0.5, 1.5], r: R };
    let start = DiscsState {
        x: vec![-0.6, -0.1, 0.3, 0.7],
        y: vec![0.2, -0.4, 0.5, -0.1],
        dot_x: vec![0.9, -0.3, 0.4, -1.1],
        dot_y: vec![-0.2, 0.8, -0.7, 0.3],
    };
    let mut run = Integrator::new(&discs, Impacts::reflecting(Variational::midpoint()), 0.01, start)?;
    let energy = run.energy();
    run.take_steps(1000)?;
    assert!(run.memory().total() > 30, "{} impacts", run.memory().total());
    assert_relative_eq!(run.energy(), energy, max_relative = 1e-12);
    Ok(())
}

/// Surfaces are numbered row by row: ranges that grow, that end before they begin, that go on backwards, in three kinds
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
