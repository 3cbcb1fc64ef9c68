//! The whole story of each attribute: parse, resolve, lower, differentiate, emit.

use proc_macro2::{Span, TokenStream};
use quote::quote;
use syn::{Item, ItemStruct};

use crate::emit::Emitter;
use crate::errors::Errors;
use crate::implement;
use crate::internal::guarded;
use crate::lower::lints::warnings;
use crate::model::Model;
use crate::program::{DegeneratePrograms, RegularPrograms};
use crate::structure::{MassMatrix, OneForm, PairSum};
use crate::symbolic::Graph;
use crate::syntax::{Attribute, Kind, depth, parse_attribute, tidy};
use crate::validate::{self, Checked, Functions};

mod formulas;
mod names;
mod stand_in;

use stand_in::stand_in;

/// `#[degenerate_lagrangian]`
pub(crate) fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(Kind::Degenerate, attribute, item, |stages| {
        let formulas = stages.degenerate_formulas()?;
        let Stages { graph, model, attribute, errors } = stages;
        barrier(errors)?;
        let form_entries = graph.hessian(formulas.one_form);
        let structure = OneForm::new(graph, model, formulas.one_form, &form_entries, formulas.declared);
        structure.check(model, attribute.symplectic_part(), errors);
        barrier(errors)?;
        let canonical = structure.canonical;
        let pairs = PairSum::find(graph, model, formulas.hamiltonian);
        let mut programs =
            DegeneratePrograms::new(graph, &formulas, &form_entries, canonical, pairs.as_ref());
        programs.shared.add_seams(graph, &formulas.seams);
        let checked = stages.checked(&Functions::Degenerate(&programs, &structure))?;
        let Stages { graph, model, attribute, .. } = &*stages;
        let emitter = Emitter { graph, model };
        Some(implement::degenerate(&emitter, attribute, &formulas, &programs, &structure, &checked))
    })
}

/// `#[lagrangian]`
pub(crate) fn lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(Kind::Regular, attribute, item, |stages| {
        let formulas = stages.regular_formulas()?;
        let Stages { graph, model, attribute, errors } = stages;
        barrier(errors)?;
        let entries = graph.hessian(formulas.lagrangian);
        let structure = MassMatrix::new(graph, model, &formulas, &entries);
        structure.check(model, attribute.lagrangian.as_ref(), errors);
        barrier(errors)?;
        let is_free = formulas.constraints.is_none() && !model.is_on_manifold();
        let pairs = is_free.then(|| PairSum::in_lagrangian(graph, model, formulas.lagrangian)).flatten();
        let mut programs = RegularPrograms::new(graph, &formulas, entries, pairs.as_ref());
        programs.shared.add_seams(graph, &formulas.seams);
        let checked = stages.checked(&Functions::Regular(&programs, &structure))?;
        let Stages { graph, model, attribute, .. } = &*stages;
        let emitter = Emitter { graph, model };
        Some(implement::regular(&emitter, attribute, &formulas, &programs, &structure, &checked))
    })
}

/// What passes from stage to stage.
struct Stages {
    attribute: Attribute,
    model: Model,
    graph: Graph,
    errors: Errors,
}

/// Nothing passes once a mistake was found.
fn barrier(errors: &Errors) -> Option<()> {
    errors.is_empty().then_some(())
}

impl Stages {
    /// Nothing is printed that differs from the formulas.
    fn checked(&mut self, functions: &Functions<'_>) -> Option<Checked> {
        let checked = validate::check(&self.graph, &self.model, &self.attribute, functions);
        checked
            .map_err(|differs| self.errors.push_syn(syn::Error::new(Span::call_site(), differs.message())))
            .ok()
    }
}

/// The stages that both attributes share, and the `ending` of one of them: what it makes of the model, or
/// `None` if a mistake was found.
fn expand(
    kind: Kind,
    attribute: TokenStream,
    item: TokenStream,
    ending: impl FnOnce(&mut Stages) -> Option<TokenStream>,
) -> TokenStream {
    let renaming = names::renaming([&attribute, &item]);
    let item = match read_item(kind, tidy::names(item)) {
        Ok(item) => item,
        Err(refused) => return names::renamed(refused, &renaming),
    };
    let mut errors = Errors::default();
    let item = once(item, &mut errors);
    let mut attribute = parse_attribute(kind, attribute, &mut errors);
    let model = Model::new(&mut attribute, item, &mut errors);
    let block_sizes = (0..model.blocks.len()).map(|block| model.block_size(block)).collect();
    let mut stages = Stages { attribute, model, graph: Graph::new(block_sizes), errors };
    let system = guarded(|| ending(&mut stages)).unwrap_or_else(|mistake| {
        stages.errors.push_syn(syn::Error::new(Span::call_site(), mistake));
        None
    });
    let expanded = match system {
        Some(system) if stages.errors.is_empty() => {
            let warnings = warnings(&stages.attribute.shared, stages.attribute.scopes());
            quote!(#system #warnings)
        }
        _ => {
            let errors = std::mem::take(&mut stages.errors);
            let emitter = Emitter { graph: &stages.graph, model: &stages.model };
            stand_in(&emitter, stages.attribute.constrained, errors)
        }
    };
    names::renamed(expanded, &renaming)
}

/// The struct without the attributes that declare a second system on it.
fn once(mut item: ItemStruct, errors: &mut Errors) -> ItemStruct {
    let declares = |attribute: &syn::Attribute| {
        let name = attribute.path().segments.last().map(|last| &last.ident);
        name.is_some_and(|name| Kind::BOTH.iter().any(|kind| name == kind.name()))
    };
    for again in item.attrs.iter().filter(|attribute| declares(attribute)) {
        let message = format!(
            "`{}` is a system by the attribute above: a struct has one Lagrangian; write another struct \
             for this one",
            item.ident
        );
        errors.push(again.path(), message);
    }
    item.attrs.retain(|attribute| !declares(attribute));
    item
}

/// The struct, or what to emit in place of a system: the item as it is, with an error.
fn read_item(kind: Kind, item: TokenStream) -> Result<ItemStruct, TokenStream> {
    let advice =
        format!("`{}` stands on a struct whose fields are the parameters of the system", kind.attribute());
    let parsed = depth::check(&item, depth::LONGEST_TERM).and_then(|()| syn::parse2::<Item>(item.clone()));
    let mut errors = Errors::default();
    let replaced = match parsed {
        Ok(Item::Struct(item)) => return Ok(item),
        Ok(Item::Enum(other)) => {
            errors.push(other.enum_token, advice);
            stand_in::without_struct(kind, &other.vis, (&other.ident, &other.generics), errors)
        }
        Ok(Item::Union(other)) => {
            errors.push(other.union_token, advice);
            stand_in::without_struct(kind, &other.vis, (&other.ident, &other.generics), errors)
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
