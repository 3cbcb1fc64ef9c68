//! The attribute of functions that are a part of each step that calls them.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

/// Not in builds with debug assertions: there nothing is optimised as a rule, and a copy for each caller is
/// work for the compiler that makes no step faster.
pub(crate) struct ForceInline;

impl ToTokens for ForceInline {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(quote!(#[cfg_attr(not(debug_assertions), inline(always))]));
    }
}
