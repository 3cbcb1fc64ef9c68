//! The implementation of `PairSum`.

use proc_macro2::TokenStream;
use quote::quote;

use super::in_numbers;
use crate::emit::{Emitter, ForceInline, local};
use crate::program::PairPrograms;

pub(super) fn pairs(emitter: &Emitter<'_>, pairs: &PairPrograms) -> TokenStream {
    let vector = emitter.vector(&pairs.vector);
    let special = match &pairs.flow_source {
        Some(source) => {
            let source = emitter.vector(source);
            quote! {
                fn rest_hamiltonian_gradient(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                    #vector
                }
                fn rest_flow_source(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) { #source }
            }
        }
        None => quote! {
            fn rest_force(&self, __q: &[__T], __v: &[__T], __t: __T, __vector: &mut [__T]) { #vector }
        },
    };
    let krate = emitter.krate();
    let axes = pairs.sum.blocks.len();
    let bodies = emitter.index(&pairs.sum.bodies);
    let places = pairs.sum.blocks.iter().enumerate().map(|(axis, block)| {
        let place = emitter.index(&emitter.model.offset(*block as usize));
        quote!(#axis => #place,)
    });
    let weight = weight(emitter, pairs);
    let square = local(format_args!("q{}", pairs.sum.blocks[0]));
    let [kernel, kernel_slope] = [&pairs.kernel, &pairs.kernel_slope].map(|routine| emitter.body(routine));
    let [lagrangian, energy] = [&pairs.lagrangian, &pairs.energy].map(|routine| emitter.value(routine));
    let (gradient, linearize) = (emitter.gradient(&pairs.gradient), emitter.linearized(&pairs.linearize));
    let items = quote! {
        fn bodies(&self) -> ::core::primitive::usize { #bodies }
        fn place(&self, __axis: ::core::primitive::usize) -> ::core::primitive::usize {
            match __axis { #(#places)* _ => 0usize }
        }
        #ForceInline
        fn weight(&self, __body: ::core::primitive::usize) -> __T { #weight }
        #ForceInline
        fn kernel(&self, __r2: __T) -> __T {
            let #square = [__r2];
            #kernel
        }
        #ForceInline
        fn kernel_slope(&self, __r2: __T) -> __T {
            let #square = [__r2];
            #kernel_slope
        }
        fn rest_lagrangian(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #lagrangian }
        fn rest_gradient(
            &self, __q: &[__T], __v: &[__T], __t: __T, __l_q: &mut [__T], __l_v: &mut [__T],
        ) {
            #gradient
        }
        fn rest_linearize<__K: #krate::Sink<__T>>(
            &self, __q: &[__T], __v: &[__T], __t: __T, __w: #krate::Weights<__T>,
            __l_q: &mut [__T], __l_v: &mut [__T], __sink: &mut __K,
        ) {
            #linearize
        }
        fn rest_energy(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #energy }
        #special
    };
    in_numbers(emitter, &quote!(PairSum<__T, #axes>), &items)
}

fn weight(emitter: &Emitter<'_>, pairs: &PairPrograms) -> TokenStream {
    let krate = emitter.krate();
    let one = quote!(<__T as #krate::Scalar>::lift(1.0));
    pairs.sum.weights.iter().fold(one, |product, (field, exponent)| {
        let place = &emitter.model.parameters[*field as usize].tokens;
        let factor = emitter.parameter_at(*field, &quote!(#place[__body]));
        (0..*exponent).fold(product, |product, _| quote!(#product * #factor))
    })
}
