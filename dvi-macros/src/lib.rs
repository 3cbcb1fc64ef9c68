//! The attribute macros of `dvi-core`: a small compiler from Lagrangians to integrators.
//!
//! A formula goes one way: `syntax` reads the attribute, `model` resolves its names, `lower` turns
//! expressions into a graph, `symbolic` simplifies and differentiates, `structure` sees what a system
//! allows, `program` says what each generated function computes, `select` and `schedule` choose shared
//! products and loops, which make a `routine`, `validate` holds every routine against the formulas as
//! written, and `emit` and `implement` write Rust. `expand` tells that story on one screen for each
//! attribute. Mistakes of the user are found by the stages up to `structure`; a mistake of the compiler is
//! found by `validate`, or ends the expansion as an `internal` error.

mod emit;
mod errors;
mod expand;
mod formulas;
#[cfg(test)]
mod fuzz_tests;
mod implement;
mod instructions;
mod internal;
mod lower;
mod model;
mod operations;
#[cfg(test)]
mod oracle_tests;
mod print;
mod program;
mod routine;
mod schedule;
mod select;
mod statement;
mod structure;
mod symbolic;
mod syntax;
#[cfg(test)]
mod tests;
mod typeset;
mod validate;
mod words;
mod work;

use proc_macro::TokenStream;

#[doc = include_str!("../docs/degenerate_lagrangian.md")]
#[proc_macro_attribute]
pub fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::degenerate_lagrangian(attribute.into(), item.into()).into()
}

#[doc = include_str!("../docs/lagrangian.md")]
#[proc_macro_attribute]
pub fn lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::lagrangian(attribute.into(), item.into()).into()
}
