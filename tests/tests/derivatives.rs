//! Generated functions of compiled systems against an independent oracle: all functions of the language.
//! Formulas of every form are held against the oracle of `dvi-macros`, and compiled systems in laws.

mod functions;
mod indices;
mod limits;
pub(crate) mod oracle;
mod range;
mod self_check;

use dvi_tests::zoo::functions::{EveryFunction, OwnFunction};

#[test]
fn every_function() {
    oracle::agrees(&EveryFunction {});
}

#[test]
fn functions_of_the_user() {
    oracle::agrees(&OwnFunction {});
}
