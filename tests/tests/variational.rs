//! The quadrature family for regular Lagrangians.

mod barnes;
mod equations;
mod failures;
mod frequencies;
mod kepler;
mod oscillator;
mod phase_space;
mod structure;
mod tangent_maps;

type Outcome = Result<(), Box<dyn core::error::Error>>;
