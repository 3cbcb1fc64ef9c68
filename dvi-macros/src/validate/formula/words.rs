//! Literals, constants and names of the text.

use quote::ToTokens;
use syn::{Expr, Lit, Pat};

use super::{unknown, written};

pub(super) fn literal_number(literal: &Lit) -> f64 {
    let value = match literal {
        Lit::Float(value) => value.base10_parse(),
        Lit::Int(value) => value.base10_digits().parse().map_err(|_| syn::Error::new(value.span(), "")),
        _ => unknown(literal),
    };
    value.unwrap_or_else(|_| unknown(literal))
}

pub(super) fn exponent(syntax: &Expr) -> i32 {
    match syntax {
        Expr::Paren(inner) => exponent(&inner.expr),
        Expr::Unary(unary) => -exponent(&unary.expr),
        Expr::Lit(syn::ExprLit { lit: Lit::Int(value), .. }) => {
            value.base10_parse().unwrap_or_else(|_| unknown(syntax))
        }
        _ => unknown(syntax),
    }
}

/// The text of a place, which may begin with `self`.
pub(super) fn place_text(syntax: &Expr) -> String {
    let text = written(syntax);
    text.strip_prefix("self.").map_or(text.clone(), ToString::to_string)
}

pub(super) fn pattern(pattern: &Pat) -> String {
    match pattern {
        Pat::Type(typed) => self::pattern(&typed.pat),
        other => other.to_token_stream().to_string(),
    }
}

#[rustfmt::skip]
pub(super) fn constant(text: &str) -> Option<f64> {
    use std::f64::consts;
    let name = ["std::f64::consts::", "core::f64::consts::", "::std::f64::consts::", "::core::f64::consts::"]
        .iter()
        .find_map(|prefix| text.strip_prefix(prefix))
        .unwrap_or(text);
    let value = match name {
        "PI"        => consts::PI,
        "TAU"       => consts::TAU,
        "E"         => consts::E,
        "SQRT_2"    => consts::SQRT_2,
        "LN_2"      => consts::LN_2,
        "LN_10"     => consts::LN_10,
        "FRAC_PI_2" => consts::FRAC_PI_2,
        "FRAC_1_PI" => consts::FRAC_1_PI,
        _ => return None,
    };
    Some(value)
}
