//! Variational integrators from Lagrangians, generated at compile time.
//!
//! A degenerate Lagrangian is affine in the velocities, L(q, v, t) = α(q, t)·v − H(q, t). Its
//! Euler–Lagrange equations are of first order, Ω q' = ∇H with Ω = (Dα)ᵀ − Dα. Declare α and H on the
//! struct of the parameters, choose a [method](Method), and iterate:
//!
//! ```
//! use dvi_core::prelude::*;
//!
//! /// Predators y and prey x.
//! #[degenerate_lagrangian(
//!     coordinates(x, y),
//!     one_form    = y.ln() / x * d(x),
//!     hamiltonian = x + y - x.ln() - rate * y.ln(),
//! )]
//! pub struct LotkaVolterra { rate: f64 }
//!
//! let system = LotkaVolterra { rate: 2.0 };
//! let start: LotkaVolterraState = LotkaVolterraState { x: 1.0, y: 1.0 };
//! let mut run = Integrator::new(&system, Gauss::<2>::new(), 0.01, start)?;
//! for state in run.by_ref().take(1000) {
//!     let state = state?;
//!     assert!(state.x > 0.0 && state.y > 0.0);
//! }
//! assert!((run.energy() - 2.0).abs() < 1e-8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A regular Lagrangian L(q, v, t) is declared in the same language by [`lagrangian`](macro@lagrangian), and
//! its states carry velocities:
//!
//! ```
//! use dvi_core::prelude::*;
//!
//! /// A plane pendulum.
//! #[lagrangian(coordinates(a), lagrangian = dot(a).powi(2) / 2.0 + g * a.cos())]
//! pub struct Pendulum { g: f64 }
//!
//! let system = Pendulum { g: 9.81 };
//! let start: PendulumState = PendulumState { a: 1.0, dot_a: 0.0 };
//! let mut run = Integrator::new(&system, Variational::trapezoid(), 0.01, start)?;
//! let energy = run.energy();
//! run.take_steps(1_000_000)?;
//! assert!((run.energy() - energy).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to find | look at |
//! |---|---|
//! | what the attributes understand | [`degenerate_lagrangian`], [`lagrangian`](macro@lagrangian) |
//! | the run: stepping, state, energy, momenta, errors | [`Integrator`], [`Run`] |
//! | steps of variable length | [`ControlledIntegrator`], [`Reversible`] |
//! | the σ-family of Rowley & Marsden and its limits | [`Sigma`] |
//! | baselines on q' = X(q) | [`RungeKutta`], [`Gauss`] |
//! | regular systems: Störmer–Verlet, quadrature rules, phase fitting | [`Variational`], [`Frequency`] |
//! | order 4, 6 and 8 for regular systems; Newmark's method | [`Galerkin`], [`Composition`], [`Newmark`] |
//! | sections, exponents, preserved forms, orders | [`diagnostics`] |
//! | what the macros implement, to be implemented by hand if need be | [`Lagrangian`], [`DegenerateLagrangian`], [`RegularLagrangian`] |
//!
//! # Features
//! - `macros` (default): the attributes.
//! - `std` (default): elementary functions from the platform; implies `alloc`.
//! - `alloc`: systems whose size is known at run time only.
//! - `libm`: elementary functions without `std`.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
mod basis;
#[cfg(feature = "alloc")]
mod checkpoint;
mod composition;
pub mod diagnostics;
mod discrete;
mod elimination;
mod energy_limit;
mod error;
mod error_function;
mod form;
mod frequency;
mod galerkin;
mod gauss;
mod history;
mod inertia;
mod integrator;
mod lagrangian;
mod legendre;
mod mass;
mod memory;
mod method;
mod newmark;
mod norm;
mod number;
mod orientation;
mod phase;
pub mod prelude;
mod quadrature;
mod report;
mod run;
mod runge_kutta;
mod scalar;
mod sigma_family;
pub mod sink;
mod solve;
mod space;
mod square;
mod statistics;
mod step_control;
mod summation;
mod symmetrised;
mod variational;
mod vector_field;
mod walk;

#[cfg(feature = "alloc")]
pub use checkpoint::Checkpoint;
pub use composition::{Composition, CompositionMemory};
pub use discrete::{
    DiscreteLagrangian, Ends, General, GeneralMemory, Interval, OneNode, TwiceDifferentiable,
    VariationalMethod,
};
#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
pub use energy_limit::{EnergyLimit, EnergyLimitMemory};
pub use error::{CheckpointError, IndexError, LengthError, StartError, StepError, StepFailure};
pub use frequency::{
    Constant, Curvature, Frequency, FrequencyIn, GivenFrequency, PerCoordinate, Radial, Reading, Unfitted,
};
pub use galerkin::{Galerkin, GalerkinMemory};
pub use gauss::{Gauss, GaussMemory};
pub use integrator::Integrator;
pub use lagrangian::{
    AffineOneForm, DegenerateLagrangian, Lagrangian, QuadraticInVelocity, RegularLagrangian, Separable,
    State, Weights,
};
pub use memory::Memory;
#[cfg(feature = "alloc")]
pub use memory::{Reader, Record};
pub use method::{Carries, Clock, Method, PreservedForm, Scheme, TwoPoint, VariableStep};
pub use newmark::{Newmark, NewmarkMemory};
pub use number::Number;
pub use quadrature::{Midpoint, Quadrature, Rule, Simpson, Trapezoid};
pub use report::{CoordinateBlock, Entry, Formula, OperationCount, Report};
pub use run::{Run, Stepper};
pub use runge_kutta::{RungeKutta, RungeKuttaMemory};
pub use scalar::{Comparison, Real, Scalar};
pub use sigma_family::{ParasiticMode, Sigma, SigmaMemory, Start};
pub use sink::Sink;
pub use solve::{Solver, Stopping};
pub use space::{Fixed, FixedMatrix, FixedVector, Space};
#[cfg(feature = "alloc")]
pub use space::{RunTime, RunTimeMatrix};
#[cfg(feature = "alloc")]
pub use square::RunTimeSquare;
pub use square::{FixedSquare, SquareMatrix};
pub use statistics::Statistics;
pub use step_control::{
    CentreSpeed, ControlledIntegrator, ControlledRun, Density, Osculating, OsculatingMemory, Power,
    Reversible, ReversibleMemory, StepControl,
};
pub use summation::Summation;
pub use symmetrised::{Symmetrised, SymmetrisedLagrangian};
pub use variational::{Fitting, QuadratureLagrangian, Variational, VariationalMemory};
pub use vector_field::VectorField;

/// A point, velocity or covector of the space of `S`.
pub type Vector<S, T> = <<S as Lagrangian>::Space as Space>::Vector<T>;
/// A square matrix over the space of `S`.
pub type Matrix<S, T> = <<S as Lagrangian>::Space as Space>::Matrix<T>;
/// A square matrix over the space of `S` that is solved with.
pub type Square<S, T> = <<S as Lagrangian>::Space as Space>::Square<T>;
/// A row permutation over the space of `S`.
pub type Permutation<S> = <<S as Lagrangian>::Space as Space>::Permutation;
