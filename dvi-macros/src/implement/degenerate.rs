//! What is generated for a degenerate system beyond what every system has.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::document::{Account, beside_force};
use super::pairs::pairs;
use super::{by_index, in_numbers, over, over_numbers, suited};
use crate::emit::{Emitter, ForceInline};
use crate::errors::listed;
use crate::formulas::{DegenerateFormulas, TimeTransform};
use crate::print::print_coordinate;
use crate::program::DegeneratePrograms;
use crate::routine::Routine;
use crate::structure::{Class, Components, OneForm};
use crate::symbolic::{Expr, Index, Node};
use crate::syntax::Attribute;
use crate::validate::Checked;

pub(crate) fn degenerate(
    emitter: &Emitter<'_>,
    attribute: &Attribute,
    formulas: &DegenerateFormulas,
    programs: &DegeneratePrograms,
    structure: &OneForm,
    checked: &Checked,
) -> TokenStream {
    let dynamics = [("α", formulas.one_form), ("H", formulas.hamiltonian)].into_iter();
    let declared = dynamics.chain(formulas.gauge.map(|gauge| ("F", gauge)));
    let declared = declared.chain(formulas.time.map(|time| ("ρ", time.rate)));
    let mut account = Account::new(
        (emitter, attribute, &programs.shared),
        "L(q, v, t) = α(q, t)·v − H(q, t), as it is declared:",
        declared,
        structure.sentences(emitter.model, programs.shared.forces.is_some()),
    );
    if formulas.gauge.is_some() {
        account.sentence("α and H contain the gauge F: dF/dt is added to L.".to_string());
    }
    let firsts = emitter.model.coordinates().into_iter().map(|blocks| &emitter.model.blocks[blocks.start]);
    for block in firsts.filter(|block| block.is_spinor()) {
        let (vector, spinor) =
            (block.label(), block.label().replacen(&*block.name.to_string(), &block.spinor(), 1));
        account.sentence(format!(
            "`{vector}` is in S²: a run carries the four coordinates of a spinor `{spinor}`, of which it is the vector z†σz."
        ));
    }
    if formulas.time.is_some() {
        account.sentence(
            "The time is transformed, dt/dτ = ρ: steps are steps of τ, `t` is the physical time and `energy` the value of the \
             Hamiltonian. H is ρ times the Hamiltonian without `energy`, and 0 on the motion."
                .to_string(),
        );
    }
    let divisors = formulas.gauge.map_or_else(Vec::new, |gauge| divisors(emitter, gauge));
    if !divisors.is_empty() {
        account.sentence(format!(
            "F is divided by {}: it is no number where that is 0, and loses digits where that is small.",
            listed(&divisors)
        ));
    }
    account.observed(checked, &formulas.momenta, &formulas.events);
    let coordinate = |coordinate: &_| print_coordinate(coordinate, emitter.model);
    account.derived(&programs.one_form.statements, |_, entry| format!("α_{}", coordinate(entry)));
    account.derived(&programs.hamiltonian_gradient.statements, |_, entry| {
        let force = beside_force(emitter, &programs.shared, '−', entry);
        format!("∂H/∂{}{force}", coordinate(entry))
    });
    let krate = emitter.krate();
    let time = programs.time.as_ref().map(|_| {
        quote! {
            #[inline]
            fn time_transform(
                &self, __q: &[__T],
            ) -> ::core::option::Option<#krate::system::TimeTransform<__T>> {
                ::core::option::Option::Some(
                    <Self as #krate::TimeTransformed<__T>>::time_transform_at(self, __q)
                )
            }
        }
    });
    let members = quote! {
        #[inline]
        fn energy(&self, __q: &[__T], __v: &[__T], __t: __T) -> __T {
            <Self as #krate::DegenerateLagrangian<__T>>::hamiltonian(self, __q, __t)
        }
        #time
    };
    super::system(&account, &members, &implementation(emitter, programs, structure))
}

/// The parameters in denominators of a function in which neither coordinates stand nor the time.
fn divisors(emitter: &Emitter<'_>, function: Expr) -> Vec<String> {
    let graph = emitter.graph;
    let mut names = Vec::new();
    for id in graph.reachable([function.node]) {
        let Node::Reciprocal(of) = *graph.node(id) else { continue };
        if graph.depends(of, Node::varies) {
            continue;
        }
        for below in graph.reachable([of]) {
            if let Node::Parameter(parameter) = graph.node(below) {
                let name = emitter.model.parameters[parameter.field as usize].text.clone();
                if !names.contains(&name) {
                    names.push(name);
                }
            }
        }
    }
    names
}

