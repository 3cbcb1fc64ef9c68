//! Constraints of the velocities.

use dvi_core::prelude::*;

/// Constraints of the velocities with coefficients that are linear in the coordinates.
#[lagrangian(
    coordinates(q[4]),
    lagrangian = sum(0..4, |j| m[j] * dot(q[j]).powi(2) / 2.0),
    nonholonomic(i in 0..2) = sum(0..4, |j| (a[i][j] + sum(0..4, |k| b[i][j][k] * q[k])) * dot(q[j])) + c[i],
)]
#[derive(Clone, Copy, Debug)]
pub struct Bundle {
    /// Masses.
    pub m: [f64; 4],
    /// Coefficients of the velocities where q = 0.
    pub a: [[f64; 4]; 2],
    /// Their derivatives.
    pub b: [[[f64; 4]; 4]; 2],
    /// What a constraint has beside the velocities.
    pub c: [f64; 2],
}
