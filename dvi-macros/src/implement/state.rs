//! The state with named coordinates, and the space that it lives in.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{GenericParam, Ident};

use crate::emit::{Emitter, local};
use crate::symbolic::{Atom, Index};

pub(crate) struct State {
    /// The struct and its implementations.
    pub(crate) item: TokenStream,
    /// The state as a type over `__T`, with the generics of the system in scope.
    pub(crate) type_in_trait: TokenStream,
    pub(crate) space: TokenStream,
    /// The space as a value in a method of the system.
    pub(crate) space_value: TokenStream,
}

/// Fixed if all blocks have one size, or all sizes are literals; else known at run time.
fn space(emitter: &Emitter<'_>) -> (TokenStream, TokenStream) {
    let (model, krate) = (emitter.model, emitter.krate());
    let sizes: Vec<Index> = (0..model.blocks.len()).map(|block| model.block_size(block)).collect();
    let fixed = |blocks: usize, size: &Index| {
        let size = emitter.index(size);
        (quote!(#krate::Fixed<#blocks, { #size }>), quote!(#krate::Fixed))
    };
    let constant = (0..model.blocks.len()).all(|block| model.is_constant(block));
    match (model.dimension().as_literal(), sizes.first()) {
        (Some(_), _) => fixed(1, &model.dimension()),
        (None, Some(first)) if constant && sizes.iter().all(|size| size == first) && is_name(first) => {
            fixed(sizes.len(), first)
        }
        _ => {
            let dimension = emitter.index(&model.dimension());
            (quote!(#krate::RunTime), quote!(#krate::RunTime { dimension: #dimension }))
        }
    }
}

/// Stable Rust takes a const parameter as it is as an argument, but no expression of it.
fn is_name(size: &Index) -> bool {
    size.constant == 0 && matches!(size.terms.as_slice(), [(Atom::Size(_), 1)])
}

pub(crate) fn state(emitter: &Emitter<'_>) -> State {
    let (model, krate) = (emitter.model, emitter.krate());
    let name = format_ident!("{}State", model.item.ident);
    let visibility = &model.item.vis;
    let constants = constants(emitter);
    let declarations = constants.iter().map(|name| quote!(const #name: usize));
    let declarations: Vec<TokenStream> = declarations.collect();
    let (space, space_value) = space(emitter);
    let fields: Vec<&Ident> = model.blocks.iter().map(|block| &block.name).collect();
    let types: Vec<TokenStream> = (0..fields.len()).map(|block| field_type(emitter, block)).collect();
    let docs = model.blocks.iter().map(|block| match &block.array {
        Some((_, size)) => format!("Coordinates `{}[0]` to `{}[{size} - 1]`.", block.name, block.name),
        None => format!("Coordinate `{}`.", block.name),
    });
    let summary = format!("A state of [`{}`]: its coordinates by name.", model.item.ident);
    let copy = (0..fields.len()).all(|block| on_stack(emitter, block)).then(|| quote!(::core::marker::Copy,));
    let (write, read) = transfers(emitter, &fields);
    let blocks = (0..fields.len()).map(block_name);
    let allow = super::allow();
    let conversions = conversions(&name, &declarations, &constants, &fields, &types);
    let item = quote! {
        #[doc = #summary]
        #[allow(non_snake_case, non_upper_case_globals)]
        #[derive(#copy ::core::clone::Clone, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        #visibility struct #name<#(#declarations,)* __T = f64> {
            #(#[doc = #docs] pub #fields: #types,)*
        }
        #[automatically_derived]
        #allow
        impl<#(#declarations,)* __T: #krate::Scalar> #krate::State<__T> for #name<#(#constants,)* __T> {
            fn write(
                &self,
                __len: impl ::core::ops::Fn(usize) -> usize,
                __flat: &mut [__T],
            ) -> ::core::result::Result<(), #krate::LengthError> {
                let mut __at = 0usize;
                #write
                ::core::result::Result::Ok(())
            }
            fn read(__len: impl ::core::ops::Fn(usize) -> usize, __flat: &[__T]) -> Self {
                let mut __at = 0usize;
                #read
                Self { #(#fields: #blocks),* }
            }
        }
        #conversions
    };
    State { item, type_in_trait: quote!(#name<#(#constants,)* __T>), space, space_value }
}

/// From and into the tuple of the blocks, or the block itself if there is one only.
fn conversions(
    name: &Ident,
    declarations: &[TokenStream],
    constants: &[Ident],
    fields: &[&Ident],
    types: &[TokenStream],
) -> TokenStream {
    if fields.is_empty() {
        return TokenStream::new();
    }
    let blocks: Vec<Ident> = (0..fields.len()).map(block_name).collect();
    quote! {
        #[automatically_derived]
        #[allow(non_upper_case_globals)]
        impl<#(#declarations,)* __T> ::core::convert::From<(#(#types,)*)> for #name<#(#constants,)* __T> {
            fn from((#(#blocks,)*): (#(#types,)*)) -> Self {
                Self { #(#fields: #blocks),* }
            }
        }
        #[automatically_derived]
        #[allow(non_upper_case_globals)]
        impl<#(#declarations,)* __T> ::core::convert::From<#name<#(#constants,)* __T>> for (#(#types,)*) {
            fn from(__state: #name<#(#constants,)* __T>) -> Self {
                (#(__state.#fields,)*)
            }
        }
    }
}

/// The const generics of the struct that sizes of arrays name.
fn constants(emitter: &Emitter<'_>) -> Vec<Ident> {
    let model = emitter.model;
    let used = |name: &Ident| {
        (0..model.blocks.len()).filter(|block| on_stack(emitter, *block)).any(|block| {
            model.block_size(block).terms.iter().any(|(atom, _)| match atom {
                Atom::Size(size) => *name == model.sizes[size.0 as usize].text,
                _ => false,
            })
        })
    };
    let names = model.item.generics.params.iter().filter_map(|parameter| match parameter {
        GenericParam::Const(constant) => Some(constant.ident.clone()),
        _ => None,
    });
    names.filter(used).collect()
}

fn on_stack(emitter: &Emitter<'_>, block: usize) -> bool {
    let size = emitter.model.block_size(block);
    size.as_literal().is_some() || (emitter.model.is_constant(block) && is_name(&size))
}

fn field_type(emitter: &Emitter<'_>, block: usize) -> TokenStream {
    let krate = emitter.krate();
    match &emitter.model.blocks[block].array {
        None => quote!(__T),
        Some((size, _)) if on_stack(emitter, block) => {
            let size = emitter.index(size);
            quote!([__T; #size])
        }
        Some(_) => quote!(#krate::__private::Vec<__T>),
    }
}

/// A local name: that of the coordinate may be the name of a constant, which is no place to bind to.
fn block_name(block: usize) -> Ident {
    local(format_args!("block{block}"))
}

fn transfers(emitter: &Emitter<'_>, fields: &[&Ident]) -> (TokenStream, TokenStream) {
    let krate = emitter.krate();
    let (mut write, mut read) = (TokenStream::new(), TokenStream::new());
    for (block, field) in fields.iter().enumerate() {
        let name = block_name(block);
        let text = field.to_string();
        if emitter.model.blocks[block].array.is_none() {
            write.extend(quote!(__flat[__at] = self.#field; __at += 1usize;));
            read.extend(quote!(let #name = __flat[__at]; __at += 1usize;));
            continue;
        }
        write.extend(quote! {
            #krate::__private::write_block(#text, &self.#field[..], __len(#block), &mut __at, __flat)?;
        });
        let reader = if on_stack(emitter, block) { quote!(read_array) } else { quote!(read_vec) };
        read.extend(quote!(let #name = #krate::__private::#reader(__len(#block), &mut __at, __flat);));
    }
    (write, read)
}
