//! Steps on constraints of the velocities.

use dvi_tests::Outcome;

mod light;
mod steps;
