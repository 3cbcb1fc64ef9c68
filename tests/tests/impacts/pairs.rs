//! Families with two indices.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::{ConstrainedSystem, Space};

/// Surfaces are numbered row by row: ranges that grow, that end before they begin, that go on backwards, in
/// three kinds of sizes.
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
