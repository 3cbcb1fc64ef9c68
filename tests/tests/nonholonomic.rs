//! Steps on constraints of the velocities.

mod drift;
mod light;
mod moving;
mod steps;

type Outcome = Result<(), Box<dyn core::error::Error>>;
