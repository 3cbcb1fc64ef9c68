//! Interior displacements: how steps are solved, many nodes, the oscillator, and failures.

mod equations;
mod failures;
mod many_nodes;
mod oscillator;
mod structure;
mod systems;

use dvi_tests::Outcome;
