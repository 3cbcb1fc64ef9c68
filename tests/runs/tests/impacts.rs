//! Runs with impacts.

mod ends;
mod hidden;
mod motion;
mod reference;
mod several;
mod structure;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
