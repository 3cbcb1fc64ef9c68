//! What is emitted in place of a system with mistakes in it.
//!
//! The struct as written, and implementations that type-check, so that the mistakes in the attribute
//! are the only ones that the compiler reports.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{Generics, Path, Visibility};

use crate::emit::Emitter;
use crate::errors::Errors;
use crate::implement::{self, State};
use crate::syntax::{Constrained, Kind};

/// A type that takes the place of a system.
struct StandIn<'a> {
    kind: Kind,
    of: (&'a Ident, &'a Generics),
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
    let (item, of) = (&model.item, model.named());
    let (space, state, state_item) = if model.lost_coordinates {
        lost_state(krate, &item.vis, of, &mut errors)
    } else {
        let State { space, type_in_trait, item, .. } = implement::state(emitter);
        (space, type_in_trait, item)
    };
    let (time_transformed, is_on_manifold) = (model.extended.is_some(), model.is_on_manifold());
    let stand_in =
        StandIn { kind: model.kind, of, krate, space, state, time_transformed, constrained, is_on_manifold };
    let (implementations, errors) = (stand_in.implementations(), errors.into_tokens());
    quote!(#errors #item #state_item #implementations)
}

/// With the attribute on a type that is no struct.
pub(super) fn without_struct(
    kind: Kind,
    visibility: &Visibility,
    of: (&Ident, &Generics),
    mut errors: Errors,
) -> TokenStream {
    let krate = &syn::parse_quote!(::dvi_core);
    let (space, state, state_item) = lost_state(krate, visibility, of, &mut errors);
    let (time_transformed, constrained, is_on_manifold) = (false, None, false);
    let stand_in = StandIn { kind, of, krate, space, state, time_transformed, constrained, is_on_manifold };
    let (implementations, errors) = (stand_in.implementations(), errors.into_tokens());
    quote!(#errors #state_item #implementations)
}

impl StandIn<'_> {
    fn implementations(&self) -> TokenStream {
        let Self { of, krate, space, state, .. } = self;
        let never = quote!({ ::core::unreachable!() });
        let kind = implement::kind(krate, self.kind, self.constrained, self.is_on_manifold);
        let is_regular = self.kind == Kind::Regular;
        let held = implement::held(krate, *of);
        let items = quote! {
            type Space = #space;
            type State<__T: #krate::Scalar> = #state;
            const REPORT: #krate::Report = #krate::Report::new("", &[], &[], &[], &[], &[], &[], &[], &[]);
            type Kind = #kind;
            fn space(&self) -> Self::Space #never
            fn block_len(&self, _: ::core::primitive::usize) -> ::core::primitive::usize #never
            fn check(&self) -> ::core::result::Result<(), #krate::IndexError> #never
        };
        let system = implement::of_type(krate, *of, &quote!(System), &items);
        let bare = |implemented, items| implement::over(krate, *of, of.1, &implemented, &items);
        let stand_in = bare(quote!(__private::StandIn), implement::suited());
        let time_transformed = self.time_transformed.then(|| {
            let mut generics = of.1.clone();
            generics.params.push(syn::parse_quote!(__T: #krate::Scalar));
            let items =
                quote!(fn time_transform_at(&self, _: &[__T]) -> #krate::system::TimeTransform<__T> #never);
            implement::over(krate, *of, &generics, &quote!(TimeTransformed<__T>), &items)
        });
        let constrained = (is_regular && self.constrained.is_some()).then(|| {
            let items = quote! {
                type Multipliers = #krate::Fixed<1usize, 1usize>;
                type Augmented = #krate::Fixed<1usize, 2usize>;
                fn multipliers(&self) -> Self::Multipliers #never
                fn augmented(&self) -> Self::Augmented #never
            };
            bare(quote!(ConstrainedSystem), items)
        });
        let manifold = (is_regular && self.is_on_manifold).then(|| {
            let items = quote! {
                type Tangent = #krate::Fixed<1usize, 1usize>;
                fn tangent(&self) -> Self::Tangent #never
            };
            bare(quote!(ManifoldSystem), items)
        });
        quote!(const _: () = { #held #system #stand_in #time_transformed #constrained #manifold };)
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
    (system, generics): (&Ident, &Generics),
    errors: &mut Errors,
) -> (TokenStream, TokenStream, TokenStream) {
    let [name, of_f64] = implement::names(system);
    let constants = generics.const_params().map(|constant| (&constant.ident, &constant.ty));
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
