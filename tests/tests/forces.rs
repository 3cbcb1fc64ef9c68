//! Forces: momentum maps, tangent maps, power and work, failures.

use dvi_tests::Outcome;

mod declarations;
mod dissipation;
mod equations;
mod rest;
