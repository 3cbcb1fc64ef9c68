//! What a user of the integrators needs.

pub use crate::diagnostics::{
    AlternatingComponent, Crossing, Direction, LyapunovExponent, Section, TangentMap, TwoPointTangentMap,
    convergence_order,
};
pub use crate::{
    CentreSpeed, Composition, Constant, ControlledIntegrator, Curvature, DegenerateLagrangian, Density,
    EnergyLimit, Fitting, Galerkin, Gauss, Integrator, Lagrangian, Newmark, Osculating, ParasiticMode,
    PerCoordinate, Power, Quadrature, Radial, Reading, RegularLagrangian, Reversible, Run, RungeKutta,
    Scheme, Sigma, Solver, Start, StartError, StepError, StepFailure, Stopping, Summation, Variational,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
