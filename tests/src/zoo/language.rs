//! Correlated indices, and functions with corners.

use dvi_core::degenerate_lagrangian;

/// Indices that are differences of indices, and one that stays in range because i < j.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..N, |i, j| x[i + 1] * x[j] * g[i + 1])
                      + sum_pairs(0..N, |j, k| g[k - j - 1] * x[j] * y[k] * y[j + 1].cos())
                      + sum(0..N, |j| sum(j..N, |k| x[k - j] * y[k])),
)]
#[derive(Clone, Debug)]
pub struct Neighbours<const N: usize> {
    /// Coupling.
    pub g: Box<[f64]>,
}

/// `min` and `max`, on both sides of their seams.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x + y.min(0.3) * y) * d(y),
    hamiltonian = (x * x).min(y) * 3.0 + x.max(y * y).max(0.1).sin() - 2.0_f64.min(3.0) * x,
)]
#[derive(Clone, Debug)]
pub struct Corners;
