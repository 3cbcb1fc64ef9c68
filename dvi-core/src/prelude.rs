//! What a user of the integrators needs, the types of runs among it: `Integrator<Pendulum,
//! Variational<Unfitted, Trapezoid>>` is a field of a struct.

pub use crate::diagnostics::{
    AlternatingComponent, LyapunovExponent, TangentMap, TwoPointTangentMap, Work, convergence_order,
};
pub use crate::discrete::{
    Constant, Curvature, Midpoint, Quadrature, Radial, Reading, Simpson, Trapezoid, Unfitted,
};
pub use crate::error::{StartError, StepError, StepFailure};
pub use crate::mechanics::{AtState, InLanes, OnConstraints};
#[cfg(feature = "random")]
pub use crate::methods::Langevin;
pub use crate::methods::{
    Collision, Composition, Constrained, EnergyLimit, Fitting, Galerkin, Gauss, Geodesic, Impacts, Method,
    Newmark, OneStep, OneStepGauss, ParasiticMode, Projected, Rattle, RungeKutta, Scheme, Sigma, Start,
    Tabulated, Tolerance, Variational,
};
#[cfg(feature = "records")]
pub use crate::record::Recorded;
pub use crate::run::{
    CentreSpeed, ControlledIntegrator, Dense, Density, Direction, EnergyMomentum, ErrorControl, Event,
    Events, Integrator, Osculating, Power, Reversible, Run, StepControl, WithMethod,
};
#[cfg(feature = "alloc")]
pub use crate::run::{Checkpoint, Together};
pub use crate::solve::{Solver, Stopping};
pub use crate::state::{Statistics, Summation};
pub use crate::{
    DegenerateLagrangian, Held, HolonomicLagrangian, Lagrangian, ManifoldLagrangian,
    NondegenerateLagrangian, RegularLagrangian, State, System, TimeTransformed, UnilateralLagrangian,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
