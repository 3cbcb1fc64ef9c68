//! Generated functions of compiled systems: all functions of the language, limits, and the range of numbers.

mod functions;
mod indices;
mod limits;
mod range;
mod self_check;
