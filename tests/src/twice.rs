//! Systems that are written twice, as an attribute and as plain Rust, and what is made of the latter:
//! motions, and the equations of steps.

mod by_hand;
pub mod equations;
pub mod formula;
pub mod fuse;
pub mod systems;
