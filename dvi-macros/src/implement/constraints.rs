//! What is generated for a system with constraints.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::state::space_of;
use super::{in_numbers, of_type, suited};
use crate::emit::{Emitter, ForceInline, constraint_members, first_constraint};
use crate::program::Constraints;
use crate::routine::Routine;
use crate::symbolic::Count;
use crate::syntax::Constrained;

impl Emitter<'_> {
    /// Sets g, or a in its place, to zero and cuts it into one slice for each declared constraint.
    fn constraint_output(&self, constraints: &Constraints) -> TokenStream {
        let krate = self.krate();
        let lengths = constraints.lengths.iter().zip(0..);
        let parts =
            lengths.map(|(length, constraint)| (constraint_members(constraint), self.length(length)));
        let split = super::slices::split(&format_ident!("__g"), parts, "split_at_mut");
        quote!(__g.fill(<__T as #krate::Scalar>::lift(-0.0)); #split)
    }

    /// The number of the first member of each declared constraint:
    /// ```text
    /// let __row0: usize = 0usize;
    /// let __row1: usize = __row0 + N.saturating_sub(1usize);
    /// ```
    fn first_constraints(&self, constraints: &Constraints) -> TokenStream {
        let mut first = quote!(0usize);
        let mut tokens = TokenStream::new();
        for (constraint, length) in constraints.lengths.iter().enumerate() {
            let (name, length) = (first_constraint(constraint as u32), self.length(length));
            tokens.extend(quote!(let #name: ::core::primitive::usize = #first;));
            first = quote!(#name + #length);
        }
        tokens
    }
}

/// The implementations of `ConstrainedSystem` and of `HolonomicLagrangian`, `NonholonomicLagrangian` or
/// `UnilateralLagrangian`.
pub(super) fn constraints(emitter: &Emitter<'_>, constraints: &Constraints) -> TokenStream {
    let (system, lagrangian) = (system(emitter, constraints), lagrangian(emitter, constraints));
    quote!(#system #lagrangian)
}

fn system(emitter: &Emitter<'_>, constraints: &Constraints) -> TokenStream {
    let (multipliers, multipliers_value) = space_of(emitter, &constraints.lengths);
    let sizes = (0..emitter.model.blocks.len()).map(|block| emitter.model.block_size(block).into());
    let both: Vec<Count> = sizes.chain(constraints.lengths.iter().cloned()).collect();
    let (augmented, augmented_value) = space_of(emitter, &both);
    let items = quote! {
        type Multipliers = #multipliers;
        type Augmented = #augmented;

        #ForceInline
        fn multipliers(&self) -> Self::Multipliers { #multipliers_value }
        #ForceInline
        fn augmented(&self) -> Self::Augmented { #augmented_value }
    };
    of_type(emitter.krate(), emitter.model.named(), &quote!(ConstrainedSystem), &items)
}

/// Of velocities there are two derivatives, which the Jacobian adds up with weights.
fn lagrangian(emitter: &Emitter<'_>, constraints: &Constraints) -> TokenStream {
    let krate = emitter.krate();
    let name = match constraints.of {
        Constrained::Positions => quote!(HolonomicLagrangian),
        Constrained::Velocities => quote!(NonholonomicLagrangian),
        Constrained::Gaps => quote!(UnilateralLagrangian),
    };
    let [value_of, jacobian_of, rate_of] =
        constraints.of.words().generated.map(|function| format_ident!("{function}"));
    let of_velocities = constraints.of == Constrained::Velocities;
    let suited = (constraints.of == Constrained::Gaps).then(suited);
    let velocity = of_velocities.then(|| quote!(__v: &[__T],));
    let weights = of_velocities.then(|| quote!(__weights: [__T; 2],));
    let output = emitter.constraint_output(constraints);
    let for_constraints = |routine: &Routine| emitter.function(routine, &output);
    let [value, rate] = [&constraints.value, &constraints.rate].map(for_constraints);
    let (rows, offsets) = (emitter.first_constraints(constraints), emitter.offsets());
    let jacobian = emitter.function(&constraints.jacobian, &quote!(#output #rows #offsets));
    let curvature = constraints.curvature.as_ref().map(for_constraints).map(|curvature| {
        quote! {
            #[inline]
            fn constraint_curvature(&self, __q: &[__T], __v: &[__T], __t: __T, __g: &mut [__T]) { #curvature }
        }
    });
    let items = quote! {
        #suited
        #[inline]
        fn #value_of(&self, __q: &[__T], #velocity __t: __T, __g: &mut [__T]) { #value }
        #[inline]
        fn #jacobian_of<__K: #krate::Sink<__T>>(
            &self, __q: &[__T], #velocity __t: __T, #weights __g: &mut [__T], __sink: &mut __K,
        ) {
            #jacobian
        }
        #[inline]
        fn #rate_of(&self, __q: &[__T], __v: &[__T], __t: __T, __g: &mut [__T]) { #rate }
        #curvature
    };
    in_numbers(emitter, &quote!(#name<__T>), &items)
}
