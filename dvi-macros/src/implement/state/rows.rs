//! Arrays with two indices, in a state as rows, and in a flat slice one row after the other.

use proc_macro2::TokenStream;
use quote::quote;
use syn::Ident;
use syn::ext::IdentExt as _;

use super::Transfers;
use super::types::{fixed, on_stack};
use crate::emit::Emitter;

/// How a field goes to and comes from the flat slice.
pub(super) fn transfer(emitter: &Emitter<'_>, block: usize, field: &Ident, flat: &TokenStream) -> Transfers {
    let (krate, text) = (emitter.krate(), field.unraw().to_string());
    let row = emitter.model.number_of_rows(block);
    let lengths = quote!([__len(#block), __len(#row)]);
    let write = quote!(#krate::__private::write_rows(#text, &self.#field[..], #lengths, &mut __at, #flat)?;);
    if on_stack(emitter, block) {
        let entry = quote!(#krate::__private::read(__len(#row), &mut __at, #flat, |[__entry]| __entry));
        let read = quote!(::core::array::from_fn(|_| ::core::array::from_fn(#entry)));
        return Transfers { write, refill: quote!(self.#field = #read;), read };
    }
    let rows = quote!(#krate::__private::rows(#lengths, &mut __at, #flat));
    let one = match fixed(emitter, block).as_slice() {
        [] => quote!(|__row: &[__T]| __row.to_vec()),
        _ => quote!(|__row: &[__T]| ::core::array::from_fn(|__i| __row[__i])),
    };
    Transfers {
        write,
        read: quote!(::core::iter::Iterator::collect(::core::iter::Iterator::map(#rows, #one))),
        refill: quote!(#krate::RunTime::refill_rows(&mut self.#field, #rows, #one);),
    }
}
