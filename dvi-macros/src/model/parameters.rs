//! The parameters of a system: the fields of its struct.

use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;
use syn::{Fields, Ident, ItemStruct};

use super::shape::{Shape, generic, is_integer, is_slice, shape};
use crate::errors::Errors;

/// A constant of the system: a field of the struct, or a path.
#[derive(Debug)]
pub(crate) struct ParameterName {
    pub(crate) text: String,
    /// The place in a method of the struct.
    pub(crate) tokens: TokenStream,
    pub(crate) shape: Shape,
    /// Whether its entries are numbers that lie beside one another for certain.
    pub(crate) is_slice: bool,
    /// Whether its numbers are integers for certain.
    pub(crate) integer: bool,
    /// The generic type of the struct that its numbers are of.
    pub(crate) generic: Option<Ident>,
}

impl ParameterName {
    pub(super) fn of_unknown_type(text: String, tokens: TokenStream) -> Self {
        Self { text, tokens, shape: Shape::Unknown, is_slice: false, integer: false, generic: None }
    }
}

/// Those that are declared.
pub(super) fn fields(item: &ItemStruct, errors: &mut Errors) -> Vec<ParameterName> {
    match &item.fields {
        Fields::Named(fields) => fields
            .named
            .iter()
            .filter_map(|field| {
                let name = field.ident.as_ref()?;
                Some(ParameterName {
                    text: name.to_string(),
                    // What is wrong with the type of a field is reported on the field.
                    tokens: quote_spanned!(Span::call_site().located_at(name.span())=> self.#name),
                    shape: shape(&field.ty),
                    is_slice: is_slice(&field.ty, &item.generics),
                    integer: is_integer(&field.ty),
                    generic: generic(&field.ty, &item.generics),
                })
            })
            .collect(),
        Fields::Unit => Vec::new(),
        Fields::Unnamed(fields) => {
            let message =
                "the fields are the parameters of the system and need names: write `struct S { name: f64 }`";
            errors.push(fields, message);
            Vec::new()
        }
    }
}
