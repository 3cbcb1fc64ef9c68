//! The types of the fields of a state.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Emitter;
use crate::model::{Axis, Block};
use crate::symbolic::{Atom, Index};
use crate::syntax::Factor;

/// Stable Rust takes a const parameter as it is as an argument, but no expression of it.
pub(super) fn is_name(size: &Index) -> bool {
    size.constant == 0 && matches!(size.terms.as_slice(), [(Atom::Size(_), 1)])
}

/// Whether a field is made of arrays alone.
pub(in super::super) fn on_stack(emitter: &Emitter<'_>, block: usize) -> bool {
    fixed(emitter, block).len() == emitter.model.blocks[block].sizes().len()
}

/// The sizes of a block that are lengths of arrays in its type, from the inside: an array has entries of
/// which the size is known.
pub(super) fn fixed(emitter: &Emitter<'_>, block: usize) -> Vec<Index> {
    let is_known =
        |size: &Index| size.as_literal().is_some() || (emitter.model.is_constant(size) && is_name(size));
    emitter.model.blocks[block].sizes().into_iter().rev().take_while(is_known).collect()
}

pub(super) fn field_type(emitter: &Emitter<'_>, block: usize, is_velocity: bool) -> TokenStream {
    let krate = emitter.krate();
    let declared = &emitter.model.blocks[block];
    let Block { axis, factor, array, .. } = declared;
    let is_angular = is_velocity && *factor == Factor::Rotation;
    let entry = match axis {
        Some(_) if is_angular || declared.is_spinor() => quote!([__T; 3usize]),
        Some(Axis { of, .. }) => quote!([__T; #of]),
        None => quote!(__T),
    };
    if array.is_some() && is_angular && axis.is_none() {
        return quote!([__T; 3usize]);
    }
    let (fixed, sizes) = (fixed(emitter, block), declared.sizes().len());
    let arrays = fixed.iter().fold(entry, |entry, size| {
        let size = emitter.index(size);
        quote!([#entry; #size])
    });
    (fixed.len()..sizes).fold(arrays, |entry, _| quote!(#krate::space::Vec<#entry>))
}
