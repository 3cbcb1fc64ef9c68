//! From the text of a system to what the macro makes of it.

use std::collections::HashMap;
use std::rc::Rc;

use proc_macro2::{TokenStream, TokenTree};

use super::functions::{OWN, SCALAR_FIELDS, ScalarField, own, own_third, scalar_field_derivative};
use super::rust::{Environment, Expansion, Nested};
use super::system::{Field, SizeKind, System};
use super::write::ONE;
use crate::expand::{degenerate_lagrangian, lagrangian};

/// What the macro makes of a system.
pub(super) fn tokens(system: &System) -> TokenStream {
    let parse = |text: String| match text.parse::<TokenStream>() {
        Ok(tokens) => tokens,
        Err(error) => panic!("{text} is no Rust: {error}"),
    };
    let macro_of = if system.is_regular() { lagrangian } else { degenerate_lagrangian };
    macro_of(parse(system.attribute()), parse(system.item()))
}

/// The expansion of a system, or the messages with which it is refused.
pub(super) fn expand(system: &System) -> Result<Expansion, Vec<String>> {
    let (tokens, mut messages) = (tokens(system), Vec::new());
    collect_messages(tokens.clone(), &mut messages);
    if messages.is_empty() { Ok(Expansion::new(tokens)) } else { Err(messages) }
}

/// The text of each `compile_error!`, and what the self-check says of itself in the documentation where it
/// is more than rounding: what a rule loses in digits is.
fn collect_messages(tokens: TokenStream, messages: &mut Vec<String>) {
    let mut after = false;
    for token in tokens {
        match token {
            TokenTree::Ident(name) => after = name == "compile_error",
            TokenTree::Group(group) if after => messages.push(group.stream().to_string()),
            TokenTree::Group(group) => collect_messages(group.stream(), messages),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                let Some((_, bound)) = text.split_once("formulas as written, to ") else { continue };
                let bound = bound.split(' ').next().and_then(|bound| bound.parse().ok());
                if !bound.is_some_and(|bound: f64| bound <= 1e-14) {
                    messages.push(format!("the self-check agrees to {bound:?} only"));
                }
            }
            TokenTree::Punct(_) => {}
        }
    }
}

/// The kinds of messages that a system of the generator may be refused with, by a part of their text.
///
/// The generator writes formulas without looking at what cancels in them.
const EXPECTED: &[&str] = &[
    // What is divided by, or all that has a velocity, may cancel.
    "division by zero",
    "so the mass matrix",
    "the mass matrix ∂²L/∂v∂v is singular",
    "the mass matrix ∂²L/∂v∂v of this Lagrangian is zero",
    "so its mass matrix ∂²L/∂v∂v is zero",
    "mentions no velocity",
    // Which ranges are bounded how well is a matter of its own; what must compile is among the systems
    // by hand.
    "this index reaches",
    "Ω",
    "the value of this is not a finite number",
    // The coordinates of a gauge may cancel.
    "a gauge without coordinates in it changes nothing",
    "no gauge was found that brings the one-form into the class of one-step schemes",
    // Of the user's functions, one is declared with its third derivative.
    "declare its third derivative too",
    "stands in a gauge",
    // The coordinates or velocities of a constraint may cancel.
    "no coordinate stands in this constraint",
    "no velocity `dot(x)` stands in this constraint, or none is left",
    "this constraint is declared twice, up to a factor",
    "no coordinate stands in this gap",
    "this gap is declared twice, up to a factor",
    "cannot be independent of each other",
    "no velocity `dot(x)` stands in this dissipation function, or none is left",
    // It may come out as a constant.
    "a time transformation is positive",
];

/// The expected kind of a message.
pub(super) fn refusal(message: &str) -> Option<&'static str> {
    EXPECTED.iter().find(|part| message.contains(**part)).copied()
}

/// The struct as a value, and the paths that its formulas name.
pub(super) fn environment(system: &System) -> Environment {
    let mut fields: HashMap<String, Rc<Nested>> =
        system.fields.iter().map(|field| (field.name.to_string(), nested(system, field))).collect();
    fields.extend(system.has_grids().then(|| (ONE.to_string(), Rc::new(Nested::Count(1)))));
    let mut constants = HashMap::new();
    for size in &system.sizes {
        match size.kind {
            SizeKind::Constant(name) => {
                constants.insert(name.to_string(), size.value as usize);
            }
            SizeKind::Field(name) => {
                fields.insert(name.to_string(), Rc::new(Nested::Count(size.value as usize)));
            }
            SizeKind::Literal | SizeKind::Length(_) | SizeKind::Product(..) => {}
        }
    }
    Environment { fields, constants, own: own_by_path, scalar_field: scalar_field_by_place }
}

fn nested(system: &System, field: &Field) -> Rc<Nested> {
    let lengths: Vec<usize> = field.shape.iter().map(|size| system.sizes[*size].value as usize).collect();
    nest(&field.values, &lengths)
}

fn nest(values: &[f64], lengths: &[usize]) -> Rc<Nested> {
    Rc::new(match lengths {
        [] => Nested::Number(values[0]),
        [length, inner @ ..] => {
            let rows = values.chunks(values.len() / length);
            Nested::List(rows.map(|row| nest(row, inner)).collect())
        }
    })
}

fn scalar_field_by_place(place: &str, axes: &[usize], at: &[f64]) -> f64 {
    let is_it = |field: &ScalarField| match field.path {
        Some(path) => path == place,
        None => place.strip_prefix("self.") == Some(field.name),
    };
    let field = SCALAR_FIELDS.iter().position(is_it).unwrap_or_else(|| panic!("no function {place}"));
    scalar_field_derivative(field, axes, at)
}

fn own_by_path(path: &str, x: f64) -> f64 {
    let places = OWN.iter().enumerate().flat_map(|(function, (_, paths))| {
        paths.iter().enumerate().map(move |(order, path)| (function, order, *path))
    });
    let mut known = places.filter(|(.., known)| *known == path);
    let (function, order, _) = known.next().unwrap_or_else(|| panic!("no function {path} was declared"));
    if order == 3 { own_third(x) } else { own(function, x)[order] }
}
