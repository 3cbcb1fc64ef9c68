//! Tokens in pieces, each of which is parsed.
//!
//! Arguments are cut at the top-level commas first and parsed one by one, so that a mistake in one of
//! them leaves the others readable.

use proc_macro2::{Delimiter, Group, Ident, Spacing, Span, TokenStream, TokenTree};
use syn::Expr;
use syn::parse::{Parse, ParseStream, Parser};
use syn::visit_mut::VisitMut as _;

use super::declared::Named;
use super::elsewhere::mistaken;
use super::tidy::Ungrouped;
use crate::errors::Errors;

pub(super) fn named(tokens: TokenStream, kind: &str, errors: &mut Errors) -> Vec<Named> {
    let pieces = split_at_commas(tokens).into_iter();
    pieces.filter_map(|piece| errors.taken(read_by(piece, |input| Named::parse(input, kind)))).collect()
}

pub(super) fn list<T: Parse>(tokens: TokenStream, errors: &mut Errors, lost: &mut bool) -> Vec<T> {
    let before = errors.count();
    let pieces = split_at_commas(tokens).into_iter();
    let items = pieces.filter_map(|piece| errors.taken(read(piece))).collect();
    *lost |= errors.count() > before;
    items
}

pub(super) fn value_of(name: &Ident, tokens: TokenStream, errors: &mut Errors) -> Option<Expr> {
    if tokens.is_empty() {
        errors.push(name, format!("`{name} =` has no value"));
        return None;
    }
    errors.taken(read_by(tokens, expression))
}

/// With what macros have put into it in its place.
pub(super) fn expression(input: ParseStream<'_>) -> syn::Result<Expr> {
    let mut expression = input.parse()?;
    Ungrouped.visit_expr_mut(&mut expression);
    Ok(expression)
}

pub(super) fn read<T: Parse>(tokens: TokenStream) -> syn::Result<T> {
    read_by(tokens, T::parse)
}

/// Parses all of the tokens. What is missing at their end is reported on the last of them; a parser
/// left to itself would report it on the whole attribute.
pub(super) fn read_by<T>(
    tokens: TokenStream,
    parser: impl FnOnce(ParseStream<'_>) -> syn::Result<T>,
) -> syn::Result<T> {
    let last = tokens.clone().into_iter().last().map_or_else(Span::call_site, |token| token.span());
    let mut group = Group::new(Delimiter::Parenthesis, tokens.clone());
    group.set_span(last);
    let all = |input: ParseStream<'_>| {
        let content;
        syn::parenthesized!(content in input);
        let value = parser(&content).map_err(|error| {
            let ended = error.to_string().starts_with("unexpected end of input");
            if ended { syn::Error::new(error.span(), "something is missing after this") } else { error }
        })?;
        if content.is_empty() {
            Ok(value)
        } else {
            Err(content.error("expected an operator, `*` for a product, or `,`"))
        }
    };
    all.parse2(TokenTree::Group(group).into()).map_err(|error| mistaken(tokens).unwrap_or(error))
}

/// Commas inside of brackets are inside of token trees and do not count; nor do those between the
/// bars of a closure.
pub(super) fn split_at_commas(tokens: TokenStream) -> Vec<TokenStream> {
    let mut pieces = Vec::new();
    let mut piece = TokenStream::new();
    let mut in_bars = false;
    // Behind a value, a bar is an operator, and so is one joined to it in `||`.
    let mut behind_value = false;
    let mut joined = false;
    for token in tokens {
        let is_bar = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '|');
        let is_operator = is_bar && !in_bars && (behind_value || joined);
        joined =
            is_operator && !joined && matches!(&token, TokenTree::Punct(p) if p.spacing() == Spacing::Joint);
        match &token {
            TokenTree::Punct(_) if is_operator => {}
            TokenTree::Punct(_) if is_bar => in_bars = !in_bars,
            TokenTree::Punct(punct) if punct.as_char() == ',' && !in_bars => {
                pieces.push(std::mem::take(&mut piece));
                behind_value = false;
                continue;
            }
            _ => {}
        }
        behind_value = !in_bars && !matches!(&token, TokenTree::Punct(_));
        piece.extend([token]);
    }
    if !piece.is_empty() {
        pieces.push(piece);
    }
    pieces
}
