//! The systems that are stepped. They are this package's own: a test builds it once more, in release mode,
//! and all that it depends on (`cargo tree -p dvi-kernels`).

use dvi_core::prelude::*;

/// Point vortices in the plane.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
)]
#[derive(Debug)]
pub(crate) struct PointVortices<const N: usize> {
    pub(crate) gamma: [f64; N],
}

/// Two leapfrogging pairs (Rowley & Marsden 2002, section 5, first table).
pub(crate) fn leapfrogging() -> (PointVortices<4>, PointVorticesState<4>) {
    let start = PointVorticesState { x: [-1.0, 1.0, -1.0, 1.0], y: [2.0, 2.0, -2.0, -2.0] };
    (PointVortices { gamma: [1.0, 1.0, -1.0, -1.0] }, start)
}

/// Four equal vortices in quasi-periodic motion (the same, second table, upper half).
pub(crate) fn quasi_periodic() -> (PointVortices<4>, PointVorticesState<4>) {
    let start = PointVorticesState { x: [1.0, 0.866, -0.85, -0.5], y: [1.0, 0.45, -1.363636, -0.15] };
    (PointVortices { gamma: [1.0; 4] }, start)
}

/// Point vortices whose number is known at run time only.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
)]
#[derive(Debug)]
pub(crate) struct ManyVortices {
    pub(crate) gamma: Vec<f64>,
}

/// Predators and prey, in the gauge with all of α on one coordinate.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y.ln() / x * d(x),
    hamiltonian = a[0] * x + a[1] * y + b[0] * x.ln() + b[1] * y.ln(),
)]
#[derive(Debug)]
pub(crate) struct OneSided {
    pub(crate) a: [f64; 2],
    pub(crate) b: [f64; 2],
}

/// A planet around a fixed sun.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
)]
#[derive(Debug)]
pub(crate) struct Kepler {
    pub(crate) mu: f64,
}

/// A mass on a sphere with springs to three planes: Neumann's problem.
#[lagrangian(
    coordinates(r[3]),
    lagrangian = sum(0..3, |i| m * dot(r[i]).powi(2) - k[i] * r[i].powi(2)) / 2.0,
    constraint = sum(0..3, |i| r[i].powi(2)) - 1.0,
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neumann {
    pub(crate) m: f64,
    pub(crate) k: [f64; 3],
}

/// A heavy symmetric top that turns about its tip.
#[lagrangian(
    coordinates(R: SO3),
    lagrangian = (inertia[0] * omega(R)[0].powi(2) + inertia[1] * omega(R)[1].powi(2)
        + inertia[2] * omega(R)[2].powi(2)) / 2.0 - weight * R[2][2],
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Top {
    pub(crate) inertia: [f64; 3],
    pub(crate) weight: f64,
}
