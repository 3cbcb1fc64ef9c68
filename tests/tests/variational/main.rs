//! The quadrature family for regular Lagrangians.

mod equations;
mod failures;
mod kepler;
mod oscillator;
mod phase_space;
mod structure;

type Outcome = Result<(), Box<dyn core::error::Error>>;
