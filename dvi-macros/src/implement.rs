//! The trait implementations, from the programs of a system: those that the systems of both attributes have.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Generics, Ident, Path, parse_quote};

use crate::emit::{Emitter, ForceInline, own_function, scalar_field};
use crate::program::{EventPrograms, Programs};
use crate::routine::Routine;
use crate::symbolic::Node;
use crate::syntax::{Constrained, Kind};

mod check;
mod constraints;
mod degenerate;
mod document;
mod manifold;
mod packable;
mod pairs;
mod regular;
mod slices;
mod state;

pub(crate) use degenerate::degenerate;
use document::Account;
pub(crate) use regular::regular;
pub(crate) use state::{State, names, state};

/// A function of this many instructions at most is inlined wherever it is called.
const SHORT: usize = 128;

/// The item as written with its documentation continued, its state, and its implementations: the one that
/// all systems have, with `members` more, and `special`.
fn system(account: &Account<'_>, members: &TokenStream, special: &TokenStream) -> TokenStream {
    let Account { emitter, programs, .. } = *account;
    let (documentation, report) = (account.documentation(), account.report());
    let state = state(emitter);
    let configuration = configuration(emitter, programs, &state, &report);
    let lagrangian = lagrangian(emitter, programs, members);
    // Below what the user says.
    let mut item = emitter.model.item.clone();
    item.attrs.push(parse_quote!(#[doc = #documentation]));
    let (state, functions) = (&state.item, functions(emitter));
    let packable = packable::packable(&emitter.model.crate_path, &emitter.model.item);
    quote! {
        #item
        #state
        const _: () = {
            #configuration
            #lagrangian
            #special
            #functions
            #packable
        };
    }
}

/// One method for each function of the user's own and each of its derivatives:
/// ```text
/// fn __function0_1<__T: Scalar>(__x: __T) -> __T {
///     let __function: fn(__T) -> __T = d_potential;
///     __function(__x)
/// }
/// ```
fn functions(emitter: &Emitter<'_>) -> TokenStream {
    let krate = emitter.krate();
    let (name, generics) = (&emitter.model.item.ident, &emitter.model.item.generics);
    let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
    let functions = emitter.model.functions.iter().enumerate().flat_map(|(number, function)| {
        function.derivatives.iter().enumerate().map(move |(order, path)| {
            let name = own_function(number, order);
            let value = quote_spanned!(path.span()=> #path);
            quote! {
                #ForceInline
                fn #name<__T: #krate::Scalar>(__x: __T) -> __T {
                    let __function: fn(__T) -> __T = #value;
                    __function(__x)
                }
            }
        })
    });
    let functions: Vec<TokenStream> = functions.chain(scalar_fields(emitter)).collect();
    if functions.is_empty() {
        return TokenStream::new();
    }
    let allow = allow();
    quote! {
        #allow
        #[allow(dead_code)]
        impl #impl_generics #name #type_generics #where_clause { #(#functions)* }
    }
}

/// One method for each function of several variables:
/// ```text
/// fn __scalar_field0<__T: Scalar>(&self, __at: [__T; 2]) -> Expansion<2, __T> {
///     ScalarField::<2>::expansion(&self.psi, __at)
/// }
/// ```
fn scalar_fields(emitter: &Emitter<'_>) -> impl Iterator<Item = TokenStream> {
    let krate = emitter.krate();
    emitter.model.scalar_fields.iter().enumerate().map(move |(number, field)| {
        let (name, arity, place) = (scalar_field(number), field.arity, &field.tokens);
        let bound = field.generic.as_ref().map(|ty| quote!(where #ty: #krate::ScalarField<#arity>));
        // That its type is no such function is reported where it is called.
        let value = quote_spanned!(field.span=> #krate::ScalarField::<#arity>::expansion(&#place, __at));
        quote! {
            #ForceInline
            fn #name<__T: #krate::Scalar>(
                &self, __at: [__T; #arity],
            ) -> #krate::field::Expansion<#arity, __T> #bound { #value }
        }
    })
}

/// The generics of the system and the numbers `__T` that it is computed in: those that its parameters can be
/// lifted to.
fn over_numbers(emitter: &Emitter<'_>) -> Generics {
    let (krate, model) = (emitter.krate(), emitter.model);
    let mut generics = model.item.generics.clone();
    generics.params.push(parse_quote!(__T: #krate::Scalar));
    let is_of = |field, node: &Node| matches!(node, Node::Parameter(known) if known.field as usize == field);
    let mentioned = |field: usize| emitter.graph.mentions(|node| is_of(field, node));
    let types = model.parameters.iter().enumerate().filter(|(field, _)| mentioned(*field));
    for generic in types.filter_map(|(_, parameter)| parameter.generic.as_ref()) {
        generics.make_where_clause().predicates.push(parse_quote!(#generic: #krate::Parameter<__T>));
    }
    for field in &model.scalar_fields {
        if let (Some(ty), arity) = (&field.generic, field.arity) {
            generics.make_where_clause().predicates.push(parse_quote!(#ty: #krate::ScalarField<#arity>));
        }
    }
    generics
}

/// The implementation of a trait, with its arguments, that a system has in all numbers `__T`.
fn in_numbers(emitter: &Emitter<'_>, implemented: &TokenStream, items: &TokenStream) -> TokenStream {
    let (krate, allow) = (emitter.krate(), allow());
    let implementation = over(krate, emitter.model.named(), &over_numbers(emitter), implemented, items);
    quote!(#[automatically_derived] #allow #implementation)
}

/// What stands in each trait by which a method asks for a kind of systems.
pub(crate) fn suited() -> TokenStream {
    quote! { type Suited<__M> = __M; }
}

/// The type that says what kind of Lagrangian it is.
pub(crate) fn kind(
    krate: &Path,
    kind: Kind,
    constrained: Option<Constrained>,
    is_on_manifold: bool,
) -> TokenStream {
    match (kind, constrained) {
        (Kind::Degenerate, _) => quote!(#krate::__private::Degenerate),
        (Kind::Regular, None) if is_on_manifold => quote!(#krate::__private::Manifold),
        (Kind::Regular, None) => quote!(#krate::__private::Regular),
        (Kind::Regular, Some(Constrained::Positions)) => quote!(#krate::__private::Holonomic),
        (Kind::Regular, Some(Constrained::Velocities)) => quote!(#krate::__private::Nonholonomic),
        (Kind::Regular, Some(Constrained::Gaps)) => quote!(#krate::__private::Unilateral),
    }
}

/// The implementation of a trait for a type, over these generics, without attributes.
pub(crate) fn over(
    krate: &Path,
    (name, own): (&Ident, &Generics),
    generics: &Generics,
    implemented: &TokenStream,
    items: &TokenStream,
) -> TokenStream {
    let (impl_generics, _, where_clause) = generics.split_for_impl();
    let (_, type_generics, _) = own.split_for_impl();
    quote!(impl #impl_generics #krate::#implemented for #name #type_generics #where_clause { #items })
}

/// The implementation of a trait that is not over numbers.
pub(crate) fn of_type(
    krate: &Path,
    of: (&Ident, &Generics),
    implemented: &TokenStream,
    items: &TokenStream,
) -> TokenStream {
    let (allow, implementation) = (allow(), over(krate, of, of.1, implemented, items));
    quote!(#[automatically_derived] #allow #implementation)
}

/// The implementation of `Held`: a run may own the system.
pub(crate) fn held(krate: &Path, of: (&Ident, &Generics)) -> TokenStream {
    let items = quote! {
        type System = Self;
        #ForceInline
        fn held(&self) -> &Self { self }
    };
    of_type(krate, of, &quote!(Held), &items)
}

/// The implementation of `System`.
fn configuration(
    emitter: &Emitter<'_>,
    programs: &Programs,
    state: &State,
    report: &TokenStream,
) -> TokenStream {
    let krate = emitter.krate();
    let State { space, space_value, type_in_trait, .. } = state;
    let model = emitter.model;
    let sizes = (0..model.blocks.len()).map(|block| (block, model.block_size(block)));
    let rows = model.blocks.iter().enumerate();
    let rows =
        rows.filter_map(|(block, one)| Some((model.number_of_rows(block), one.row_length()?.clone())));
    let (blocks, lengths): (Vec<usize>, Vec<TokenStream>) =
        sizes.chain(rows).map(|(number, length)| (number, model.size_tokens(&length))).unzip();
    let time_transformed = emitter.model.extended.is_some();
    let forced = programs.forces.is_some();
    let autonomous = !programs.depends_on_time(emitter.graph);
    let has_scalar_fields = !emitter.model.scalar_fields.is_empty();
    let has_domain = programs.domain.as_ref();
    let has_domain = has_domain.map(|_| quote! { const HAS_DOMAIN: ::core::primitive::bool = true; });
    let count = programs.seams.len();
    let seams = (count > 0).then(|| quote! { const SEAMS: ::core::primitive::usize = #count; });
    let constrained = programs.constraints.as_ref().map(|constraints| constraints.of);
    let check = check::check(emitter, programs);
    let kind = kind(krate, model.kind, constrained, model.is_on_manifold());
    let held = held(krate, model.named());
    let items = quote! {
        type Space = #space;
        type Kind = #kind;
        type State<__T: #krate::Scalar> = #type_in_trait;
        const REPORT: #krate::Report = #report;
        const HAS_SCALAR_FIELDS: ::core::primitive::bool = #has_scalar_fields;
        #has_domain
        #seams
        const TIME_TRANSFORMED: ::core::primitive::bool = #time_transformed;
        const FORCED: ::core::primitive::bool = #forced;
        const AUTONOMOUS: ::core::primitive::bool = #autonomous;

        #ForceInline
        fn space(&self) -> Self::Space { #space_value }
        #[inline]
        fn block_len(&self, __block: ::core::primitive::usize) -> ::core::primitive::usize {
            match __block { #(#blocks => #lengths,)* _ => 0usize }
        }
        fn check(&self) -> ::core::result::Result<(), #krate::IndexError> { #check }
    };
    let system = of_type(krate, model.named(), &quote!(System), &items);
    quote!(#held #system)
}

/// The implementation of `Lagrangian`.
fn lagrangian(emitter: &Emitter<'_>, programs: &Programs, members: &TokenStream) -> TokenStream {
    let krate = emitter.krate();
    let value = emitter.value(&programs.lagrangian);
    let (gradient, linearize) =
        (emitter.gradient(&programs.gradient), emitter.linearized(&programs.linearize));
    // A call costs as much as a few terms of a sum.
    let always = (programs.linearize.code.len() <= SHORT).then(|| quote!((always)));
    let applied_force = programs.forces.as_ref().map(|forces| {
        let applied = emitter.vector(forces);
        quote! {
            #[inline]
            fn applied_force(&self, __q: &[__T], __v: &[__T], __t: __T, __vector: &mut [__T]) { #applied }
        }
    });
    let outside = (!emitter.model.scalar_fields.is_empty()).then(|| {
        let (read, body) = (emitter.read(&programs.probe), emitter.guarded(&programs.probe));
        quote! {
            fn outside(
                &self, __q: &[__T], __v: &[__T], __t: __T,
            ) -> ::core::option::Option<#krate::OutsideError>
            where
                __T: #krate::Real,
            {
                #read #body
            }
        }
    });
    let domain = programs.domain.as_ref().map(|domain| {
        let value = emitter.value(domain);
        quote! {
            #[inline]
            fn domain(&self, __q: &[__T], __t: __T) -> __T { #value }
        }
    });
    let events = (!programs.events.is_empty()).then(|| events(emitter, &programs.events));
    let by_number = |routines: &[Routine]| {
        by_index(routines.iter().map(|routine| emitter.value(routine)), &nothing(krate))
    };
    let momenta = by_number(&programs.momenta);
    let seams = (!programs.seams.is_empty()).then(|| {
        let values = by_number(&programs.seams);
        quote! {
            fn seam(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
                #values
            }
        }
    });
    let items = quote! {
            #[inline]
            fn lagrangian(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #value }
            #[inline]
            fn gradient(
                &self, __q: &[__T], __v: &[__T], __t: __T, __l_q: &mut [__T], __l_v: &mut [__T],
            ) {
                #gradient
            }
            #[inline #always]
            fn linearize<__K: #krate::Sink<__T>>(
                &self, __q: &[__T], __v: &[__T], __t: __T, __w: #krate::Weights<__T>,
                __l_q: &mut [__T], __l_v: &mut [__T], __sink: &mut __K,
            ) {
                #linearize
            }
            #applied_force
            #outside
            #domain
            #members
            #[inline]
            fn momentum(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
                #momenta
            }
            #events
            #seams
    };
    in_numbers(emitter, &quote!(Lagrangian<__T>), &items)
}

/// `event` and `event_gradient` of `Lagrangian`.
fn events(emitter: &Emitter<'_>, events: &[EventPrograms]) -> TokenStream {
    let nothing = nothing(emitter.krate());
    let values = by_index(events.iter().map(|event| emitter.value(&event.value)), &nothing);
    let gradients = events.iter().map(|EventPrograms { gradient, by_time, .. }| {
        let (gradient, by_time) = (emitter.gradient(gradient), emitter.value(by_time));
        quote!({ #gradient } #by_time)
    });
    let gradients = by_index(gradients, &nothing);
    quote! {
        #[inline]
        fn event(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
            #values
        }
        fn event_gradient(
            &self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T,
            __l_q: &mut [__T], __l_v: &mut [__T],
        ) -> __T {
            #gradients
        }
    }
}

/// The body of number `__index` among several, or `otherwise`.
fn by_index(bodies: impl Iterator<Item = TokenStream>, otherwise: &TokenStream) -> TokenStream {
    let (indices, bodies): (Vec<usize>, Vec<TokenStream>) = bodies.enumerate().unzip();
    quote!(match __index { #(#indices => { #bodies })* _ => #otherwise, })
}

/// The value of a function that there is not.
fn nothing(krate: &Path) -> TokenStream {
    quote!(<__T as #krate::Scalar>::lift(::core::primitive::f64::NAN))
}

/// Generated code answers to no style lint: its names are those of the user's struct, with more behind them,
/// and its paths are written as formulas need them.
pub(crate) fn allow() -> TokenStream {
    quote! {
        #[allow(
            clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction,
            unused_variables, unused_mut, unused_parens, unused_braces, unreachable_code,
            non_snake_case, non_upper_case_globals, non_camel_case_types, unused_qualifications
        )]
    }
}
