//! Steps on holonomic constraints.

mod branches;
mod equations;
mod light;
mod orders;
mod redundant;
mod starts;
mod structure;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
