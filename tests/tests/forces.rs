//! Forces: orders, discrete equations, momentum maps, tangent maps, power and work, failures.

mod declarations;
mod equations;
mod orders;
mod systems;

type Outcome = Result<(), Box<dyn core::error::Error>>;
