//! Steps on holonomic constraints.

mod failing;
mod light;
mod multipliers;
mod starts;

use dvi_tests::Outcome;
use dvi_tests::zoo::constrained::Pendulum;

const PENDULUM: Pendulum = Pendulum { m: 1.0, g: 1.0, length: 1.0 };
