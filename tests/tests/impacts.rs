//! Runs with impacts.

use dvi_tests::Outcome;

mod ends;
mod equations;
mod hidden;
mod motion;
mod pairs;
mod reference;
mod several;
mod structure;
