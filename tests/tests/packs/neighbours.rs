//! Terms that add to several entries of one array: beside one another, farther apart, and around the end of
//! a ring.

use dvi_core::prelude::*;

use super::{SIZES, gradients_agree, numbers};

/// Terms that add to several entries of one array: beside one another, as far apart as a pack has terms,
/// nearly so far, and farther.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| y[j] * d(x[j])),
    hamiltonian = sum(1..n, |j| x[j] * x[j - 1] + y[j - 1].powi(2) * y[j])
        - sum(0..n - 2, |j| k[j] * (x[j + 2] - 2.0 * x[j + 1] + x[j]).powi(2)) / 2.0
        - sum(stride..n, |j| x[j - stride] * y[j] * x[j])
        + sum(9..n, |j| k[j] * x[j] * x[j - 7] * x[j - 8] * x[j - 9] * y[j - 3] * y[j - 3])
        - sum(8..n, |j| x[j] * x[j - 8] - y[j] * y[j - 7] * x[j - 4]),
)]
struct Neighbours {
    n: usize,
    stride: usize,
    k: Vec<f64>,
}

#[test]
fn entries_beside_one_another_and_far_apart() {
    for (n, stride) in (2..45).flat_map(|n| [1, 2, 9].map(|stride| (n, stride))) {
        gradients_agree(&Neighbours { n, stride, k: numbers(n, 11) }, &numbers(2 * n, 12));
    }
}

/// A ring: neighbours on both sides, also beyond its end.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| y[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| k[(j + 1) % n] * x[j] * x[(j + 1) % n] * y[(j + n - 2) % n])
        * sum(0..n, |j| x[j] * y[(j + 3) % n]) + sum(2..n, |j| x[(j + 1) % n] * y[(j - 1) % n].powi(2)),
)]
struct Ring {
    n: usize,
    k: Vec<f64>,
}

#[test]
fn entries_around_the_end_of_a_ring() {
    for n in SIZES {
        gradients_agree(&Ring { n, k: numbers(n, 13) }, &numbers(2 * n, 14));
    }
}
