//! Holonomic constraints: what the attribute makes of them.

mod declarations;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
