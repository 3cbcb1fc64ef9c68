//! What is generated for a regular system beyond what every system has.

use proc_macro2::TokenStream;
use quote::quote;

use super::constraints::constraints;
use super::document::{Account, beside_force, quantity};
use super::in_numbers;
use super::manifold::manifold;
use super::pairs::regular_pairs;
use crate::emit::Emitter;
use crate::emit::inlining::ForceInline;
use crate::formulas::RegularFormulas;
use crate::program::RegularPrograms;
use crate::statement::Output;
use crate::structure::MassMatrix;
use crate::symbolic::{Expr, print_coordinate, print_velocity};
use crate::validate::Checked;

pub(crate) fn regular(
    emitter: &Emitter<'_>,
    formulas: &RegularFormulas,
    programs: &RegularPrograms,
    structure: &MassMatrix,
    checked: &Checked,
) -> TokenStream {
    let implementation = implementation(emitter, programs, structure);
    let energy = emitter.value(&programs.energy);
    let members = quote! {
        #[inline]
        fn energy(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #energy }
    };
    super::system(
        emitter,
        &programs.shared,
        &account(emitter, formulas, programs, structure, checked),
        &members,
        &implementation,
    )
}

fn account(
    emitter: &Emitter<'_>,
    formulas: &RegularFormulas,
    programs: &RegularPrograms,
    structure: &MassMatrix,
    checked: &Checked,
) -> Account {
    let energy = programs.energy.statements.first().map_or(Expr::ZERO, |statement| statement.value);
    let declared = [("L", formulas.lagrangian), ("E", energy)];
    let declared = declared.map(|(name, value)| (name.to_string(), quantity(emitter, value)));
    let mut account = Account::new(
        "L(q, v, t) and its energy E = v·∂L/∂v − L:",
        declared.to_vec(),
        structure.sentences(formulas.constraints.as_ref().map(|declared| declared.of), emitter.model),
    );
    account.sentence(checked.sentence());
    account.momenta(emitter, &formulas.momenta);
    account.events(emitter, &formulas.events);
    account.forces(emitter, &programs.shared);
    account.constraints(emitter, &programs.shared);
    account.derived(emitter, &programs.shared.gradient.statements, |output, entry| match output {
        Output::Lv => format!("∂L/∂{}", print_velocity(entry, emitter.model)),
        Output::Lq | Output::Vector => {
            let force = beside_force(emitter, &programs.shared, "+", entry);
            format!("∂L/∂{}{force}", print_coordinate(entry, emitter.model))
        }
    });
    account
}

/// The implementation of `NondegenerateLagrangian`, and of what the system is beyond that.
fn implementation(emitter: &Emitter<'_>, programs: &RegularPrograms, structure: &MassMatrix) -> TokenStream {
    let MassMatrix { constant, uniform, separable, diagonal, quadratic, .. } = *structure;
    let [force, momentum, rate] = [&programs.force, &programs.momentum, &programs.momentum_rate]
        .map(|routine| emitter.vector(routine));
    let traits = [(separable, quote!(Separable)), (quadratic, quote!(QuadraticInVelocity))];
    let traits = traits.into_iter().filter_map(|(holds, name)| holds.then_some(name));
    let traits = traits.map(|structure| in_numbers(emitter, &structure, &TokenStream::new()));
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
    let lagrangian = in_numbers(emitter, &quote!(NondegenerateLagrangian), &lagrangian);
    let motion = match &programs.shared.constraints {
        Some(programs) => constraints(emitter, programs),
        None if emitter.model.is_on_manifold() => manifold(emitter),
        None => in_numbers(emitter, &quote!(RegularLagrangian), &TokenStream::new()),
    };
    let pairs = programs.pairs.as_ref().map(|pairs| regular_pairs(emitter, pairs));
    quote!(#lagrangian #motion #(#traits)* #pairs)
}
