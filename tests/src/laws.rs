//! What laws are asked of: systems, and what follows from their Lagrangians alone, motions and the equations
//! of steps.

pub mod equations;
pub mod formula;
pub mod fuse;
pub mod subject;
pub mod systems;
