//! The implementation of `Packable`. Of a struct that is generic over the type of its parameters:
//! ```text
//! impl<const __W: usize> Packable<__W> for Kepler<f64>
//! where
//!     f64: Packing<__W, Packed = Varied<Lanes<__W>>>,
//!     usize: Shared<__W>,
//! {
//!     type Packed = Kepler<Varied<Lanes<__W>>>;
//!     fn fits(&self, __other: &Self) -> Option<bool> {
//!         Some(Packing::<__W>::fits(&self.mu, &__other.mu) && Shared::<__W>::same(&self.n, &__other.n))
//!     }
//!     fn packed<__R>(__systems: &[&Self; __W], __f: impl FnOnce(&Self::Packed) -> __R) -> __R {
//!         __f(&Kepler { mu: Packing::pack(__systems.map(|__system| &__system.mu)), n: Shared::<__W>::copy(&__systems[0].n) })
//!     }
//! }
//! ```
//! The bounds are on types with `__W`, so that a struct whose fields have them not has no implementation,
//! and compiles.

use proc_macro2::{TokenStream, TokenTree};
use quote::{ToTokens as _, quote};
use syn::{Field, GenericParam, Ident, ItemStruct, Path, TraitBound, TypeParam, TypeParamBound};

use super::{allow, over};
use crate::syntax::tidy;

pub(super) fn packable(krate: &Path, item: &ItemStruct) -> TokenStream {
    match generic(item) {
        Some(generic) => in_lanes(krate, item, generic),
        None => as_one(krate, item),
    }
}

/// The type of the parameters that may differ from lane to lane, if there is one that may be any number.
fn generic(item: &ItemStruct) -> Option<&TypeParam> {
    let mut others =
        item.generics.params.iter().filter(|generic| !matches!(generic, GenericParam::Const(_)));
    let (Some(GenericParam::Type(generic)), None) = (others.next(), others.next()) else { return None };
    // What a pack has.
    let had = ["Clone", "Copy", "Debug", "PartialEq"];
    let is_one = |bound: &TraitBound| had.iter().any(|had| bound.path.is_ident(had));
    let is_had = |bound: &TypeParamBound| matches!(bound, TypeParamBound::Trait(bound) if is_one(bound));
    // A field that may not be there cannot be listed.
    let is_certain = |field: &Field| !field.attrs.iter().any(|attribute| attribute.path().is_ident("cfg"));
    let is_plain = generic.bounds.iter().all(is_had) && item.generics.where_clause.is_none();
    (is_plain && item.fields.iter().all(is_certain)).then_some(generic)
}

/// Systems that share packs if they are equal.
fn as_one(krate: &Path, item: &ItemStruct) -> TokenStream {
    let (of, allow) = ((&item.ident, &item.generics), allow());
    let mut generics = item.generics.clone();
    generics.params.push(syn::parse_quote!(const __W: ::core::primitive::usize));
    let items = quote! {
        type Packed = Self;
        fn packed<__R>(__systems: &[&Self; __W], __f: impl ::core::ops::FnOnce(&Self) -> __R) -> __R {
            __f(__systems[0])
        }
    };
    let implementation = over(krate, of, &generics, &quote!(__private::Packable<__W>), &items);
    quote!(#[automatically_derived] #allow #implementation)
}

/// Systems whose parameters of type `generic` are packed.
fn in_lanes(krate: &Path, item: &ItemStruct, generic: &TypeParam) -> TokenStream {
    let (name, allow) = (&item.ident, allow());
    let (private, number) = (quote!(#krate::__private), quote!(::core::primitive::f64));
    let pack = quote!(#krate::Varied<#krate::scalar::Lanes<__W>>);
    let constants = item.generics.const_params().map(|constant| {
        let mut constant = constant.clone();
        constant.default = None;
        constant
    });
    let arguments = |of: &TokenStream| {
        let arguments = item.generics.params.iter().map(|parameter| match parameter {
            GenericParam::Const(constant) => constant.ident.to_token_stream(),
            _ => of.clone(),
        });
        quote!(<#(#arguments),*>)
    };
    let [of_numbers, of_packs] = [&number, &pack].map(arguments);
    let (mut bounds, mut fits, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for Field { ident: field, ty, .. } in &item.fields {
        let [(of_numbers, is_packed), (of_packs, _)] =
            [&number, &pack].map(|of| replaced(ty.to_token_stream(), &generic.ident, of));
        if !is_packed {
            bounds.push(quote!(#ty: #private::Shared<__W>));
            fits.push(quote!(#private::Shared::<__W>::same(&self.#field, &__other.#field)));
            values.push(quote!(#field: #private::Shared::<__W>::copy(&__systems[0].#field)));
        } else {
            bounds.push(quote!(#of_numbers: #private::Packing<__W, Packed = #of_packs>));
            fits.push(quote!(#private::Packing::<__W>::fits(&self.#field, &__other.#field)));
            values.push(quote!(#field: #private::Packing::pack(__systems.map(|__system| &__system.#field))));
        }
    }
    quote! {
        #[automatically_derived]
        #allow
        #[allow(deprecated)]
        impl<#(#constants,)* const __W: ::core::primitive::usize> #krate::__private::Packable<__W> for #name #of_numbers
        where #(#bounds),*
        {
            type Packed = #name #of_packs;
            fn fits(&self, __other: &Self) -> ::core::option::Option<::core::primitive::bool> {
                ::core::option::Option::Some(#(#fits)&&*)
            }
            fn packed<__R>(
                __systems: &[&Self; __W], __f: impl ::core::ops::FnOnce(&Self::Packed) -> __R,
            ) -> __R {
                __f(&#name { #(#values),* })
            }
        }
    }
}

/// A type with `by` in place of `generic`, where that is no part of a path and no lifetime; whether it is
/// there.
fn replaced(ty: TokenStream, generic: &Ident, by: &TokenStream) -> (TokenStream, bool) {
    tidy::replaced(ty, |tokens| {
        let (mut is_next_part, mut changes) = (false, false);
        let change = |token: TokenTree| {
            let is_part = is_next_part;
            is_next_part =
                matches!(&token, TokenTree::Punct(punct) if [':', '\''].contains(&punct.as_char()));
            let is_generic = matches!(&token, TokenTree::Ident(name) if name == generic) && !is_part;
            changes |= is_generic;
            if is_generic { by.clone() } else { token.into() }
        };
        (tokens.into_iter().flat_map(change).collect(), changes)
    })
}
