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
        let read =
            quote!(::core::array::from_fn(|_| #krate::__private::read_array(0usize, &mut __at, #flat)));
        return Transfers { write, refill: quote!(self.#field = #read;), read };
    }
    let one = match fixed(emitter, block).as_slice() {
        [] => quote!(#krate::RunTime::read_block),
        _ => quote!(#krate::__private::read_array),
    };
    Transfers {
        write,
        read: quote!(#krate::RunTime::read_rows(#lengths, &mut __at, #flat, #one)),
        refill: quote!(#krate::RunTime::refill_rows(#lengths, &mut __at, #flat, #one, &mut self.#field);),
    }
}
