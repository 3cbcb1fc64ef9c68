//! What is generated for a system with rotations or unit vectors among its coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::state::space_of;
use super::{in_numbers, of_type, suited};
use crate::emit::{Emitter, ForceInline};
use crate::symbolic::{Count, Index};

/// The implementations of `ManifoldSystem` and of `ManifoldLagrangian`.
pub(super) fn manifold(emitter: &Emitter<'_>) -> TokenStream {
    let model = emitter.model;
    let dimension = |block: usize| match (model.blocks[block].factor.dimension(), model.blocks[block].axis) {
        (None, _) => Some(model.block_size(block)),
        (Some(dimension), None) => Some(Index::literal(dimension as i64)),
        // As many blocks of the nine components of an array as each of its rotations has tangent vectors.
        (Some(dimension), Some(axis)) => (axis.number < dimension).then(|| model.block_size(block)),
    };
    let dimensions: Vec<Count> = (0..model.blocks.len()).filter_map(dimension).map(Count::from).collect();
    let (tangent, value) = space_of(emitter, &dimensions);
    let items = quote! {
        type Tangent = #tangent;
        #ForceInline
        fn tangent(&self) -> Self::Tangent { #value }
    };
    let system = of_type(emitter.krate(), model.named(), &quote!(ManifoldSystem), &items);
    let lagrangian = in_numbers(emitter, &quote!(ManifoldLagrangian<__T>), &suited());
    quote!(#system #lagrangian)
}
