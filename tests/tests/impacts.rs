//! Runs with impacts.

mod ends;
mod equations;
mod hidden;
mod motion;
mod reference;
mod several;
mod structure;

type Outcome = Result<(), Box<dyn core::error::Error>>;
