//! Steps on holonomic constraints.

mod equations;
mod light;
mod orders;
mod redundant;
mod starts;

use dvi_tests::Outcome;
