//! The bodies of generated functions: each cuts its flat slices into one slice per coordinate block, and
//! runs what [`Emitter`] writes:
//! ```text
//! fn hamiltonian_gradient(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
//!     let (__q0, __rest) = __q.split_at(N);
//!     let (__q1, __rest) = __rest.split_at(N);
//!     __vector.fill(__T::lift(-0.0));
//!     …
//! }
//! ```

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::Ident;

use crate::emit::{Emitter, local, slice};
use crate::routine::Routine;
use crate::statement::Output;
use crate::symbolic::Node;

impl Emitter<'_> {
    /// One slice for each block of coordinates.
    fn split(&self, array: &str, method: &str) -> TokenStream {
        let parts = (0..self.model.blocks.len())
            .map(|block| (slice(array, block as u32), self.index(&self.model.block_size(block))));
        split(&format_ident!("__{array}"), parts, method)
    }

    /// Cuts the inputs that a routine reads.
    pub(super) fn read(&self, routine: &Routine) -> TokenStream {
        let nodes = self.graph.reachable(routine.statements.iter().map(|statement| statement.value.node));
        let cut = |array: &str, is_read: fn(&Node) -> bool| {
            let is_read = nodes.iter().any(|id| is_read(self.graph.node(*id)));
            is_read.then(|| self.split(array, "split_at"))
        };
        let q = cut("q", Node::is_position);
        let v = cut("v", Node::is_velocity);
        quote!(#q #v)
    }

    /// Clears an output and cuts it.
    fn output(&self, output: Output) -> TokenStream {
        let (krate, split) = (self.krate(), self.split(output.array(), "split_at_mut"));
        let array = format_ident!("__{}", output.array());
        quote!(#array.fill(<__T as #krate::Scalar>::lift(-0.0)); #split)
    }

    /// The number of the first coordinate of each block.
    pub(super) fn offsets(&self) -> TokenStream {
        let offset = |block| {
            let (name, value) =
                (local(format_args!("offset{block}")), self.index(&self.model.offset(block)));
            quote!(let #name: ::core::primitive::usize = #value;)
        };
        (0..self.model.blocks.len()).map(offset).collect()
    }

    /// The body of a function, which has its outputs and what else it needs `before` it.
    pub(super) fn function(&self, routine: &Routine, before: &TokenStream) -> TokenStream {
        let (read, body) = (self.read(routine), self.body(routine));
        quote!(#read #before #body)
    }

    /// The body of a function that returns a value.
    pub(super) fn value(&self, routine: &Routine) -> TokenStream {
        self.function(routine, &TokenStream::new())
    }

    /// The body of a function that sets ∂/∂q and ∂/∂v.
    pub(super) fn gradient(&self, routine: &Routine) -> TokenStream {
        let before = [self.output(Output::Lq), self.output(Output::Lv)];
        self.function(routine, &before.into_iter().collect())
    }

    /// The body of a function that sets these and adds second derivatives to a sink.
    pub(super) fn linearized(&self, routine: &Routine) -> TokenStream {
        let before = [self.output(Output::Lq), self.output(Output::Lv), self.offsets()];
        self.function(routine, &before.into_iter().collect())
    }

    /// The body of a function that sets one vector.
    pub(super) fn vector(&self, routine: &Routine) -> TokenStream {
        self.function(routine, &self.output(Output::Vector))
    }
}

/// `let (__q0, __rest) = __q.split_at(n0); …`
pub(super) fn split(
    array: &Ident,
    parts: impl Iterator<Item = (Ident, TokenStream)>,
    method: &str,
) -> TokenStream {
    let (method, rest) = (format_ident!("{method}"), local("rest"));
    let mut from = array;
    let mut tokens = TokenStream::new();
    for (name, size) in parts {
        tokens.extend(quote!(let (#name, #rest) = #from.#method(#size);));
        from = &rest;
    }
    quote!(#tokens let _ = #rest;)
}
