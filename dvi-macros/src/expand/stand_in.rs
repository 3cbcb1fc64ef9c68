//! What is emitted in place of a system with mistakes in it.
//!
//! The struct as written, and implementations that type-check, so that the mistakes in the attribute
//! are the only ones that the compiler reports.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{GenericParam, Generics, Path, Visibility};

use crate::emit::Emitter;
use crate::errors::Errors;
use crate::implement::{self, Names, State};
use crate::syntax::{Constrained, Kind};

/// A type that takes the place of a system.
struct StandIn<'a> {
    kind: Kind,
    name: &'a Ident,
    generics: &'a Generics,
    krate: &'a Path,
    space: TokenStream,
    state: TokenStream,
    time_transformed: bool,
    constrained: Option<Constrained>,
    is_on_manifold: bool,
}

/// With errors in the attribute.
pub(super) fn stand_in(
    emitter: &Emitter<'_>,
    constrained: Option<Constrained>,
    mut errors: Errors,
) -> TokenStream {
    let (model, krate) = (emitter.model, emitter.krate());
    let item = &model.item;
    let (space, state, state_item) = if model.lost_coordinates {
        lost_state(krate, &item.vis, &item.ident, &item.generics, &mut errors)
    } else {
        let State { space, type_in_trait, item, .. } = implement::state(emitter);
        (space, type_in_trait, item)
    };
    let (name, generics, time_transformed) = (&item.ident, &item.generics, model.extended.is_some());
    let (kind, is_on_manifold) = (model.kind, model.is_on_manifold());
    let stand_in =
        StandIn { kind, name, generics, krate, space, state, time_transformed, constrained, is_on_manifold };
    let implementations = stand_in.implementations();
    let errors = errors.into_tokens();
    quote!(#errors #item #state_item #implementations)
}

/// With the attribute on a type that is no struct.
pub(super) fn without_struct(
    kind: Kind,
    visibility: &Visibility,
    name: &Ident,
    generics: &Generics,
    mut errors: Errors,
) -> TokenStream {
    let krate: Path = syn::parse_quote!(::dvi_core);
    let (space, state, state_item) = lost_state(&krate, visibility, name, generics, &mut errors);
    let (time_transformed, constrained, is_on_manifold) = (false, None, false);
    let krate = &krate;
    let stand_in =
        StandIn { kind, name, generics, krate, space, state, time_transformed, constrained, is_on_manifold };
    let implementations = stand_in.implementations();
    let errors = errors.into_tokens();
    quote!(#errors #state_item #implementations)
}

impl StandIn<'_> {
    fn implementations(&self) -> TokenStream {
        let Self { name, krate, space, state, .. } = self;
        let (impl_generics, type_generics, where_clause) = self.generics.split_for_impl();
        let (allow, suited) = (implement::allow(), implement::suited());
        let never = quote!({ ::core::unreachable!() });
        let held = implement::held(krate, name, self.generics);
        let kind = implement::kind(krate, self.kind, self.constrained, self.is_on_manifold);
        let time_transformed = self.time_transformed.then(|| self.time_transformed(&never));
        let constrained = (self.kind == Kind::Regular && self.constrained.is_some())
            .then(|| self.with_constraints(&never));
        let manifold = (self.kind == Kind::Regular && self.is_on_manifold).then(|| self.on_manifold(&never));
        quote! {
            const _: () = {
                #held
                #[automatically_derived]
                #allow
                impl #impl_generics #krate::System for #name #type_generics #where_clause {
                    type Space = #space;
                    type State<__T: #krate::Scalar> = #state;
                    const REPORT: #krate::Report = #krate::Report::new("", &[], &[], &[], &[], &[], &[], &[], &[]);
                    type Kind = #kind;
                    fn space(&self) -> Self::Space #never
                    fn block_len(&self, _: ::core::primitive::usize) -> ::core::primitive::usize #never
                    fn check(&self) -> ::core::result::Result<(), #krate::IndexError> #never
                }
                impl #impl_generics #krate::__private::StandIn for #name #type_generics #where_clause { #suited }
                #time_transformed
                #constrained
                #manifold
            };
        }
    }

    /// The trait that systems have with rotations and unit vectors only.
    fn on_manifold(&self, never: &TokenStream) -> TokenStream {
        let Self { name, krate, .. } = self;
        let (impl_generics, type_generics, where_clause) = self.generics.split_for_impl();
        quote! {
            impl #impl_generics #krate::ManifoldSystem for #name #type_generics #where_clause {
                type Tangent = #krate::Fixed<1usize, 1usize>;
                fn tangent(&self) -> Self::Tangent #never
            }
        }
    }

    /// The trait that systems have with constraints only.
    fn with_constraints(&self, never: &TokenStream) -> TokenStream {
        let Self { name, krate, .. } = self;
        let (impl_generics, type_generics, where_clause) = self.generics.split_for_impl();
        quote! {
            impl #impl_generics #krate::ConstrainedSystem for #name #type_generics #where_clause {
                type Multipliers = #krate::Fixed<1usize, 1usize>;
                type Augmented = #krate::Fixed<1usize, 2usize>;
                fn multipliers(&self) -> Self::Multipliers #never
                fn augmented(&self) -> Self::Augmented #never
            }
        }
    }

    /// The trait that systems have with a time transformation only.
    fn time_transformed(&self, never: &TokenStream) -> TokenStream {
        let Self { name, krate, .. } = self;
        let mut generics = self.generics.clone();
        generics.params.push(syn::parse_quote!(__T: #krate::Scalar));
        let (impl_generics, _, where_clause) = generics.split_for_impl();
        let (_, type_generics, _) = self.generics.split_for_impl();
        quote! {
            impl #impl_generics #krate::TimeTransformed<__T> for #name #type_generics #where_clause {
                fn time_transform_at(&self, _: &[__T]) -> #krate::system::TimeTransform<__T> #never
            }
        }
    }
}

/// A state whose coordinates are not known: a type that the compiler takes for anything.
///
/// The length of an array that is an error makes an error of its type, and an error of all that is
/// derived from it, which the compiler does not report again:
/// ```text
/// type VorticesStateOf<const N: usize, __T> = <[__T; compile_error!("…")] as IntoIterator>::Item;
/// type VorticesState<const N: usize> = VorticesStateOf<N, f64>;
/// ```
fn lost_state(
    krate: &Path,
    visibility: &Visibility,
    system: &Ident,
    generics: &Generics,
    errors: &mut Errors,
) -> (TokenStream, TokenStream, TokenStream) {
    let Names { state: name, of_f64 } = Names::of(system);
    let constants = generics.params.iter().filter_map(|parameter| match parameter {
        GenericParam::Const(constant) => Some((&constant.ident, &constant.ty)),
        _ => None,
    });
    let (constants, types): (Vec<_>, Vec<_>) = constants.unzip();
    let (error, allow) = (errors.take_first(), implement::allow());
    let item = quote! {
        #[doc(hidden)]
        #allow
        #visibility type #name<#(const #constants: #types,)* __T> =
            <[__T; { #error }] as ::core::iter::IntoIterator>::Item;
        #[doc(hidden)]
        #allow
        #[allow(dead_code)]
        #visibility type #of_f64<#(const #constants: #types),*> =
            #name<#(#constants,)* ::core::primitive::f64>;
    };
    (quote!(#krate::Fixed<1usize, 1usize>), quote!(#name<#(#constants,)* __T>), item)
}
