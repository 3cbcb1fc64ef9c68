//! The systems of the gallery and the initial data of the papers.

pub use crate::by_hand::*;

/// Four vortices.
pub type FourVortices = PointVortices<4>;
/// The state of four vortices.
pub type FourPoints = PointVorticesState<4>;

/// A system with its initial state.
#[derive(Clone, Debug)]
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
