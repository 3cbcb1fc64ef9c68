//! An interpreter of the Rust that is printed for a system, over `f64`.
//!
//! It knows the subset in which generated functions are written and nothing more: what it does not know
//! ends the test with the text of the construct, because what is not run is not compared.

mod arithmetic;
mod code;
mod functions;
mod library;
mod literals;
mod parse;
mod run;
mod value;

pub(super) use parse::Expansion;
pub(super) use run::{Environment, Machine};
pub(super) use value::{Kind, Nested, Value};
