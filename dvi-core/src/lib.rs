//! Variational integrators from Lagrangians, generated at compile time.
//!
//! A degenerate Lagrangian is affine in the velocities, L(q, v, t) = α(q, t)·v − H(q, t). Its
//! Euler–Lagrange equations are of first order, Ω q' = ∇H with Ω = (Dα)ᵀ − Dα. Declare α and H on the
//! struct of the parameters, choose a [method](methods), and iterate:
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
//! | room | what is in it |
//! |---|---|
//! | [`system`] | what the attributes implement: [`Lagrangian`], [`DegenerateLagrangian`], [`RegularLagrangian`], [`Report`] |
//! | [`methods`] | the σ-family, quadrature rules with phase fitting, Galerkin, Newmark, compositions, baselines |
//! | [`run`] | stepping with a fixed or a controlled step: state, energy, momenta, errors, checkpoints |
//! | [`diagnostics`] | sections, exponents, tangent maps, preserved forms, orders |
//! | [`discrete`] | the discrete Lagrangian, quadrature rules, frequencies |
//! | [`solve`] | how implicit steps are solved, and when they count as solved |
//! | [`mechanics`] | the vector field of a degenerate system |
//! | [`state`] | what a run carries from step to step, compensated sums, what a run has cost |
//! | [`space`], [`scalar`] | storage for points and matrices; sinks; numbers |
//! | [`error`] | failures as values |
//!
//! What the attributes understand is in their own documentation, [`degenerate_lagrangian`] and
//! [`lagrangian`](macro@lagrangian); what a first program needs is in the [`prelude`].
//!
//! # Features
//! - `macros` (default): the attributes.
//! - `std` (default): elementary functions from the platform; implies `alloc`.
//! - `alloc`: systems whose size is known at run time only.
//! - `libm`: elementary functions without `std`.
//! - `serde`: checkpoints can be written to files; implies `alloc`.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
pub mod diagnostics;
pub mod discrete;
pub mod error;
pub mod mechanics;
pub mod methods;
pub mod prelude;
pub mod run;
pub mod scalar;
pub mod solve;
pub mod space;
pub mod state;
pub mod system;

#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
pub use error::{IndexError, LengthError};
pub use scalar::{Comparison, Number, Parameter, Real, Scalar, Varied};
pub use space::{Fixed, FixedMatrix, FixedVector, Sink, Space};
#[cfg(feature = "alloc")]
pub use space::{RunTime, RunTimeMatrix};
pub use system::{
    AffineOneForm, CoordinateBlock, Coupled, DegenerateLagrangian, Entry, Formula, Lagrangian, Linear,
    Matrix, OperationCount, Permutation, QuadraticInVelocity, RegularLagrangian, Report, Separable, Square,
    State, System, Vector, Weights,
};
