//! What is generated for a regular system beyond what every system has.

use proc_macro2::TokenStream;
use quote::quote;

use super::constraints::constraints;
use super::document::{Account, beside_force};
use super::manifold::manifold;
use super::pairs::pairs;
use super::{in_numbers, suited};
use crate::emit::{Emitter, ForceInline};
use crate::formulas::RegularFormulas;
use crate::print::{print_coordinate, print_velocity};
use crate::program::RegularPrograms;
use crate::statement::Output;
use crate::structure::MassMatrix;
use crate::symbolic::Expr;
use crate::syntax::Attribute;
use crate::validate::Checked;

pub(crate) fn regular(
    emitter: &Emitter<'_>,
    attribute: &Attribute,
    formulas: &RegularFormulas,
    programs: &RegularPrograms,
    structure: &MassMatrix,
    checked: &Checked,
) -> TokenStream {
    let model = emitter.model;
    let energy = programs.energy.statements.first().map_or(Expr::ZERO, |statement| statement.value);
    let mut account = Account::new(
        (emitter, attribute, &programs.shared),
        "L(q, v, t), and what is declared with it:",
        [("L", formulas.lagrangian), ("E", energy)],
        structure.sentences(formulas.constraints.as_ref().map(|declared| declared.of), model),
    );
    account.observed(checked, &formulas.momenta, &formulas.events);
    account.constraints();
    account.derived(&programs.shared.gradient.statements, |output, entry| match output {
        Output::Lv => format!("∂L/∂{}", print_velocity(entry, model)),
        Output::Lq | Output::Vector => {
            let force = beside_force(emitter, &programs.shared, '+', entry);
            format!("∂L/∂{}{force}", print_coordinate(entry, model))
        }
    });
    let energy = emitter.value(&programs.energy);
    let members = quote! {
        #[inline]
        fn energy(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #energy }
    };
    super::system(&account, &members, &implementation(emitter, programs, structure))
}

/// The implementation of `NondegenerateLagrangian`, and of what the system is beyond that.
fn implementation(emitter: &Emitter<'_>, programs: &RegularPrograms, structure: &MassMatrix) -> TokenStream {
    let MassMatrix { constant, uniform, separable, diagonal, quadratic, .. } = *structure;
    let [force, momentum, rate] = [&programs.force, &programs.momentum, &programs.momentum_rate]
        .map(|routine| emitter.vector(routine));
    let lagrangian = quote! {
        const CONSTANT_MASS: ::core::primitive::bool = #constant;
        const UNIFORM_MASS: ::core::primitive::bool = #uniform;
        const SEPARABLE: ::core::primitive::bool = #separable;
        const DIAGONAL_MASS: ::core::primitive::bool = #diagonal;
        const QUADRATIC: ::core::primitive::bool = #quadratic;

        #ForceInline
        fn force(&self, __q: &[__T], __v: &[__T], __t: __T, __vector: &mut [__T]) { #force }
        #ForceInline
        fn conjugate_momentum(&self, __q: &[__T], __v: &[__T], __t: __T, __vector: &mut [__T]) { #momentum }
        #[inline]
        fn momentum_rate(&self, __q: &[__T], __v: &[__T], __t: __T, __vector: &mut [__T]) { #rate }
    };
    let lagrangian = in_numbers(emitter, &quote!(NondegenerateLagrangian<__T>), &lagrangian);
    let separable = separable.then(|| in_numbers(emitter, &quote!(Separable<__T>), &suited()));
    let motion = match &programs.shared.constraints {
        Some(programs) => constraints(emitter, programs),
        None if emitter.model.is_on_manifold() => manifold(emitter),
        None => in_numbers(emitter, &quote!(RegularLagrangian<__T>), &suited()),
    };
    let pairs = programs.pairs.as_ref().map(|sum| pairs(emitter, sum));
    quote!(#lagrangian #motion #separable #pairs)
}
