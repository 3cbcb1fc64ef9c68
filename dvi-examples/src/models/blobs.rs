//! Vortex blobs, and a layer of them.

use std::f64::consts::TAU;

use dvi_core::prelude::*;

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
    /// The circulations Γ.
    pub gamma: Vec<f64>,
    /// The radius of the cores.
    pub core: f64,
}

/// A layer of equal blobs between two flows, whose velocities differ by 1, with waves of length 1 on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLayer {
    /// Rows of blobs, one above the other.
    pub rows: usize,
    /// The amplitude of the waves.
    pub amplitude: f64,
}

impl ShearLayer {
    /// Its length, in waves.
    pub const LENGTH: f64 = 8.0;
    /// Its thickness.
    pub const THICKNESS: f64 = 0.12;
    /// The radius of a core.
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

    /// Their places in the layer without waves.
    pub fn rest(self) -> impl Iterator<Item = [f64; 2]> {
        let Self { rows, .. } = self;
        let columns = self.blobs() / rows;
        (0..columns * rows).map(move |blob| {
            let (column, row) = (blob / rows, blob % rows);
            // Every other row is shifted.
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            let along = (column as f64 + shift) / columns as f64 - 0.5;
            let across = (row as f64 + 0.5) / rows as f64 - 0.5;
            [Self::LENGTH * along, Self::THICKNESS * across]
        })
    }

    /// Their places with waves.
    pub fn state(self) -> VortexBlobsState {
        let wave = |x: f64| self.amplitude * (TAU * x).sin();
        let (x, y) = self.rest().map(|[x, y]| (x, y + wave(x))).unzip();
        VortexBlobsState { x, y }
    }
}
