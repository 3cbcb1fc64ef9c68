//! Constraints of the positions, g(q, t) = 0, and of the velocities, a(q, v, t) = 0, as they are declared.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::parse::ParseStream;
use syn::{BinOp, Expr, Lit, Token};

use super::{Attribute, Kind, Value, form_of, read_by, value_of};
use crate::errors::{Errors, text};

/// What the constraints of a system are functions of; the word of the argument says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Constrained {
    /// `constraint`: g(q, t) = 0.
    Positions,
    /// `nonholonomic`: a(q, v, t) = A(q, t) v + b(q, t) = 0.
    Velocities,
}

/// Words for what is a constraint.
const CONSTRAINTS: [&str; 10] = [
    "algebraic",
    "bond",
    "bonds",
    "constrain",
    "constrained",
    "constraints",
    "equality",
    "holonomic",
    "rod",
    "rods",
];

/// Words for what is a constraint of the velocities.
const VELOCITY_CONSTRAINTS: [&str; 10] = [
    "anholonomic",
    "no_slip",
    "non_holonomic",
    "nonholonomic_constraint",
    "nonholonomic_constraints",
    "rolling",
    "slip",
    "velocity_constraint",
    "velocity_constraints",
    "without_slip",
];

/// `constraint = g`, an entry of `constraint = [g, …]`, or `constraint(i in 0..n) = g`; or the same by `nonholonomic`.
#[derive(Debug)]
pub(crate) struct Constraint {
    pub(crate) family: Option<Family>,
    pub(crate) formula: Expr,
}

/// `i in 0..n`: the constraints of a family, one for each value of its index.
#[derive(Debug)]
pub(crate) struct Family {
    pub(crate) index: Ident,
    pub(crate) range: Expr,
}

impl Constrained {
    const ALL: [Self; 2] = [Self::Positions, Self::Velocities];

    /// What is constrained by an argument of this name, or of one like it.
    pub(super) fn named_like(name: &str) -> Option<Self> {
        let declares = |of: &Self| {
            let others = match of {
                Self::Positions => CONSTRAINTS,
                Self::Velocities => VELOCITY_CONSTRAINTS,
            };
            name == of.word() || others.contains(&name)
        };
        Self::ALL.into_iter().find(declares)
    }

    /// What is constrained by an argument of this very name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.word() == name)
    }

    /// The word that declares such constraints.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Positions => "constraint",
            Self::Velocities => "nonholonomic",
        }
    }

    /// What such a constraint is called.
    pub(crate) fn adjective(self) -> &'static str {
        match self {
            Self::Positions => "holonomic",
            Self::Velocities => "nonholonomic",
        }
    }

    /// The function that is zero.
    pub(crate) fn letter(self) -> &'static str {
        match self {
            Self::Positions => "g",
            Self::Velocities => "a",
        }
    }

    /// That function of its variables.
    pub(crate) fn function(self) -> &'static str {
        match self {
            Self::Positions => "g(q, t)",
            Self::Velocities => "a(q, v, t)",
        }
    }

    /// How a family is written.
    pub(super) fn family(self) -> String {
        format!("`{}(i in 0..n) = {}(i)`", self.word(), self.letter())
    }
}

impl Attribute {
    /// The constraints of an argument whose name says that it declares some.
    pub(super) fn accept_constraints(
        &mut self,
        of: Constrained,
        name: &Ident,
        value: Value,
        errors: &mut Errors,
    ) {
        if self.kind == Kind::Degenerate {
            let reason = match of {
                Constrained::Positions => {
                    "the coordinates of a degenerate one are to be chosen so that they hold"
                }
                Constrained::Velocities => {
                    "the velocities of a degenerate one are what its equations of motion make of the positions"
                }
            };
            let (adjective, regular) = (of.adjective(), Kind::Regular.attribute());
            let message =
                format!("{adjective} constraints are for regular systems, in `{regular}`: {reason}");
            errors.push_once("constraints", name, message);
            return;
        }
        let (word, function, letter) = (of.word(), of.function(), of.letter());
        let before = *self.constrained.get_or_insert(of);
        if name != word {
            let message = format!(
                "unknown argument `{name}`; a constraint{} is written `{word} = {function}`, and more of them \
                 `{word} = [{letter}1, {letter}2]`, or {}",
                if of == Constrained::Velocities { " of the velocities" } else { "" },
                of.family()
            );
            errors.push(name, message);
            return;
        }
        if before != of {
            let message = format!(
                "a system has constraints of one kind, and those before this one are declared by `{}`: choose the coordinates \
                 so that the constraints of the positions hold, or declare their rates of change by `{} = …` too",
                before.word(),
                Constrained::Velocities.word()
            );
            errors.push_once("constraints of two kinds", name, message);
            return;
        }
        match value {
            Value::Assigned(tokens) => {
                if let Some(value) = value_of(name, tokens, errors) {
                    let declared = Constraint::of_value(of, value);
                    self.constraints.extend(declared.into_iter().filter_map(|one| errors.taken(one)));
                }
            }
            Value::AssignedTo { of: index, value, parentheses } => {
                let family = if index.is_empty() {
                    let message = format!("a family of constraints is written {}", of.family());
                    Err(syn::Error::new(parentheses, message))
                } else {
                    read_by(index, |input| Family::parse(input, of))
                };
                let formula = value_of(name, value, errors);
                if let Some((family, formula)) = errors.taken(family).zip(formula) {
                    let declared = Constraint::of_formula(of, Some(family), formula);
                    self.constraints.extend(errors.taken(declared));
                }
            }
            Value::List(_) | Value::Neither => {
                errors.push(name, format!("`{word}` is written `{}`", form_of(word)));
            }
        }
    }
}

