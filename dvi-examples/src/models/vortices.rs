//! Point vortices in the plane and on the unit sphere, vortex blobs and a layer of them, and the initial
//! data of Rowley & Marsden 2002, section 5.

use std::f64::consts::TAU;

use dvi_core::State as _;
use dvi_core::prelude::*;

/// Point vortices in the plane (Rowley & Marsden 2002, eq. 4, with each pair counted once).
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
    momenta(
        impulse_x = sum(0..N, |j| gamma[j] * x[j]),
        impulse_y = sum(0..N, |j| gamma[j] * y[j]),
        angular = sum(0..N, |j| gamma[j] * (x[j].powi(2) + y[j].powi(2))),
    ),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct PointVortices<const N: usize> {
    /// The circulations Γ.
    pub gamma: [f64; N],
}

pub type FourVortices = PointVortices<4>;
pub type FourPoints = PointVorticesState<4>;

/// A system with its initial state.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    pub vortices: FourVortices,
    pub start: FourPoints,
}

/// Two pairs that leapfrog past each other (section 5, first table).
pub fn leapfrogging() -> Case {
    Case {
        vortices: PointVortices { gamma: [1.0, 1.0, -1.0, -1.0] },
        start: PointVorticesState { x: [-1.0, 1.0, -1.0, 1.0], y: [2.0, 2.0, -2.0, -2.0] },
    }
}

/// Four equal vortices in quasi-periodic motion (section 5, second table, upper half).
pub fn quasi_periodic() -> Case {
    Case {
        vortices: PointVortices { gamma: [1.0; 4] },
        start: PointVorticesState { x: [1.0, 0.866, -0.85, -0.5], y: [1.0, 0.45, -1.363636, -0.15] },
    }
}

/// Four equal vortices in chaotic motion (section 5, second table, lower half).
pub fn chaotic() -> Case {
    Case {
        vortices: PointVortices { gamma: [1.0; 4] },
        start: PointVorticesState { x: [-1.85, -0.07, 0.78, 0.76], y: [0.05, -1.332, 0.167, -1.2902] },
    }
}

/// In z = cos θ and the longitude φ, with α = −Σ Γ z dφ along the longitudes only. The moment Σ Γ r is
/// conserved, of which the component along the axis belongs to the rotation of all longitudes.
#[degenerate_lagrangian(
    coordinates(z[N], phi[N]),
    one_form    = sum(0..N, |j| -gamma[j] * z[j] * d(phi[j])),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k] * (2.0 - 2.0 * (z[j] * z[k]
        + ((1.0 - z[j].powi(2)) * (1.0 - z[k].powi(2))).sqrt() * (phi[j] - phi[k]).cos())).ln()) / (4.0 * PI),
    momenta(
        moment_x = sum(0..N, |j| gamma[j] * (1.0 - z[j].powi(2)).sqrt() * phi[j].cos()),
        moment_y = sum(0..N, |j| gamma[j] * (1.0 - z[j].powi(2)).sqrt() * phi[j].sin()),
        moment_z = sum(0..N, |j| gamma[j] * z[j]),
    ),
)]
#[derive(Clone, Debug)]
pub struct SphereVortices<const N: usize> {
    pub gamma: [f64; N],
}

impl<const N: usize> SphereVortices<N> {
    /// r of each vortex of a state in flat form.
    pub fn places(&self, q: &[f64]) -> [[f64; 3]; N] {
        std::array::from_fn(|j| {
            let (z, (sin, cos)) = (q[j], q[j + N].sin_cos());
            let radius = (1.0 - z * z).sqrt();
            [radius * cos, radius * sin, z]
        })
    }

    /// Vortices at these places, which need not be of length one.
    pub fn state(places: [[f64; 3]; N]) -> SphereVorticesState<N> {
        SphereVorticesState {
            z: places.map(|[x, y, z]| z / (x * x + y * y + z * z).sqrt()),
            phi: places.map(|[x, y, _]| y.atan2(x)),
        }
    }
}

/// The same as unit vectors, which know no poles.
#[degenerate_lagrangian(
    coordinates(r[N]: S2),
    one_form    = sum(0..N, |j| gamma[j] * area(r[j])),
    hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k] * (r[j] - r[k]).norm_squared().ln()) / (4.0 * PI),
)]
#[derive(Clone, Debug)]
pub struct VortexVectors<const N: usize> {
    pub gamma: [f64; N],
}

impl<const N: usize> VortexVectors<N> {
    /// r of each vortex of a state in flat form.
    pub fn places(&self, q: &[f64]) -> [[f64; 3]; N] {
        VortexVectorsState::read(&|_| N, q, &[]).r
    }
}

/// Vortices whose vorticity is spread over a core of some radius (Krasny 1986), any number of them.
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + core.powi(2)).ln()) / (4.0 * PI),
    momenta(
        impulse_x = sum(0..gamma.len(), |j| gamma[j] * x[j]),
        impulse_y = sum(0..gamma.len(), |j| gamma[j] * y[j]),
        angular = sum(0..gamma.len(), |j| gamma[j] * (x[j].powi(2) + y[j].powi(2))),
    ),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct VortexBlobs {
    pub gamma: Vec<f64>,
    pub core: f64,
}

/// A layer of equal blobs between two flows, whose velocities differ by 1, with waves of length 1 on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLayer {
    /// Rows of blobs, one above the other.
    pub rows: usize,
    pub amplitude: f64,
}

impl ShearLayer {
    /// Its length, in waves.
    pub const LENGTH: f64 = 8.0;
    pub const THICKNESS: f64 = 0.12;
    pub const CORE: f64 = 0.02;

    /// The number of blobs: they are a little more apart along the layer than across.
    pub fn blobs(self) -> usize {
        self.rows * (self.rows * 125 / 2)
    }

    /// The blobs, of which those of one column follow each other.
    pub fn system(self) -> VortexBlobs {
        let n = self.blobs();
        VortexBlobs { gamma: vec![Self::LENGTH / n as f64; n], core: Self::CORE }
    }

    /// Their places with waves.
    pub fn state(self) -> VortexBlobsState {
        let Self { rows, amplitude } = self;
        let columns = self.blobs() / rows;
        let place = |blob: usize| {
            let (column, row) = (blob / rows, blob % rows);
            // Every other row is shifted.
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            let x = Self::LENGTH * ((column as f64 + shift) / columns as f64 - 0.5);
            let across = (row as f64 + 0.5) / rows as f64 - 0.5;
            (x, Self::THICKNESS * across + amplitude * (TAU * x).sin())
        };
        let (x, y) = (0..columns * rows).map(place).unzip();
        VortexBlobsState { x, y }
    }
}
