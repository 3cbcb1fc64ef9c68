//! The functions whose zeros are events, with their derivatives, and those whose zeros are seams.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Emitter;
use crate::program::EventPrograms;
use crate::routine::Routine;
use crate::statement::Output;

/// `event` and `event_gradient` of `Lagrangian`.
pub(super) fn events(emitter: &Emitter<'_>, events: &[EventPrograms]) -> TokenStream {
    let (indices, again) = (0..events.len(), 0..events.len());
    let values = events.iter().map(|event| emitter.value(&event.value));
    let (l_q, l_v) = (emitter.output("l_q", Output::Lq), emitter.output("l_v", Output::Lv));
    let gradients = events.iter().map(|EventPrograms { gradient, by_time, .. }| {
        let (read, body, by_time) = (emitter.read(gradient), emitter.body(gradient), emitter.value(by_time));
        quote!({ #read #l_q #l_v #body } #by_time)
    });
    let nothing = nothing(emitter);
    quote! {
        #[inline]
        fn event(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
            match __index {
                #(#indices => { #values })*
                _ => #nothing,
            }
        }
        fn event_gradient(
            &self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T,
            __l_q: &mut [__T], __l_v: &mut [__T],
        ) -> __T {
            match __index {
                #(#again => { #gradients })*
                _ => #nothing,
            }
        }
    }
}

/// `seam` of `Lagrangian`.
pub(super) fn seams(emitter: &Emitter<'_>, seams: &[Routine]) -> TokenStream {
    let (indices, nothing) = (0..seams.len(), nothing(emitter));
    let values = seams.iter().map(|seam| emitter.value(seam));
    quote! {
        fn seam(&self, __index: ::core::primitive::usize, __q: &[__T], __v: &[__T], __t: __T) -> __T {
            match __index {
                #(#indices => { #values })*
                _ => #nothing,
            }
        }
    }
}

/// The value of a function that there is not.
fn nothing(emitter: &Emitter<'_>) -> TokenStream {
    let krate = emitter.krate();
    quote!(<__T as #krate::Scalar>::lift(::core::primitive::f64::NAN))
}
