//! Interior displacements: orders, the equations that a step solves, and what it preserves.

mod equations;
mod failures;
mod many_nodes;
mod oscillator;
mod structure;
mod systems;
