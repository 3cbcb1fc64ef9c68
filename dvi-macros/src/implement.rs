//! The trait implementations, from the programs of a system.
//!
//! Each generated function cuts its flat slices into one slice per coordinate block, and runs the
//! body that [`Emitter`] writes:
//! ```text
//! fn hamiltonian_gradient<__T: Scalar>(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
//!     let (__q0, __rest) = __q.split_at(N);
//!     let (__q1, __rest) = __rest.split_at(N);
//!     __vector.fill(__T::lift(-0.0));
//!     …
//! }
//! ```

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::{Emitter, local, output_block};
use crate::model::Model;
use crate::program::{Output, Programs, Statement};
use crate::structure::Structure;
use crate::symbolic::Node;

mod check;
mod document;
mod state;

pub(crate) use document::{documentation, report};
pub(crate) use state::{State, state};

pub(crate) struct Implementation<'a> {
    pub(crate) emitter: &'a Emitter<'a>,
    pub(crate) programs: &'a Programs,
    pub(crate) structure: &'a Structure,
    pub(crate) state: &'a State,
    pub(crate) report: TokenStream,
}

/// Which inputs a statement list reads.
struct Inputs {
    q: bool,
    v: bool,
}

impl Emitter<'_> {
    fn inputs(&self, statements: &[Statement]) -> Inputs {
        let mut inputs = Inputs { q: false, v: false };
        for id in self.graph.reachable(statements.iter().map(|statement| statement.value.node)) {
            match self.graph.node(id) {
                Node::Coordinate(_) => inputs.q = true,
                Node::Velocity(_) => inputs.v = true,
                _ => {}
            }
        }
        inputs
    }

    /// `let (__q0, __rest) = __q.split_at(n0); …`
    fn split(&self, array: &str, block_name: impl Fn(u32) -> String, method: &str) -> TokenStream {
        let (method, array) = (format_ident!("{method}"), format_ident!("__{array}"));
        let rest = local("rest");
        let mut from = quote!(#array);
        let mut tokens = TokenStream::new();
        for block in 0..self.model.blocks.len() {
            let name = local(block_name(block as u32).trim_start_matches('_'));
            let size = self.index(&self.model.block_size(block));
            tokens.extend(quote!(let (#name, #rest) = #from.#method(#size);));
            from = quote!(#rest);
        }
        quote!(#tokens let _ = #rest;)
    }

    fn read(&self, statements: &[Statement]) -> TokenStream {
        let inputs = self.inputs(statements);
        let q = inputs.q.then(|| self.split("q", |block| format!("q{block}"), "split_at"));
        let v = inputs.v.then(|| self.split("v", |block| format!("v{block}"), "split_at"));
        quote!(#q #v)
    }

    fn output(&self, array: &str, output: Output) -> TokenStream {
        let krate = self.krate();
        let split = self.split(array, |block| output_block(output, block), "split_at_mut");
        let array = format_ident!("__{array}");
        quote!(#array.fill(<__T as #krate::Scalar>::lift(-0.0)); #split)
    }

    fn matrix(&self) -> TokenStream {
        let mut offset = crate::symbolic::Index::default();
        let mut tokens = TokenStream::new();
        for block in 0..self.model.blocks.len() {
            let (name, value) = (local(format_args!("offset{block}")), self.index(&offset));
            tokens.extend(quote!(let #name: usize = #value;));
            offset = offset.plus(&self.model.block_size(block), 1);
        }
        let dimension = self.index(&offset);
        quote!(#tokens let __dimension: usize = #dimension;)
    }

    /// The body of a function that returns a value.
    fn value(&self, statements: &[Statement]) -> TokenStream {
        let (read, body) = (self.read(statements), self.body(statements));
        quote!(#read #body)
    }

    /// The body of a function that sets one vector.
    fn vector(&self, statements: &[Statement]) -> TokenStream {
        let (read, output) = (self.read(statements), self.output("vector", Output::Vector));
        let body = self.body(statements);
        quote!(#read #output #body)
    }
}

impl Implementation<'_> {
    pub(crate) fn tokens(&self) -> TokenStream {
        let (lagrangian, degenerate) = (self.lagrangian(), self.degenerate());
        quote! {
            const _: () = {
                #lagrangian
                #degenerate
            };
        }
    }

    fn lagrangian(&self) -> TokenStream {
        let (emitter, programs, krate) = (self.emitter, self.programs, self.emitter.krate());
        let (name, generics) = (&emitter.model.item.ident, &emitter.model.item.generics);
        let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
        let (space, dimension, state_type) =
            (&self.state.space, &self.state.space_value, &self.state.type_in_trait);
        let lengths =
            (0..emitter.model.blocks.len()).map(|block| emitter.index(&emitter.model.block_size(block)));
        let blocks = 0..emitter.model.blocks.len();
        let (check, report) = (check::check(emitter, programs), &self.report);
        let value = emitter.value(&programs.lagrangian);
        let (read, body) = (emitter.read(&programs.gradient), emitter.body(&programs.gradient));
        let (read_all, linearize) = (emitter.read(&programs.linearize), emitter.body(&programs.linearize));
        let (l_q, l_v) = (emitter.output("l_q", Output::Lq), emitter.output("l_v", Output::Lv));
        let matrix = emitter.matrix();
        let indices = 0..programs.momenta.len();
        let momenta = programs.momenta.iter().map(|(value, _)| emitter.value(value));
        let gradient_indices = 0..programs.momenta.len();
        let gradients = programs.momenta.iter().map(|(_, gradient)| emitter.vector(gradient));
        let allow = allow();
        quote! {
            #[automatically_derived]
            #allow
            impl #impl_generics #krate::Lagrangian for #name #type_generics #where_clause {
                type Space = #space;
                type State<__T: #krate::Scalar> = #state_type;
                const REPORT: #krate::Report = #report;

                #[inline(always)]
                fn space(&self) -> Self::Space { #dimension }
                #[inline]
                fn block_len(&self, __block: usize) -> usize {
                    match __block { #(#blocks => #lengths,)* _ => 0usize }
                }
                fn check(&self) -> ::core::result::Result<(), #krate::IndexError> { #check }
                #[inline]
                fn lagrangian<__T: #krate::Scalar>(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #value }
                #[inline]
                fn gradient<__T: #krate::Scalar>(
                    &self, __q: &[__T], __v: &[__T], __t: __T, __l_q: &mut [__T], __l_v: &mut [__T],
                ) {
                    #read #l_q #l_v #body
                }
                #[inline]
                fn linearize<__T: #krate::Scalar>(
                    &self, __q: &[__T], __v: &[__T], __t: __T, __w: #krate::Weights<__T>,
                    __l_q: &mut [__T], __l_v: &mut [__T], __matrix: &mut [__T],
                ) {
                    #read_all #l_q #l_v #matrix #linearize
                }
                #[inline]
                fn momentum<__T: #krate::Scalar>(&self, __index: usize, __q: &[__T], __t: __T) -> __T {
                    match __index {
                        #(#indices => { #momenta })*
                        _ => <__T as #krate::Scalar>::lift(f64::NAN),
                    }
                }
                #[inline]
                fn momentum_gradient<__T: #krate::Scalar>(
                    &self, __index: usize, __q: &[__T], __t: __T, __vector: &mut [__T],
                ) {
                    match __index {
                        #(#gradient_indices => { #gradients })*
                        _ => __vector.fill(<__T as #krate::Scalar>::lift(f64::NAN)),
                    }
                }
            }
        }
    }

    fn degenerate(&self) -> TokenStream {
        let (emitter, programs, krate) = (self.emitter, self.programs, self.emitter.krate());
        let (name, generics) = (&emitter.model.item.ident, &emitter.model.item.generics);
        let (impl_generics, type_generics, where_clause) = generics.split_for_impl();
        let Structure { linear, matching, canonical, .. } = *self.structure;
        let hamiltonian = emitter.value(&programs.hamiltonian);
        let hamiltonian_gradient = emitter.vector(&programs.hamiltonian_gradient);
        let one_form = emitter.vector(&programs.one_form);
        let flow_source = emitter.vector(&programs.flow_source);
        let (read, matrix) = (emitter.read(&programs.one_form_jacobian), emitter.matrix());
        let jacobian = emitter.body(&programs.one_form_jacobian);
        let partner_entries = emitter.vector(&programs.partner_entries);
        let partner = self.partner();
        let allow = allow();
        quote! {
            #[automatically_derived]
            #allow
            impl #impl_generics #krate::DegenerateLagrangian for #name #type_generics #where_clause {
                const LINEAR: bool = #linear;
                const MATCHING: bool = #matching;
                const CANONICAL: bool = #canonical;

                #[inline]
                fn hamiltonian<__T: #krate::Scalar>(&self, __q: &[__T], __t: __T) -> __T { #hamiltonian }
                #[inline(always)]
                fn hamiltonian_gradient<__T: #krate::Scalar>(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                    #hamiltonian_gradient
                }
                #[inline]
                fn one_form<__T: #krate::Scalar>(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) { #one_form }
                #[inline]
                fn flow_source<__T: #krate::Scalar>(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                    #flow_source
                }
                #[inline]
                fn one_form_jacobian<__T: #krate::Scalar>(
                    &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __matrix: &mut [__T],
                ) {
                    #read #matrix #jacobian
                }
                #[inline]
                fn partner_entries<__T: #krate::Scalar>(
                    &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __vector: &mut [__T],
                ) {
                    #partner_entries
                }
                #[inline(always)]
                fn partner(&self, __i: usize) -> usize { #partner }
            }
        }
    }

    /// Block by block: `if i < end { return i − offset + partner's offset }`.
    fn partner(&self) -> TokenStream {
        let model: &Model = self.emitter.model;
        let mut offsets = vec![crate::symbolic::Index::default()];
        for block in 0..model.blocks.len() {
            offsets.push(offsets[block].plus(&model.block_size(block), 1));
        }
        let cases = self.structure.partners.iter().enumerate().map(|(block, partner)| {
            let end = self.emitter.index(&offsets[block + 1]);
            let (from, to) = (self.emitter.index(&offsets[block]), self.emitter.index(&offsets[*partner]));
            quote!(if __i < #end { return __i - (#from) + (#to); })
        });
        quote!(#(#cases)* __i)
    }
}

/// Generated code answers to no style lint.
pub(crate) fn allow() -> TokenStream {
    quote! {
        #[allow(
            clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction,
            unused_variables, unused_mut, unused_parens, unused_braces, unreachable_code,
            non_snake_case, non_upper_case_globals
        )]
    }
}
