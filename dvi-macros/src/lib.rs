//! The attribute macros of `dvi-core`: a small compiler from Lagrangians to integrators.
//!
//! A formula goes one way: [`syntax`] reads the attribute, [`model`] resolves its names, [`lower`] turns
//! expressions into a graph (the last stage that can fail), [`symbolic`] simplifies and differentiates,
//! [`program`] says what each generated function computes, [`instructions`] and [`schedule`] choose
//! shared products and loops, [`emit`] and [`implement`] write Rust. [`expand`] tells that story on one
//! screen.

mod emit;
mod errors;
mod expand;
mod implement;
mod instructions;
mod lower;
mod model;
mod program;
mod schedule;
mod structure;
mod symbolic;
mod syntax;

use proc_macro::TokenStream;

/// Declares a degenerate system, L(q, v, t) = α(q, t)·v − H(q, t), on the struct of its parameters.
#[proc_macro_attribute]
pub fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::degenerate_lagrangian(attribute.into(), item.into()).into()
}
