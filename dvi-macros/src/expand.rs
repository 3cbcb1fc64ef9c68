//! The whole story of one attribute: parse, resolve, lower, differentiate, emit.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Expr as Syntax, Item, ItemStruct};

use crate::emit::Emitter;
use crate::errors::Errors;
use crate::implement::{self, Implementation};
use crate::lower::{Lowering, Role};
use crate::model::Model;
use crate::program::{Formulas, Programs};
use crate::structure::{self, Structure};
use crate::symbolic::{Expr, Graph, Node};
use crate::syntax::{Attribute, depth, parse_attribute};

mod stand_in;

use stand_in::stand_in;

pub(crate) fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let item = match read_item(item) {
        Ok(item) => item,
        Err(refused) => return refused,
    };
    let mut errors = Errors::default();
    let mut attribute = parse_attribute(attribute, &mut errors);
    let mut model = Model::new(&mut attribute, item, &mut errors);
    let mut graph = Graph::new();
    let formulas = lower(&attribute, &mut graph, &mut model, &mut errors);
    let (programs, structure) = match formulas.filter(|_| errors.is_empty()) {
        Some(formulas) => {
            let form_entries = graph.hessian(formulas.one_form);
            let structure = structure::analyse(&mut graph, &model, &form_entries);
            structure.check(&model, attribute.symplectic_part(), &mut errors);
            let programs = Programs::new(&mut graph, &formulas, &form_entries, structure.canonical);
            (Some((formulas, programs)), structure)
        }
        None => (None, Structure::default()),
    };
    let emitter = Emitter { graph: &graph, model: &model };
    match programs {
        Some((formulas, programs)) if errors.is_empty() => {
            implemented(&emitter, &attribute, &formulas, &programs, &structure)
        }
        _ => stand_in(&emitter, errors),
    }
}

