//! One argument of an attribute, as far as it is read before its value.

use proc_macro2::{Ident, Span, TokenStream};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;

use super::{Constrained, Kind};
use crate::errors::listed;

/// One argument: its name, then `= value` or `(values)`.
pub(super) struct Argument {
    pub(super) name: Ident,
    pub(super) value: Value,
}

pub(super) enum Value {
    Assigned(TokenStream),
    List(TokenStream),
    /// `name(of) = value`
    AssignedTo {
        of: TokenStream,
        value: TokenStream,
        parentheses: Span,
    },
    Neither,
}

impl Argument {
    pub(super) fn parse(input: ParseStream<'_>, kind: Kind) -> syn::Result<Self> {
        let name = input.call(Ident::parse_any).map_err(|error| {
            let names = listed(kind.arguments());
            syn::Error::new(error.span(), format!("expected an argument; the arguments are {names}"))
        })?;
        let value = if input.peek(syn::token::Paren) {
            let content;
            let parentheses = syn::parenthesized!(content in input).span.join();
            let list = content.parse()?;
            if input.peek(Token![=]) && !input.peek(Token![==]) {
                input.parse::<Token![=]>()?;
                Value::AssignedTo { of: list, value: input.parse()?, parentheses }
            } else if input.is_empty() {
                Value::List(list)
            } else if name == "force" {
                return Err(input.error("a force is written `force(x) = …`"));
            } else if let Some(of) = Constrained::named(&name.to_string()) {
                return Err(input.error(of.no_family()));
            } else {
                return Err(input.error("expected `,`"));
            }
        } else if input.peek(Token![=]) && !input.peek(Token![==]) {
            input.parse::<Token![=]>()?;
            Value::Assigned(input.parse()?)
        } else {
            input.parse::<TokenStream>()?;
            Value::Neither
        };
        Ok(Self { name, value })
    }

    /// What may be given once: `name`, or `name(of)`. Every `constraint`, `nonholonomic` or `impact` is one
    /// more.
    pub(super) fn given(&self) -> Option<String> {
        if Constrained::named(&self.name.to_string()).is_some() {
            return None;
        }
        Some(match &self.value {
            Value::AssignedTo { of, .. } => format!("{}({of})", self.name),
            Value::Assigned(_) | Value::List(_) | Value::Neither => self.name.to_string(),
        })
    }
}
