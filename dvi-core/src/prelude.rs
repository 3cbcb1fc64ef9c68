//! What a user of the integrators needs.

pub use crate::diagnostics::{
    AlternatingComponent, Crossing, Direction, LyapunovExponent, Section, TangentMap, TwoPointTangentMap,
    convergence_order,
};
pub use crate::{
    DegenerateLagrangian, Gauss, Integrator, Lagrangian, RegularLagrangian, RungeKutta, Scheme, Sigma,
    Solver, Start, StartError, StepError, StepFailure, Stopping,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
