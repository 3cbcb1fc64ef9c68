//! Every scheme against the equations that define it, from Lagrangians that are written twice: as an
//! attribute, which the scheme integrates, and as plain Rust, of which the equations are made here.
//!
//! What the macro generates is used by the scheme alone, so that a mistake of either shows. The systems
//! depend on time in α, H and L, have masses that depend on q, magnetic terms, and L that is no
//! polynomial in v; steps go forwards and backwards and begin at t ≠ 0.

mod collocation;
mod degenerate;
mod displaced;
mod equations;
mod newmark;
mod regular;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// Steps of either sign.
const STEPS: [f64; 2] = [0.06, -0.06];

/// Where runs begin.
const START: f64 = -0.7;
