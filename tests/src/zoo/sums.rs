//! Sums: nonlinear functions of them, products of them, one inside of another, dependent ranges.

use dvi_core::degenerate_lagrangian;

/// Nonlinear functions of sums: their second derivatives couple everything to everything.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = (1.0 + sum(0..N, |j| x[j] * x[j])).sqrt() * sum(0..N, |k| y[k] * d(x[k]))
                      + sum(0..N, |j| x[j] * d(y[j])) / 4.0,
    hamiltonian = sum(0..N, |j| m[j] * (x[j] * x[j] + y[j] * y[j])).sqrt()
                      + sum(0..N, |j| x[j].sin()) * sum(0..N, |k| m[k] * y[k] * y[k])
                      + sum(0..N, |j| x[j] * y[j]).cos() / (1.0 + sum(0..N, |j| y[j].powi(2))),
)]
#[derive(Clone, Debug)]
pub struct FunctionsOfSums<const N: usize> {
    /// Weights.
    pub m: [f64; N],
}

/// Logarithms of sums of exponentials, Σⱼ ln Σₖ exp(−cⱼₖ (xⱼ − yₖ)²), and a sum of squares of sums.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| x[j] * sum(0..N, |k| c[k][j] * x[k]).sin() * d(y[j]) + x[j] * d(y[j])),
    hamiltonian = sum(0..N, |j| sum(0..N, |k| (-c[j][k] * (x[j] - y[k]).powi(2)).exp()).ln())
                      + sum(0..N, |j| sum(0..N, |k| sum(0..N, |l| c[k][l] * x[l] * y[j]).sin() * x[k]).powi(2)),
)]
#[derive(Clone, Debug)]
pub struct NestedSums<const N: usize> {
    /// Coefficients.
    pub c: [[f64; N]; N],
}

/// Neighbours in ranges whose bounds depend on an outer index.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| (x[j] + sum(0..j, |k| x[k] * y[k])) * d(y[j])),
    hamiltonian = sum(0..N - 1, |j| sum(0..j + 1, |k| (x[k + 1] - y[k]).powi(2) * y[j]))
                      + sum(1..=3, |j| sum(j..N, |k| x[k - j] * x[k] * y[j]).sin())
                      + sum(0..N, |j| x[N - 1 - j] * y[j] * (N - j) as f64),
)]
#[derive(Clone, Debug)]
pub struct Staircase<const N: usize> {}

/// Σ over j ≠ k of a force that is not symmetric, with the sum over all other bodies inside of a root.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form    = sum(0..N, |j| x[j] * d(y[j])) + sum_ordered_pairs(0..N, |j, k| c[j][k] * x[j] * x[k] * d(y[k])),
    hamiltonian = sum_ordered_pairs(0..N, |j, k| c[j][k] * (x[j] - x[k]).sin() * y[j])
                      + (2.0 + sum_ordered_pairs(0..N, |j, k| x[j] * y[k] * y[k])).ln()
                      + sum_pairs(0..N, |j, k| sum_pairs(0..N, |l, m| x[j] * x[l] * (y[k] - y[m]).cos())),
)]
#[derive(Clone, Debug)]
pub struct OrderedPairs<const N: usize> {
    /// Couplings.
    pub c: [[f64; N]; N],
}
