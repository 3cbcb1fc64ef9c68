//! Tokens to tree: the arguments of the attribute and the struct below it.
//!
//! Arguments are cut at the top-level commas first and parsed one by one, so that a mistake in one of
//! them leaves the others readable.

use proc_macro2::{TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Expr, Ident, Path, Token};

use crate::errors::{Errors, listed, nearest};

/// `x`, or `x[n]`.
#[derive(Debug)]
pub(crate) struct Declaration {
    pub(crate) name: Ident,
    pub(crate) size: Option<Expr>,
}

/// `name = formula` in `momenta(...)`.
#[derive(Debug)]
pub(crate) struct Momentum {
    pub(crate) name: Ident,
    pub(crate) formula: Expr,
}

/// `f = [path, path_of_derivative, …]` in `functions(...)`.
#[derive(Debug)]
pub(crate) struct Function {
    pub(crate) name: Ident,
    pub(crate) derivatives: Vec<Path>,
}

/// The arguments as written; what was not given is empty.
#[derive(Debug, Default)]
pub(crate) struct Attribute {
    pub(crate) coordinates: Vec<Declaration>,
    pub(crate) one_form: Option<Expr>,
    pub(crate) hamiltonian: Option<Expr>,
    pub(crate) lagrangian: Option<Expr>,
    pub(crate) momenta: Vec<Momentum>,
    pub(crate) functions: Vec<Function>,
    pub(crate) crate_path: Option<Path>,
}

const ARGUMENTS: [&str; 7] =
    ["coordinates", "one_form", "hamiltonian", "lagrangian", "momenta", "functions", "crate"];

impl Parse for Declaration {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        let size = if input.peek(syn::token::Bracket) {
            let content;
            syn::bracketed!(content in input);
            Some(content.parse()?)
        } else {
            None
        };
        Ok(Self { name, size })
    }
}

impl Parse for Momentum {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        input.parse::<Token![=]>()?;
        Ok(Self { name, formula: input.parse()? })
    }
}

impl Parse for Function {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = input.parse()?;
        input.parse::<Token![=]>()?;
        let content;
        syn::bracketed!(content in input);
        let derivatives = Punctuated::<Path, Token![,]>::parse_terminated(&content)?;
        Ok(Self { name, derivatives: derivatives.into_iter().collect() })
    }
}

/// One argument: its name, then `= value` or `(values)`.
struct Argument {
    name: Ident,
    value: Value,
}

enum Value {
    Assigned(TokenStream),
    List(TokenStream),
}

impl Parse for Argument {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = Ident::parse_any(input)?;
        let value = if input.peek(syn::token::Paren) {
            let content;
            syn::parenthesized!(content in input);
            Value::List(content.parse()?)
        } else {
            input.parse::<Token![=]>()?;
            Value::Assigned(input.parse()?)
        };
        if input.is_empty() { Ok(Self { name, value }) } else { Err(input.error("expected `,`")) }
    }
}

pub(crate) fn parse_attribute(tokens: TokenStream, errors: &mut Errors) -> Attribute {
    let mut attribute = Attribute::default();
    let mut given: Vec<String> = Vec::new();
    for piece in split_at_commas(tokens) {
        match syn::parse2::<Argument>(piece) {
            Ok(argument) => {
                let name = argument.name.to_string();
                if given.contains(&name) {
                    errors.push(&argument.name, format!("`{name}` is given twice"));
                }
                given.push(name);
                attribute.accept(argument, errors);
            }
            Err(error) => errors.push_syn(error),
        }
    }
    attribute
}

impl Attribute {
    fn accept(&mut self, argument: Argument, errors: &mut Errors) {
        let Argument { name, value } = argument;
        let keyword = name.to_string();
        match (keyword.as_str(), value) {
            ("coordinates", Value::List(tokens)) => self.coordinates = list(tokens, errors),
            ("momenta", Value::List(tokens)) => self.momenta = list(tokens, errors),
            ("functions", Value::List(tokens)) => self.functions = list(tokens, errors),
            ("one_form", Value::Assigned(tokens)) => self.one_form = value_of(&name, tokens, errors),
            ("hamiltonian", Value::Assigned(tokens)) => self.hamiltonian = value_of(&name, tokens, errors),
            ("lagrangian", Value::Assigned(tokens)) => self.lagrangian = value_of(&name, tokens, errors),
            ("crate", Value::Assigned(tokens)) => self.crate_path = value_of(&name, tokens, errors),
            ("coordinates" | "momenta" | "functions", Value::Assigned(_)) => {
                errors.push(&name, format!("`{keyword}` takes a list: write `{keyword}(...)`"));
            }
            ("one_form" | "hamiltonian" | "lagrangian" | "crate", Value::List(_)) => {
                errors.push(&name, format!("`{keyword}` takes a value: write `{keyword} = ...`"));
            }
            _ => {
                let hint = nearest(&keyword, ARGUMENTS).map_or_else(
                    || format!("the arguments are {}", listed(ARGUMENTS)),
                    |near| format!("did you mean `{near}`?"),
                );
                errors.push(&name, format!("unknown argument `{keyword}`; {hint}"));
            }
        }
    }
}

fn list<T: Parse>(tokens: TokenStream, errors: &mut Errors) -> Vec<T> {
    let parsed = split_at_commas(tokens).into_iter().map(|piece| syn::parse2::<T>(piece));
    parsed.filter_map(|item| item.map_err(|error| errors.push_syn(error)).ok()).collect()
}

fn value_of<T: Parse>(name: &Ident, tokens: TokenStream, errors: &mut Errors) -> Option<T> {
    if tokens.is_empty() {
        errors.push(name, format!("`{name} =` has no value"));
        return None;
    }
    T::parse.parse2(tokens).map_err(|error| errors.push_syn(error)).ok()
}

/// Commas inside of brackets are inside of token trees and do not count; nor do those between the
/// bars of a closure.
fn split_at_commas(tokens: TokenStream) -> Vec<TokenStream> {
    let mut pieces = Vec::new();
    let mut piece = TokenStream::new();
    let mut in_bars = false;
    for token in tokens {
        match &token {
            TokenTree::Punct(punct) if punct.as_char() == '|' => in_bars = !in_bars,
            TokenTree::Punct(punct) if punct.as_char() == ',' && !in_bars => {
                pieces.push(std::mem::take(&mut piece));
                continue;
            }
            _ => {}
        }
        piece.extend([token]);
    }
    if !piece.is_empty() {
        pieces.push(piece);
    }
    pieces
}
