//! What a user of the integrators needs.

pub use crate::diagnostics::{
    AlternatingComponent, Crossing, Direction, LyapunovExponent, Section, TangentMap, TwoPointTangentMap,
    Work, convergence_order,
};
pub use crate::discrete::{Constant, Curvature, Quadrature, Radial, Reading};
pub use crate::error::{StartError, StepError, StepFailure};
pub use crate::mechanics::{AtState, OnConstraints};
#[cfg(feature = "random")]
pub use crate::methods::Langevin;
pub use crate::methods::{
    Collision, Composition, Constrained, EnergyLimit, Fitting, Galerkin, Gauss, Geodesic, Impacts, Newmark,
    OneStep, OneStepGauss, ParasiticMode, Projected, Rattle, RungeKutta, Scheme, Sigma, Start, Tolerance,
    Variational,
};
#[cfg(feature = "records")]
pub use crate::record::Recorded;
pub use crate::run::{
    CentreSpeed, ControlledIntegrator, Density, EnergyMomentum, ErrorControl, Integrator, Osculating, Power,
    Reversible, Run,
};
pub use crate::solve::{Solver, Stopping};
pub use crate::state::Summation;
pub use crate::{
    DegenerateLagrangian, HolonomicLagrangian, Lagrangian, ManifoldLagrangian, NondegenerateLagrangian,
    RegularLagrangian, System, TimeTransformed, UnilateralLagrangian,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
