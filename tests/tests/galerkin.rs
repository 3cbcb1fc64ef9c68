//! Interior displacements: how steps are solved, many nodes, and failures.

mod equations;
mod failures;
mod many_nodes;
mod structure;
mod systems;

use dvi_tests::Outcome;