/// The implementation of `DegenerateLagrangian`.
fn implementation(emitter: &Emitter<'_>, programs: &DegeneratePrograms, structure: &OneForm) -> TokenStream {
    let krate = emitter.krate();
    let OneForm { linear, matching, canonical, .. } = *structure;
    let hamiltonian = emitter.value(&programs.hamiltonian);
    let hamiltonian_gradient = emitter.vector(&programs.hamiltonian_gradient);
    let one_form = emitter.vector(&programs.one_form);
    let flow_source = emitter.vector(&programs.flow_source);
    let jacobian = emitter.function(&programs.one_form_jacobian, &emitter.offsets());
    let conjugate_entries = emitter.vector(&programs.conjugate_entries);
    let [conjugate, conjugates_end] = conjugates(emitter, structure);
    let nothing = super::nothing(krate);
    let gradients = programs.momentum_gradients.iter().map(|gradient| emitter.vector(gradient));
    let gradients = by_index(gradients, &quote!(__vector.fill(#nothing)));
    let suited = suited();
    let items = quote! {
            #suited
            const AFFINE: ::core::primitive::bool = #linear;
            const MATCHING: ::core::primitive::bool = #matching;
            const CANONICAL: ::core::primitive::bool = #canonical;

            #[inline]
            fn hamiltonian(&self, __q: &[__T], __t: __T) -> __T { #hamiltonian }
            #ForceInline
            fn hamiltonian_gradient(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                #hamiltonian_gradient
            }
            #[inline]
            fn one_form(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) { #one_form }
            #ForceInline
            fn flow_source(&self, __q: &[__T], __t: __T, __vector: &mut [__T]) {
                #flow_source
            }
            #[inline]
            fn one_form_jacobian<__K: #krate::Sink<__T>>(
                &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __sink: &mut __K,
            ) {
                #jacobian
            }
            #ForceInline
            fn conjugate_entries(
                &self, __q: &[__T], __t: __T, __a: __T, __b: __T, __vector: &mut [__T],
            ) {
                #conjugate_entries
            }
            #ForceInline
            fn conjugate(&self, __i: ::core::primitive::usize) -> ::core::primitive::usize { #conjugate }
            #ForceInline
            fn conjugates_end(&self, __i: ::core::primitive::usize) -> ::core::primitive::usize { #conjugates_end }
            #[inline]
            fn momentum_gradient(
                &self, __index: ::core::primitive::usize, __q: &[__T], __t: __T, __vector: &mut [__T],
            ) {
                #gradients
            }
    };
    let lagrangian = in_numbers(emitter, &quote!(DegenerateLagrangian<__T>), &items);
    let proper = proper(emitter, &structure.class);
    let time_transformed = programs.time.as_ref().map(|time| time_transformed(emitter, time));
    let pairs = programs.pairs.as_ref().map(|sum| pairs(emitter, sum));
    quote!(#lagrangian #proper #time_transformed #pairs)
}

/// The implementation of `TimeTransformed`.
fn time_transformed(
    emitter: &Emitter<'_>,
    TimeTransform { rate, hamiltonian }: &TimeTransform<Routine>,
) -> TokenStream {
    let krate = emitter.krate();
    let [rate, hamiltonian] = [rate, hamiltonian].map(|routine| emitter.value(routine));
    let items = quote! {
        #[inline]
        fn time_transform_at(&self, __q: &[__T]) -> #krate::system::TimeTransform<__T> {
            #krate::system::TimeTransform { rate: { #rate }, hamiltonian: { #hamiltonian } }
        }
    };
    in_numbers(emitter, &quote!(TimeTransformed<__T>), &items)
}

/// The implementation of `ProperlyDegenerate`, or what says why there is none.
fn proper(emitter: &Emitter<'_>, class: &Class) -> TokenStream {
    let (krate, model) = (emitter.krate(), emitter.model);
    if class.is_proper {
        let (place, suited) = (place(emitter, class), suited());
        let items = quote! {
            #suited
            #ForceInline
            fn place(&self, __coordinate: ::core::primitive::usize) -> ::core::primitive::usize { #place }
        };
        return in_numbers(emitter, &quote!(ProperlyDegenerate<__T>), &items);
    }
    let components = class.names(model, true).join(", ");
    let message = format!(
        "one-step schemes need a half of the coordinates along which the one-form has no component, and that of `{}` \
         has components along {components}",
        model.item.ident
    );
    let advice = match &class.advice {
        _ if model.has_spinors() => {
            "unit vectors are in no such class: `Sigma::midpoint()` and `Gauss` keep their lengths".to_string()
        }
        Some(advice) => {
            format!("the motion is the same with the differential of a function added to the one-form: {advice}")
        }
        None => {
            "the motion is the same for α + dF with any function F, written `gauge = F`: choose F such that the \
             components along one half of the coordinates vanish, as in ½ (x dy - y dx) + d(½ x y) = x dy"
                .to_string()
        }
    };
    let (name, allow) = (&model.item.ident, super::allow());
    let lacking = format_ident!("{name}InClass");
    let mut generics = over_numbers(emitter);
    generics.make_where_clause().predicates.push(syn::parse_quote!(__T: #lacking));
    let items = quote! {
        type Suited<__M> = <__T as #lacking>::Suited<__M>;
        fn place(&self, __coordinate: ::core::primitive::usize) -> ::core::primitive::usize { __coordinate }
    };
    let refused = over(krate, model.named(), &generics, &quote!(ProperlyDegenerate<__T>), &items);
    quote! {
        #[diagnostic::on_unimplemented(
            message = #message,
            label = "takes systems of that class only",
            note = #advice,
            note = "`Gauss` and `Projected` step any degenerate system"
        )]
        #[allow(unreachable_pub)]
        pub trait #lacking {
            type Suited<__M>: #krate::system::Same<__M, As = __M>;
        }
        #allow
        #refused
    }
}

/// Block by block: `if i < end { return place of the first + i − offset }`.
fn place(emitter: &Emitter<'_>, class: &Class) -> TokenStream {
    let model = emitter.model;
    let mut places = [Index::default(), class.size(model, true)];
    let cases = (0..model.blocks.len()).map(|block| {
        let [start, end] = [block, block + 1].map(|block| emitter.index(&model.offset(block)));
        let [with, without] = [0, 1].map(|half| emitter.index(&places[half]));
        for (half, place) in places.iter_mut().enumerate() {
            *place = place.plus(&class.size_in(model, block, half == 0), 1);
        }
        let place = match &class.components[block] {
            Components::Block(true) => quote!(__coordinate - (#start) + (#with)),
            Components::Block(false) => quote!(__coordinate - (#start) + (#without)),
            Components::Entries(entries) => {
                let rank = |index: usize| entries[..index].iter().filter(|e| **e == entries[index]).count();
                let ranks = (0..entries.len()).map(rank);
                let size = entries.len();
                quote!({
                    const __HAS: [::core::primitive::bool; #size] = [#(#entries),*];
                    const __RANK: [::core::primitive::usize; #size] = [#(#ranks),*];
                    let __entry = __coordinate - (#start);
                    __RANK[__entry] + if __HAS[__entry] { #with } else { #without }
                })
            }
        };
        quote!(if __coordinate < #end { return #place; })
    });
    let cases: Vec<TokenStream> = cases.collect();
    quote!(#(#cases)* __coordinate)
}

/// Block by block: `if i < end { return i − offset + conjugate's offset }` and `if i < end { return end }`.
fn conjugates(emitter: &Emitter<'_>, structure: &OneForm) -> [TokenStream; 2] {
    let offset = |block| emitter.index(&emitter.model.offset(block));
    let ends = (0..emitter.model.blocks.len()).map(|block| {
        let end = offset(block + 1);
        quote!(if __i < #end { return #end; })
    });
    let cases = structure.conjugates.iter().enumerate().map(|(block, conjugate)| {
        let [end, from, to] = [block + 1, block, *conjugate].map(offset);
        quote!(if __i < #end { return __i - (#from) + (#to); })
    });
    [quote!(#(#cases)* __i), quote!(#(#ends)* __i + 1)]
}
