//! Correlated indices, sizes that are sums, fields of fields, and functions with corners.

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

/// Constants of a material.
#[derive(Clone, Debug)]
pub struct Material {
    /// Masses.
    pub masses: Vec<f64>,
    /// Elasticity.
    pub elastic: Elastic,
}

/// Constants of a spring.
#[derive(Clone, Copy, Debug)]
pub struct Elastic {
    /// Stiffness.
    pub k: f64,
}

/// Fields of fields, sizes that are sums, and one that is the length of a field of a field.
#[degenerate_lagrangian(
    coordinates(x[N + 1], y[N + 1], u[2 * N], v[2 * N], w[material.masses.len()], z[material.masses.len()]),
    one_form    = sum(0..N + 1, |j| x[j] * d(y[j])) + sum(0..2 * N, |j| u[j] * d(v[j]))
                      + sum(0..self.material.masses.len(), |j| w[j] * d(z[j])),
    hamiltonian = sum(0..N, |j| material.elastic.k * (x[j + 1] - x[j]).powi(2)) + sum(0..N + 1, |j| y[j] * y[j])
                      + sum(0..2 * N, |j| u[j] * v[j])
                      + sum(0..material.masses.len(), |j| self.material.masses[j] * w[j] * z[j] * z[j]),
)]
#[derive(Clone, Debug)]
pub struct Nested<const N: usize> {
    /// Material.
    pub material: Material,
}

/// `min` and `max`, on both sides of their seams.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x + y.min(0.3) * y) * d(y),
    hamiltonian = (x * x).min(y) * 3.0 + x.max(y * y).max(0.1).sin() - 2.0_f64.min(3.0) * x,
)]
#[derive(Clone, Debug)]
pub struct Corners;
