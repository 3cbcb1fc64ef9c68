//! The quadrature family for regular Lagrangians.

use dvi_tests::Outcome;

pub(crate) mod failures;
mod frequencies;
mod kepler;
mod oscillator;
mod tangent_maps;
