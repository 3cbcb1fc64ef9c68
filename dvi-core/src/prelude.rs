//! What a user of the integrators needs.

pub use crate::diagnostics::{
    AlternatingComponent, Crossing, Direction, LyapunovExponent, Section, TangentMap, TwoPointTangentMap,
    convergence_order,
};
pub use crate::{
    Composition, Constant, Curvature, DegenerateLagrangian, Fitting, Gauss, Integrator, Lagrangian,
    PerCoordinate, Quadrature, Radial, Reading, RegularLagrangian, RungeKutta, Scheme, Sigma, Solver, Start,
    StartError, StepError, StepFailure, Stopping, Variational,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
