//! Steps on holonomic constraints.

mod branches;
mod equations;
mod orders;
mod starts;
mod structure;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
