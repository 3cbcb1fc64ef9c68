//! The implementation of `PairSum`.

use proc_macro2::TokenStream;
use quote::quote;

use super::in_numbers_with;
use crate::emit::{Emitter, local};
use crate::program::{Output, PairPrograms};
use crate::symbolic::Index;

pub(super) fn pair_sum(emitter: &Emitter<'_>, pairs: &PairPrograms) -> TokenStream {
    let axes = pairs.sum.blocks.len();
    let bodies = emitter.index(&pairs.sum.bodies);
    let places = pairs.sum.blocks.iter().enumerate().map(|(axis, block)| {
        let place = emitter.index(&offset(emitter, *block));
        quote!(#axis => #place,)
    });
    let weight = weight(emitter, pairs);
    let square = local(format_args!("q{}", pairs.sum.blocks[0]));
    let [kernel, kernel_slope] = [&pairs.kernel, &pairs.kernel_slope].map(|routine| emitter.body(routine));
    let [lagrangian, hamiltonian] =
        [&pairs.lagrangian, &pairs.hamiltonian].map(|routine| emitter.value(routine));
    let (read, body) = (emitter.read(&pairs.gradient), emitter.body(&pairs.gradient));
    let (l_q, l_v) = (emitter.output("l_q", Output::Lq), emitter.output("l_v", Output::Lv));
    let [gradient, source] =
        [&pairs.hamiltonian_gradient, &pairs.flow_source].map(|routine| emitter.vector(routine));
    let items = quote! {
        fn bodies(&self) -> usize { #bodies }
        fn place(&self, __axis: usize) -> usize {
            match __axis { #(#places)* _ => 0usize }
        }
        #[inline(always)]
        fn weight(&self, __body: usize) -> __T { #weight }
        #[inline(always)]
        fn kernel(&self, __r2: __T) -> __T {
            let #square = [__r2];
            #kernel
        }
        #[inline(always)]
        fn kernel_slope(&self, __r2: __T) -> __T {
            let #square = [__r2];
            #kernel_slope
        }
        fn rest_lagrangian(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #lagrangian }
        fn rest_gradient(
            &self, __q: &[__T], __v: &[__T], __t: __T, __l_q: &mut [__T], __l_v: &mut [__T],
        ) {
            #read #l_q #l_v #body
        }
        fn rest_hamiltonian(&self, __q: &[__T], __t: __T) -> __T { #hamiltonian }
        fn rest_hamiltonian_gradient(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
            #gradient
        }
        fn rest_flow_source(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) { #source }
    };
    in_numbers_with(emitter, &quote!(PairSum<__T, #axes>), &items)
}

/// The number of the first coordinate of a block.
fn offset(emitter: &Emitter<'_>, block: u32) -> Index {
    (0..block as usize).fold(Index::default(), |sum, before| sum.plus(&emitter.model.block_size(before), 1))
}

fn weight(emitter: &Emitter<'_>, pairs: &PairPrograms) -> TokenStream {
    let krate = emitter.krate();
    let one = quote!(<__T as #krate::Scalar>::lift(1.0));
    pairs.sum.weights.iter().fold(one, |product, (field, exponent)| {
        let factor = emitter.parameter(*field, &quote!([__body]));
        (0..*exponent).fold(product, |product, _| quote!(#product * #factor))
    })
}