/// The struct, or what to emit in place of a system: the item as it is, with an error.
fn read_item(item: TokenStream) -> Result<ItemStruct, TokenStream> {
    let advice =
        "`#[degenerate_lagrangian]` stands on a struct whose fields are the parameters of the system";
    let parsed = depth::check(&item).and_then(|()| syn::parse2::<Item>(item.clone()));
    let mut errors = Errors::default();
    let replaced = match parsed {
        Ok(Item::Struct(item)) => return Ok(item),
        Ok(Item::Enum(other)) => {
            errors.push(other.enum_token, advice);
            stand_in::without_struct(&other.vis, &other.ident, &other.generics, errors)
        }
        Ok(Item::Union(other)) => {
            errors.push(other.union_token, advice);
            stand_in::without_struct(&other.vis, &other.ident, &other.generics, errors)
        }
        Ok(other) => {
            errors.push(other, advice);
            errors.into_tokens()
        }
        Err(error) => {
            errors.push_syn(error);
            errors.into_tokens()
        }
    };
    Err(quote!(#item #replaced))
}

/// α·v, H and the momenta as expressions; reports everything that is missing or wrong.
fn lower(
    attribute: &Attribute,
    graph: &mut Graph,
    model: &mut Model,
    errors: &mut Errors,
) -> Option<Formulas> {
    let name = model.item.ident.clone();
    if attribute.coordinates.is_empty() && errors.is_empty() {
        errors.push(
            &name,
            "no coordinates: write `coordinates(x, y)`, or `coordinates(x[N], y[N])` for arrays",
        );
    }
    // Formulas over coordinates that could not be read would only repeat that error.
    if model.blocks.is_empty() {
        return None;
    }
    let clean = errors.is_empty();
    let mut lowering = Lowering::new(graph, model, errors);
    let pair = match (&attribute.lagrangian, &attribute.one_form, &attribute.hamiltonian) {
        (Some(lagrangian), None, None) => {
            let lagrangian = lowering.formula(lagrangian, Role::Lagrangian);
            lagrangian.map(|lagrangian| split(lowering.graph, lagrangian))
        }
        (None, Some(one_form), Some(hamiltonian)) => {
            let one_form = lower_one_form(&mut lowering, one_form);
            let hamiltonian = lowering.formula(hamiltonian, Role::Hamiltonian);
            one_form.zip(hamiltonian)
        }
        (Some(_), one_form, hamiltonian) => {
            let second = one_form.as_ref().or(hamiltonian.as_ref());
            second.inspect(|second| {
                lowering
                    .errors
                    .push(second, "give either `lagrangian`, or `one_form` and `hamiltonian`, not both");
            });
            None
        }
        (None, one_form, hamiltonian) => {
            one_form.as_ref().and_then(|one_form| lower_one_form(&mut lowering, one_form));
            hamiltonian.as_ref().and_then(|hamiltonian| lowering.formula(hamiltonian, Role::Hamiltonian));
            if clean {
                let missing = match (one_form, hamiltonian) {
                    (Some(_), None) => "no Hamiltonian: write `hamiltonian = …`",
                    (None, Some(_)) => "no one-form: write `one_form = … * d(x) + …`",
                    _ => "no dynamics: write `one_form = …` and `hamiltonian = …`, or `lagrangian = …`",
                };
                lowering.errors.push(&name, missing);
            }
            None
        }
    };
    let momenta: Vec<Option<Expr>> = attribute
        .momenta
        .iter()
        .map(|momentum| lowering.formula(&momentum.formula, Role::Momentum))
        .collect();
    let momenta = momenta.into_iter().collect::<Option<Vec<Expr>>>()?;
    let (one_form, hamiltonian) = pair?;
    Some(Formulas { one_form, hamiltonian, momenta })
}

fn lower_one_form(lowering: &mut Lowering<'_>, one_form: &Syntax) -> Option<Expr> {
    match one_form {
        Syntax::Array(components) => lowering.components(components),
        _ => {
            let value = lowering.formula(one_form, Role::OneForm)?;
            let (stray, _) = split_parts(lowering.graph, value);
            if !stray.is_zero() {
                lowering
                    .errors
                    .push(one_form, "this one-form has no d(·): write `… * d(x)` for a coordinate x");
                return None;
            }
            Some(value)
        }
    }
}

/// L = α·v − H: −H is what is left at v = 0.
fn split(graph: &mut Graph, lagrangian: Expr) -> (Expr, Expr) {
    let (rest, one_form) = split_parts(graph, lagrangian);
    (one_form, rest.negated())
}

/// An affine expression as (its value at v = 0, what is linear in v).
fn split_parts(graph: &mut Graph, value: Expr) -> (Expr, Expr) {
    let at_rest = |graph: &mut Graph, id| matches!(graph.node(id), Node::Velocity(_)).then_some(Expr::ZERO);
    let rest = graph.rebuild(value.node, at_rest, Clone::clone).scaled(value.scale);
    let linear = match graph.node(value.node).clone() {
        // Term by term, so that what has no velocity disappears instead of being subtracted.
        Node::Sum(terms) => {
            let parts: Vec<Expr> = terms.iter().map(|term| split_parts(graph, *term).1).collect();
            graph.sum(&parts).scaled(value.scale)
        }
        _ if rest.is_zero() => value,
        _ => graph.subtract(value, rest),
    };
    (rest, linear)
}

fn implemented(
    emitter: &Emitter<'_>,
    attribute: &Attribute,
    formulas: &Formulas,
    programs: &Programs,
    structure: &Structure,
) -> TokenStream {
    let momenta: Vec<String> = attribute.momenta.iter().map(|momentum| momentum.name.to_string()).collect();
    let report = implement::report(emitter, formulas, programs, structure, &momenta);
    let documentation = implement::documentation(emitter, formulas, programs, structure, &momenta);
    let state = implement::state(emitter);
    let item = &emitter.model.item;
    let implementation = Implementation { emitter, programs, structure, state: &state, report }.tokens();
    let state = &state.item;
    quote! {
        #[doc = #documentation]
        #item
        #state
        #implementation
    }
}