impl Family {
    pub(super) fn parse(input: ParseStream<'_>, of: Constrained) -> syn::Result<Self> {
        let (form, word, function) = (of.family(), of.word(), of.function());
        let advice = format!("a family of constraints is written {form}");
        let at = input.span();
        let index: Ident = input.parse().map_err(|_| syn::Error::new(at, &advice))?;
        if input.is_empty() {
            let message = format!(
                "a constraint holds for the whole system, not for `{index}` alone: write `{word} = {function}`; one for \
                 each value of an index is {form}"
            );
            return Err(syn::Error::new(index.span(), message));
        }
        if !input.peek(Token![in]) {
            return Err(input.error(advice));
        }
        input.parse::<Token![in]>()?;
        let range = input.parse()?;
        if !input.is_empty() {
            return Err(input.error(format!("a family of constraints has one index, {form}")));
        }
        Ok(Self { index, range })
    }
}

impl Constraint {
    /// The constraints of `constraint = …` or `nonholonomic = …`, and what is wrong with the others.
    pub(super) fn of_value(of: Constrained, value: Expr) -> Vec<syn::Result<Self>> {
        match value {
            Expr::Array(list) if list.elems.is_empty() => {
                let (word, letter) = (of.word(), of.letter());
                let message = format!(
                    "there is no constraint in this list: write `{word} = [{letter}1, {letter}2]`, or leave it out"
                );
                vec![Err(syn::Error::new_spanned(list, message))]
            }
            Expr::Array(list) => {
                list.elems.into_iter().map(|formula| Self::of_formula(of, None, formula)).collect()
            }
            formula => vec![Self::of_formula(of, None, formula)],
        }
    }

    /// A constraint with this formula, if it may be one.
    pub(super) fn of_formula(of: Constrained, family: Option<Family>, formula: Expr) -> syn::Result<Self> {
        let refused = |at: &dyn ToTokens, message: String| Err(syn::Error::new_spanned(at, message));
        match unwrapped(&formula) {
            Expr::Assign(equation) => {
                refused(&equation.eq_token, one_side(of, &family, &equation.left, &equation.right))
            }
            Expr::Binary(binary) => match binary.op {
                BinOp::Eq(_) => refused(&binary.op, one_side(of, &family, &binary.left, &binary.right)),
                BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
                    let message = format!(
                        "a {} constraint is an equation {} = 0, of which {} is written: no inequality is one",
                        of.adjective(),
                        of.function(),
                        of.letter()
                    );
                    refused(&binary.op, message)
                }
                _ => Ok(Self { family, formula }),
            },
            Expr::Closure(closure) => refused(
                closure,
                format!("one constraint for each value of an index is written {}", of.family()),
            ),
            Expr::Array(list) => {
                let message = match family {
                    Some(_) => "a family of constraints has one formula: write a family for each of these",
                    None => "a list of constraints holds formulas: write them without these brackets",
                };
                refused(list, message.to_string())
            }
            _ => Ok(Self { family, formula }),
        }
    }
}

/// An expression without the parentheses around it.
fn unwrapped(formula: &Expr) -> &Expr {
    match formula {
        Expr::Paren(inner) => unwrapped(&inner.expr),
        Expr::Group(inner) => unwrapped(&inner.expr),
        other => other,
    }
}

/// What to write for the equation left = right.
fn one_side(of: Constrained, family: &Option<Family>, left: &Expr, right: &Expr) -> String {
    let head = match family {
        Some(Family { index, range }) => format!("{}({index} in {})", of.word(), text(range)),
        None => of.word().to_string(),
    };
    let left = text(left);
    let all = match right {
        right if is_zero(right) => left,
        Expr::Binary(sum) if matches!(sum.op, BinOp::Add(_) | BinOp::Sub(_)) => {
            format!("{left} - ({})", text(right))
        }
        right => format!("{left} - {}", text(right)),
    };
    let (function, letter) = (of.function(), of.letter());
    format!(
        "a constraint is {function} = 0, of which {letter} is written: bring all to one side, `{head} = {all}`"
    )
}

fn is_zero(value: &Expr) -> bool {
    let Expr::Lit(literal) = value else { return false };
    match &literal.lit {
        Lit::Int(value) => value.base10_digits() == "0",
        Lit::Float(value) => value.base10_parse::<f64>().is_ok_and(|value| value == 0.0),
        _ => false,
    }
}
