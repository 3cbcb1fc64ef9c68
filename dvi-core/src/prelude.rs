//! What a user of the integrators needs, the types of runs among it: `Integrator<Pendulum,
//! Variational<Unfitted, Trapezoid>>` is a field of a struct. Which method to begin with says [Choosing a
//! method](crate::guide::choosing_a_method).
//!
//! ```
//! use dvi_core::prelude::*;
//!
//! #[lagrangian(coordinates(angle), lagrangian = dot(angle).powi(2) / 2.0 + angle.cos())]
//! struct Pendulum;
//!
//! let start = PendulumState { angle: 1.0, dot_angle: 0.0 };
//! let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start)?;
//! run.take_steps(1000)?;
//! assert!((run.energy() + 1_f64.cos()).abs() < 1e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(inline)]
pub use crate::diagnostics::{LyapunovExponent, TangentMap, Work, convergence_order};
#[doc(inline)]
pub use crate::discrete::{
    Constant, Curvature, Midpoint, Quadrature, Radial, Reading, Simpson, Trapezoid, Unfitted,
};
#[doc(inline)]
pub use crate::error::{StartError, StepError, StepFailure};
#[doc(inline)]
pub use crate::mechanics::{AtState, InLanes, OnConstraints};
#[cfg(feature = "random")]
#[doc(inline)]
pub use crate::methods::Langevin;
#[doc(inline)]
pub use crate::methods::{
    Collision, Composition, Constrained, EnergyLimit, Fitting, Galerkin, Gauss, Geodesic, Impacts, Method,
    Newmark, OneStep, OneStepGauss, ParasiticMode, Projected, Rattle, RungeKutta, Scheme, Sigma, Start,
    Tabulated, Tolerance, Variational,
};
#[cfg(feature = "records")]
#[doc(inline)]
pub use crate::record::Recorded;
#[cfg(feature = "alloc")]
#[doc(inline)]
pub use crate::run::{Checkpoint, Together};
#[doc(inline)]
pub use crate::run::{
    Dense, Direction, EnergyMomentum, ErrorControl, Event, Events, Integrator, Reversible, Run, StepControl,
};
#[doc(inline)]
pub use crate::solve::{Solver, Stopping};
#[doc(inline)]
pub use crate::state::{Statistics, Summation};
#[doc(inline)]
pub use crate::{
    DegenerateLagrangian, Held, HolonomicLagrangian, Lagrangian, ManifoldLagrangian,
    NondegenerateLagrangian, RegularLagrangian, State, System, TimeTransformed, UnilateralLagrangian,
};
#[cfg(feature = "macros")]
#[doc(inline)]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
