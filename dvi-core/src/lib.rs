//! Variational integrators generated at compile time.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
pub mod diagnostics;
mod elimination;
mod error;
mod form;
mod gauss;
mod history;
mod integrator;
mod lagrangian;
mod method;
mod norm;
pub mod prelude;
mod report;
mod runge_kutta;
mod scalar;
mod sigma_family;
mod solver;
mod space;
mod statistics;
mod vector_field;

#[cfg(feature = "macros")]
pub use dvi_macros::degenerate_lagrangian;
pub use error::{IndexError, LengthError, StartError, StepError, StepFailure};
pub use gauss::{Gauss, GaussMemory};
pub use integrator::Integrator;
pub use lagrangian::{DegenerateLagrangian, Lagrangian, State, Weights};
pub use method::{Method, PreservedForm, Scheme, TwoPoint};
pub use report::{CoordinateBlock, Entry, Formula, OperationCount, Report};
pub use runge_kutta::{RungeKutta, RungeKuttaMemory};
pub use scalar::{Comparison, Real, Scalar};
pub use sigma_family::{Sigma, SigmaMemory, Start};
pub use solver::{Solver, Stopping};
#[cfg(feature = "alloc")]
pub use space::RunTime;
pub use space::{Fixed, FixedMatrix, FixedVector, Space};
pub use statistics::Statistics;
pub use vector_field::VectorField;

/// A point, velocity or covector of the space of `S`.
pub type Vector<S, T> = <<S as Lagrangian>::Space as Space>::Vector<T>;
/// A square matrix over the space of `S`.
pub type Matrix<S, T> = <<S as Lagrangian>::Space as Space>::Matrix<T>;
/// A row permutation over the space of `S`.
pub type Permutation<S> = <<S as Lagrangian>::Space as Space>::Permutation;
