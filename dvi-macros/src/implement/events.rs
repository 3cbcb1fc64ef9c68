//! The functions whose zeros are events, with their derivatives, and those whose zeros are seams.

use proc_macro2::TokenStream;
use quote::quote;

use super::{by_index, nothing};
use crate::emit::Emitter;
use crate::program::EventPrograms;
use crate::routine::Routine;

/// `event` and `event_gradient` of `Lagrangian`.
pub(super) fn events(emitter: &Emitter<'_>, events: &[EventPrograms]) -> TokenStream {
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

/// `seam` of `Lagrangian`.
pub(super) fn seams(emitter: &Emitter<'_>, seams: &[Routine]) -> TokenStream {
    let values = by_index(seams.iter().map(|seam| emitter.value(seam)), &nothing(emitter.krate()));
    quote! {
        fn seam(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
            #values
        }
    }
}
