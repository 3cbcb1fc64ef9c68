//! Steps on holonomic constraints.

mod equations;
mod light;
mod orders;
mod redundant;
mod starts;
mod structure;

type Outcome = Result<(), Box<dyn core::error::Error>>;
