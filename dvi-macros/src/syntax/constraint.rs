//! Holonomic constraints g(q, t) = 0, as they are declared.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::{BinOp, Expr, Lit, Token};

use crate::errors::text;

/// `constraint = g`, an entry of `constraint = [g, …]`, or `constraint(i in 0..n) = g`.
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

/// How a family is written.
const FAMILY: &str = "`constraint(i in 0..n) = g(i)`";

impl Parse for Family {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let advice = format!("a family of constraints is written {FAMILY}");
        let at = input.span();
        let index: Ident = input.parse().map_err(|_| syn::Error::new(at, &advice))?;
        if input.is_empty() {
            let message = format!(
                "a constraint holds for the whole system, not for `{index}` alone: write `constraint = g(q, t)`; one for \
                 each value of an index is {FAMILY}"
            );
            return Err(syn::Error::new(index.span(), message));
        }
        if !input.peek(Token![in]) {
            return Err(input.error(advice));
        }
        input.parse::<Token![in]>()?;
        let range = input.parse()?;
        if !input.is_empty() {
            return Err(input.error(format!("a family of constraints has one index, {FAMILY}")));
        }
        Ok(Self { index, range })
    }
}

impl Constraint {
    /// The constraints of `constraint = …`, and what is wrong with the others.
    pub(super) fn of_value(value: Expr) -> Vec<syn::Result<Self>> {
        match value {
            Expr::Array(list) if list.elems.is_empty() => {
                let message =
                    "there is no constraint in this list: write `constraint = [g1, g2]`, or leave it out";
                vec![Err(syn::Error::new_spanned(list, message))]
            }
            Expr::Array(list) => {
                list.elems.into_iter().map(|formula| Self::of_formula(None, formula)).collect()
            }
            formula => vec![Self::of_formula(None, formula)],
        }
    }

    /// A constraint with this formula, if it may be one.
    pub(super) fn of_formula(family: Option<Family>, formula: Expr) -> syn::Result<Self> {
        let refused = |at: &dyn ToTokens, message: String| Err(syn::Error::new_spanned(at, message));
        match unwrapped(&formula) {
            Expr::Assign(equation) => {
                refused(&equation.eq_token, one_side(&family, &equation.left, &equation.right))
            }
            Expr::Binary(binary) => match binary.op {
                BinOp::Eq(_) => refused(&binary.op, one_side(&family, &binary.left, &binary.right)),
                BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) | BinOp::Ne(_) => {
                    let message = "a holonomic constraint is an equation g(q, t) = 0, of which g is written: no inequality is \
                                   one";
                    refused(&binary.op, message.to_string())
                }
                _ => Ok(Self { family, formula }),
            },
            Expr::Closure(closure) => {
                refused(closure, format!("one constraint for each value of an index is written {FAMILY}"))
            }
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
fn one_side(family: &Option<Family>, left: &Expr, right: &Expr) -> String {
    let head = match family {
        Some(Family { index, range }) => format!("constraint({index} in {})", text(range)),
        None => "constraint".to_string(),
    };
    let left = text(left);
    let all = match right {
        right if is_zero(right) => left,
        Expr::Binary(sum) if matches!(sum.op, BinOp::Add(_) | BinOp::Sub(_)) => {
            format!("{left} - ({})", text(right))
        }
        right => format!("{left} - {}", text(right)),
    };
    format!("a constraint is g(q, t) = 0, of which g is written: bring all to one side, `{head} = {all}`")
}

fn is_zero(value: &Expr) -> bool {
    let Expr::Lit(literal) = value else { return false };
    match &literal.lit {
        Lit::Int(value) => value.base10_digits() == "0",
        Lit::Float(value) => value.base10_parse::<f64>().is_ok_and(|value| value == 0.0),
        _ => false,
    }
}
