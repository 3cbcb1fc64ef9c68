//! Constraints: what the attribute makes of them.

mod declarations;
mod nonholonomic;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
