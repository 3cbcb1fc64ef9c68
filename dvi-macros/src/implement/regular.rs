//! What is generated for a regular system beyond what every system has.

use proc_macro2::TokenStream;
use quote::quote;

use super::constraints::constraints;
use super::document::{Account, beside_force, in_tex, quantity};
use super::manifold::manifold;
use super::pairs::pairs;
use super::{in_numbers, suited};
use crate::emit::Emitter;
use crate::emit::inlining::ForceInline;
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
    let implementation = implementation(emitter, programs, structure);
    let energy = emitter.value(&programs.energy);
    let members = quote! {
        #[inline]
        fn energy(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T { #energy }
    };
    super::system(
        emitter,
        &programs.shared,
        &account(emitter, attribute, formulas, programs, structure, checked),
        &members,
        &implementation,
    )
}

fn account(
    emitter: &Emitter<'_>,
    attribute: &Attribute,
    formulas: &RegularFormulas,
    programs: &RegularPrograms,
    structure: &MassMatrix,
    checked: &Checked,
) -> Account {
    let energy = programs.energy.statements.first();
    let declared =
        [("L", formulas.lagrangian), ("E", energy.map_or(Expr::ZERO, |statement| statement.value))];
    let declared = declared.map(|(name, value)| (name.to_string(), quantity(emitter, value)));
    let mut account = Account::new(
        attribute,
        emitter.model,
        "L(q, v, t), and what is declared with it:",
        declared.to_vec(),
        structure.sentences(formulas.constraints.as_ref().map(|declared| declared.of), emitter.model),
    );
    account.sentence(checked.sentence());
    account.observed(emitter, &formulas.momenta, &formulas.events);
    account.forces(emitter, &programs.shared);
    account.seams(emitter, &programs.shared.seams);
    account.constraints(emitter, &programs.shared);
    if let Some(energy) = energy {
        account.typeset(emitter, "E".to_string(), energy.value);
    }
    account.derived(
        emitter,
        &programs.shared.gradient.statements,
        |typesetter, output, entry| match output {
            Output::Lv => {
                let by = print_velocity(entry, emitter.model);
                (format!("∂L/∂{by}"), Some(format!(r"\partial L / \partial {}", in_tex(typesetter, &by))))
            }
            Output::Lq | Output::Vector => {
                let [text, tex] = beside_force(emitter, attribute, &programs.shared, typesetter, '+', entry);
                let by = print_coordinate(entry, emitter.model);
                (
                    format!("∂L/∂{by}{text}"),
                    Some(format!(r"\partial L / \partial {}{tex}", in_tex(typesetter, &by))),
                )
            }
        },
    );
    account
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
    let lagrangian = in_numbers(emitter, &quote!(NondegenerateLagrangian), &lagrangian);
    let separable = separable.then(|| in_numbers(emitter, &quote!(Separable), &suited()));
    let motion = match &programs.shared.constraints {
        Some(programs) => constraints(emitter, programs),
        None if emitter.model.is_on_manifold() => manifold(emitter),
        None => in_numbers(emitter, &quote!(RegularLagrangian), &suited()),
    };
    let pairs = programs.pairs.as_ref().map(|sum| pairs(emitter, sum));
    quote!(#lagrangian #motion #separable #pairs)
}
