//! What is generated for a degenerate system beyond what every system has.

use proc_macro2::TokenStream;
use quote::quote;

use super::document::{Account, quantity};
use super::in_numbers;
use crate::emit::Emitter;
use crate::program::{DegenerateFormulas, DegeneratePrograms};
use crate::structure::OneForm;
use crate::symbolic::{Index, print_coordinate};
use crate::validate::Checked;

pub(crate) fn degenerate(
    emitter: &Emitter<'_>,
    formulas: &DegenerateFormulas,
    programs: &DegeneratePrograms,
    structure: &OneForm,
    checked: &Checked,
) -> TokenStream {
    let implementation = implementation(emitter, programs, structure);
    let krate = emitter.krate();
    let energy = quote!(<Self as #krate::DegenerateLagrangian<__T>>::hamiltonian(self, __q, __t));
    super::system(
        emitter,
        &programs.shared,
        &account(emitter, formulas, programs, structure, checked),
        &energy,
        &implementation,
    )
}

fn account(
    emitter: &Emitter<'_>,
    formulas: &DegenerateFormulas,
    programs: &DegeneratePrograms,
    structure: &OneForm,
    checked: &Checked,
) -> Account {
    let declared = [("α", formulas.one_form), ("H", formulas.hamiltonian)];
    let declared = declared.map(|(name, value)| (name.to_string(), quantity(emitter, value)));
    let mut account =
        Account::new("L(q, v, t) = α(q, t)·v − H(q, t) with", declared.to_vec(), structure.sentences());
    account.sentence(checked.sentence());
    account.momenta(emitter, &formulas.momenta);
    let coordinate = |coordinate: &_| print_coordinate(coordinate, emitter.model);
    account.derived(emitter, &programs.one_form.statements, |_, entry| format!("α_{}", coordinate(entry)));
    account.derived(emitter, &programs.hamiltonian_gradient.statements, |_, entry| {
        format!("∂H/∂{}", coordinate(entry))
    });
    account
}

/// The implementation of `DegenerateLagrangian`.
fn implementation(emitter: &Emitter<'_>, programs: &DegeneratePrograms, structure: &OneForm) -> TokenStream {
    let krate = emitter.krate();
    let OneForm { linear, matching, canonical, .. } = *structure;
    let hamiltonian = emitter.value(&programs.hamiltonian);
    let hamiltonian_gradient = emitter.vector(&programs.hamiltonian_gradient);
    let one_form = emitter.vector(&programs.one_form);
    let flow_source = emitter.vector(&programs.flow_source);
    let (read, offsets) = (emitter.read(&programs.one_form_jacobian), emitter.offsets());
    let jacobian = emitter.body(&programs.one_form_jacobian);
    let conjugate_entries = emitter.vector(&programs.conjugate_entries);
    let conjugate = conjugate(emitter, structure);
    let indices = 0..programs.momentum_gradients.len();
    let gradients = programs.momentum_gradients.iter().map(|gradient| emitter.vector(gradient));
    let affine = linear.then(|| in_numbers(emitter, &quote!(AffineOneForm), &TokenStream::new()));
    let items = quote! {
            const AFFINE: bool = #linear;
            const MATCHING: bool = #matching;
            const CANONICAL: bool = #canonical;

            #[inline]
            fn hamiltonian(&self, __q: &[__T], __t: __T) -> __T { #hamiltonian }
            #[inline(always)]
            fn hamiltonian_gradient(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                #hamiltonian_gradient
            }
            #[inline]
            fn one_form(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) { #one_form }
            #[inline]
            fn flow_source(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                #flow_source
            }
            #[inline]
            fn one_form_jacobian<__K: #krate::Sink<__T>>(
                &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __sink: &mut __K,
            ) {
                #read #offsets #jacobian
            }
            #[inline]
            fn conjugate_entries(
                &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __vector: &mut [__T],
            ) {
                #conjugate_entries
            }
            #[inline(always)]
            fn conjugate(&self, __i: usize) -> usize { #conjugate }
            #[inline]
            fn momentum_gradient(
                &self, __index: usize, __q: &[__T], __t: __T, __vector: &mut [__T],
            ) {
                match __index {
                    #(#indices => { #gradients })*
                    _ => __vector.fill(<__T as #krate::Scalar>::lift(f64::NAN)),
                }
            }
    };
    let lagrangian = in_numbers(emitter, &quote!(DegenerateLagrangian), &items);
    quote!(#lagrangian #affine)
}

/// Block by block: `if i < end { return i − offset + conjugate's offset }`.
fn conjugate(emitter: &Emitter<'_>, structure: &OneForm) -> TokenStream {
    let model = emitter.model;
    let mut offsets = vec![Index::default()];
    for block in 0..model.blocks.len() {
        offsets.push(offsets[block].plus(&model.block_size(block), 1));
    }
    let cases = structure.conjugates.iter().enumerate().map(|(block, conjugate)| {
        let end = emitter.index(&offsets[block + 1]);
        let (from, to) = (emitter.index(&offsets[block]), emitter.index(&offsets[*conjugate]));
        quote!(if __i < #end { return __i - (#from) + (#to); })
    });
    quote!(#(#cases)* __i)
}
