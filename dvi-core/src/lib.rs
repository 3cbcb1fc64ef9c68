//! Variational integrators from Lagrangians, generated at compile time.
//!
//! You declare the Lagrangian of a mechanical system in an attribute on a struct, choose a
//! [method](methods), and get a run: an iterator over results, each of them a state or the error that ended
//! the run. The attribute differentiates the formula symbolically and generates the equations of a step with
//! their exact Jacobian.
//!
//! ```
//! use dvi_core::prelude::*;
//!
//! /// A pendulum; its coordinate is the angle from the vertical, in radians.
//! #[lagrangian(
//!     coordinates(angle),
//!     lagrangian = dot(angle).powi(2) / 2.0 + g / length * angle.cos(),
//! )]
//! struct Pendulum {
//!     g: f64,
//!     length: f64,
//! }
//!
//! let pendulum = Pendulum { g: 9.81, length: 1.0 };
//! let start = PendulumState { angle: 1.0, dot_angle: 0.0 };
//! let mut run = Integrator::new(&pendulum, Variational::trapezoid(), 0.01, start)?;
//! let energy = run.energy();
//! for state in run.by_ref().take(1000) {
//!     let state = state?;
//!     assert!(state.angle.abs() < 1.001);
//! }
//! run.take_steps(1_000_000)?;
//! assert!((run.energy() - energy).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What a variational integrator is
//!
//! The motion of a system with the Lagrangian $`L(q, \dot q, t)`$ makes the action stationary. A variational
//! integrator replaces the action of each time step by a function of its two ends, the *discrete
//! Lagrangian*, and makes the sum over all steps stationary. That gives the *discrete Euler–Lagrange
//! equation*, which determines each point from the two before:
//!
//! ```math
//! \delta \int L\, \mathrm{d}t = 0
//! \qquad\longrightarrow\qquad
//! D_2 L_d(q_{k-1}, q_k) + D_1 L_d(q_k, q_{k+1}) = 0
//! ```
//!
//! The steps of such a method preserve a symplectic form, and they conserve the momenta of the symmetries
//! that $`L_d`$ has. As a rule their energy error does not add up from step to step, as that of a
//! Runge–Kutta method does. This holds as long as the motion is regular and the steps are short against its
//! periods.
//!
//! # Where to go on
//!
//! | page | what it answers |
//! |---|---|
//! | [Your first system](guide::first_system) | How do I declare a system, run it, and write a table? |
//! | [Recipes](guide::recipes) | States at given times, events, sections, sweeps, fits, checkpoints: how do I …? |
//! | [Choosing a method](guide::choosing_a_method) | Which method do I begin with, and when do I take another? |
//! | [Reading the report](guide::reading_the_report) | What did the compiler see, and what follows from it? |
//! | [What can go wrong](guide::what_can_go_wrong) | What do the errors mean, and what does no error show? |
//! | [`lagrangian`](macro@lagrangian), [`degenerate_lagrangian`] | What can formulas say? |
//!
//! # What one looks for
//!
//! | question | answer |
//! |---|---|
//! | What is it not for? | Partial differential equations, stiff dissipative systems; energies stay in a band, not within a tolerance, and phases drift: [what can go wrong](guide::what_can_go_wrong) |
//! | What is its status? | Before 1.0 names may change, and `CHANGELOG.md` says which; a number in these pages is one that is tested or measured |
//! | How do I cite it? | As `CITATION.cff` says, with the version or the commit that you used |
//!
//! # The two kinds of Lagrangian
//!
//! - A **regular** Lagrangian has second-order equations of motion. Its states hold coordinates and
//!   velocities. It is declared by [`lagrangian`](macro@lagrangian).
//! - A **degenerate** Lagrangian is affine in the velocities, $`L = \alpha(q) \cdot \dot q - H(q)`$, as that
//!   of vortices, of guiding centres, of predators and prey. Its equations of motion are of first order,
//!   $`\Omega \dot q = \nabla H`$ with $`\Omega = (D\alpha)^\mathsf{T} - D\alpha`$. Its states hold
//!   coordinates only. It is declared by [`degenerate_lagrangian`].
//!
//! # Features
//! - `macros` (default): the attributes.
//! - `std` (default): elementary functions from the platform; implies `alloc`.
//! - `alloc`: systems whose size is known at run time only.
//! - `libm`: elementary functions without `std`.
//! - `serde`: checkpoints can be written to files; implies `alloc`.
//! - `records` (default): tables and pages of runs, in the module `record`; implies `std`.
//! - `ensembles`: many runs over all cores, in the module `ensemble`, and long ones in files, in the module
//!   `archive`; implies `threads`, `random`, `records` and `serde`.
//! - `fast-sums`: sums over all pairs of many bodies by the fast multipole method, in the module `fast_sum`;
//!   implies `std`.
//! - `threads`: what is computed for many bodies is shared by threads: the generated sums over all pairs of
//!   512 bodies and more, and those of `fast-sums`. Results are bitwise the same for every number of
//!   threads. The threads are those of the pool of `rayon` that a run is taken in. From outside of a pool
//!   they have to be woken for each sum, which pays for some 800 bodies and more. Implies `std`.
//! - `mpi`: ensembles over the processes of an MPI program; needs MPI on the system, and libclang to build.
//!   Implies `ensembles`.
//! - `random` (default): methods with noise.
//! - `simd` (default): what is computed in [lanes](scalar::Lanes) uses the widest instructions that the
//!   processor has, chosen when the program runs. Without it, and in builds with debug assertions, those
//!   that the program is compiled for.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "records", feature = "fast-sums"))]
extern crate std;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
#[cfg(feature = "ensembles")]
pub mod archive;
pub mod diagnostics;
pub mod discrete;
#[cfg(feature = "ensembles")]
pub mod ensemble;
pub mod error;
#[cfg(feature = "fast-sums")]
pub mod fast_sum;
pub mod field;
pub mod guide;
pub mod mechanics;
mod memory;
pub mod methods;
mod name;
pub mod prelude;
#[cfg(feature = "records")]
pub mod record;
pub mod rotations;
pub mod run;
pub mod scalar;
mod shown;
pub mod solve;
pub mod space;
pub mod state;
pub mod system;
mod threads;

#[cfg(feature = "macros")]
pub use dvi_macros::{degenerate_lagrangian, lagrangian};
pub use error::{IndexError, LengthError, OutsideError};
pub use field::ScalarField;
pub use scalar::{Parameter, Real, Scalar, Varied};
#[cfg(feature = "alloc")]
pub use space::RunTime;
pub use space::{Fixed, Sink, Space};
pub use system::{
    ConstrainedSystem, DegenerateLagrangian, Held, HolonomicLagrangian, Lagrangian, ManifoldLagrangian,
    ManifoldSystem, NondegenerateLagrangian, NonholonomicLagrangian, PairSum, ProperlyDegenerate,
    RegularLagrangian, Report, Separable, State, System, TimeTransformed, UnilateralLagrangian, Vector,
    Weights,
};
pub(crate) use system::{Coupled, Linear, Matrix, Square};
