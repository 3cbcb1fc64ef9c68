//! What a user of the integrators needs, the types of runs among it: `Integrator<Pendulum,
//! Variational<Unfitted, Trapezoid>>` is a field of a struct.
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
//!
//! # Systems
//!
//! | name | what it is |
//! |---|---|
//! | [`lagrangian`](../attr.lagrangian.html) | the attribute for regular Lagrangians, L(q, v, t) |
//! | [`degenerate_lagrangian`](../attr.degenerate_lagrangian.html) | the attribute for degenerate ones, α(q, t)·v − H(q, t) |
//! | [`System`] | what an attribute makes of a struct: names, sizes, a report |
//! | [`State`] | a state with named coordinates |
//! | [`Held`] | a system as a run takes it: its own, borrowed, shared |
//! | [`Lagrangian`] | L with its derivatives |
//! | [`DegenerateLagrangian`] | α and H with theirs |
//! | [`NondegenerateLagrangian`] | L with a regular mass matrix |
//! | [`RegularLagrangian`] | the same, without constraints or impacts |
//! | [`HolonomicLagrangian`] | with constraints of positions |
//! | [`UnilateralLagrangian`] | with impacts |
//! | [`ManifoldLagrangian`] | with rotations and unit vectors |
//! | [`TimeTransformed`] | with a time that is transformed |
//! | [`AtState`] | energy and rates of change at a state, without a run |
//! | [`OnConstraints`] | states on constraints, and the multipliers there |
//!
//! # Methods
//!
//! | name | what it is |
//! |---|---|
//! | [`Variational`] | quadrature rules on straight lines: Störmer–Verlet, midpoint, phase fitting |
//! | [`Galerkin`] | paths that bend: order 4 to 16 |
//! | [`Gauss`] | collocation: order 2 to 16 |
//! | [`Newmark`] | for stiff forces |
//! | [`Langevin`](../methods/struct.Langevin.html) | with friction and noise of a heat bath |
//! | [`RungeKutta`] | to compare with |
//! | [`Rattle`] | with constraints of positions |
//! | [`Constrained`] | with constraints of any kind |
//! | [`Impacts`] | with impacts |
//! | [`Geodesic`] | on rotations and unit vectors |
//! | [`Sigma`] | the σ-family, for degenerate systems |
//! | [`OneStep`] | for degenerate systems, without a parasitic mode |
//! | [`OneStepGauss`] | the same, of order 2 to 8 |
//! | [`Projected`] | for all other degenerate systems |
//! | [`Composition`] | several steps make one of order 4, 6 or 8 |
//! | [`EnergyLimit`] | ends a run whose energy goes astray |
//! | [`Scheme`] | order, symmetry and form of a method |
//! | [`Method`] | what a run asks of a method |
//! | [`Tabulated`] | methods with as many nodes as there are coefficients for |
//!
//! # Options of methods
//!
//! | name | what it is |
//! |---|---|
//! | [`Quadrature`] | any quadrature rule |
//! | [`Midpoint`] | the rule with the node ½ |
//! | [`Trapezoid`] | the rule with the nodes 0 and 1 |
//! | [`Simpson`] | the rule with the nodes 0, ½ and 1 |
//! | [`Unfitted`] | no frequency: straight lines |
//! | [`Constant`] | a frequency that is known |
//! | [`Curvature`] | the frequency at which the path turns |
//! | [`Radial`] | the frequency √(a/r) of a central force |
//! | [`Reading`] | how a frequency is read from the motion |
//! | [`Fitting`] | what is fitted to a frequency |
//! | [`Collision`] | what is kept at an impact |
//! | [`Start`] | how the σ-family begins |
//! | [`ParasiticMode`] | what of a run of the σ-family alternates |
//! | [`Solver`] | how implicit steps are solved |
//! | [`Stopping`] | when they count as solved |
//! | [`Summation`] | how increments are added up |
//! | [`InLanes`] | stages, or nodes, are evaluated at once |
//!
//! # Runs
//!
//! | name | what it is |
//! |---|---|
//! | [`Integrator`] | a run with steps of one length, or of a control |
//! | [`Run`] | what every run can do |
//! | [`StepControl`] | what a control is to a run |
//! | [`Reversible`] | steps that follow the motion, and lead back |
//! | [`Density`] | where they are short |
//! | [`ErrorControl`] | steps with an error within a tolerance |
//! | [`Tolerance`] | the error that a step may have |
//! | [`EnergyMomentum`] | steps that conserve a discrete energy |
//! | [`Dense`] | the state at any time of the last step |
//! | [`Events`] | where conditions cross zero |
//! | [`Watch`] | the same for those who take the steps themselves |
//! | [`Event`] | one of these: which condition, when, and the state |
//! | [`Direction`] | which crossings count |
//! | [`Together`](../run/struct.Together.html) | several runs in lanes |
//! | [`Checkpoint`](../run/struct.Checkpoint.html) | a run as data, to go on from |
//! | [`Recorded`](../record/trait.Recorded.html) | `run.record(every, rows)`: a table of a run |
//! | [`Statistics`] | what a run has cost |
//!
//! # Diagnostics, and errors
//!
//! | name | what it is |
//! |---|---|
//! | [`LyapunovExponent`] | how fast neighbours part |
//! | [`TangentMap`] | the derivative of a step, (q, p) to (q, p), or of two points to two points |
//! | [`Work`] | the work of forces along a run |
//! | [`convergence_order`] | the slope of errors over steps |
//! | [`StartError`] | why a run cannot begin |
//! | [`StepError`] | a step that has failed, and where |
//! | [`StepFailure`] | why |

pub use crate::diagnostics::{LyapunovExponent, TangentMap, Work, convergence_order};
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
#[cfg(feature = "alloc")]
pub use crate::run::{Checkpoint, Together};
pub use crate::run::{
    Dense, Density, Direction, EnergyMomentum, ErrorControl, Event, Events, Integrator, Reversible, Run,
    StepControl, Watch,
};
pub use crate::solve::{Solver, Stopping};
pub use crate::state::{Statistics, Summation};
pub use crate::{
    DegenerateLagrangian, Held, HolonomicLagrangian, Lagrangian, ManifoldLagrangian,
    NondegenerateLagrangian, RegularLagrangian, State, System, TimeTransformed, UnilateralLagrangian,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
