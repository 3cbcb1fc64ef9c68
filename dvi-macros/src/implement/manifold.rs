//! What is generated for a system with rotations or unit vectors among its coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::state::space_of;
use super::{allow, in_numbers, suited};
use crate::emit::Emitter;
use crate::emit::inlining::ForceInline;
use crate::symbolic::{Count, Index};
use crate::syntax::Factor;

/// The implementations of `ManifoldSystem` and of `ManifoldLagrangian`.
pub(super) fn manifold(emitter: &Emitter<'_>) -> TokenStream {
    let (krate, model, allow) = (emitter.krate(), emitter.model, allow());
    let name = &model.item.ident;
    let (impl_generics, type_generics, where_clause) = model.item.generics.split_for_impl();
    let dimension = |block: usize| {
        Count::from(match model.blocks[block].factor {
            Factor::Line => model.block_size(block),
            Factor::Rotation => Index::literal(3),
            Factor::Sphere => Index::literal(2),
        })
    };
    let dimensions: Vec<Count> = (0..model.blocks.len()).map(dimension).collect();
    let (tangent, value) = space_of(emitter, &dimensions);
    let lagrangian = in_numbers(emitter, &quote!(ManifoldLagrangian), &suited());
    quote! {
        #[automatically_derived]
        #allow
        impl #impl_generics #krate::ManifoldSystem for #name #type_generics #where_clause {
            type Tangent = #tangent;
            #ForceInline
            fn tangent(&self) -> Self::Tangent { #value }
        }
        #lagrangian
    }
}
