//! Point vortices, and the initial data of Rowley & Marsden 2002, section 5.

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

/// Four vortices.
pub type FourVortices = PointVortices<4>;
/// The state of four vortices.
pub type FourPoints = PointVorticesState<4>;

/// A system with its initial state.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The vortices.
    pub vortices: FourVortices,
    /// Where they are at t = 0.
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
