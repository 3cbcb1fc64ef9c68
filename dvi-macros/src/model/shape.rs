//! What the type of a field says of it, as far as it is written out.

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Expr, ExprLit, GenericArgument, Generics, Ident, Lit, PathArguments, PathSegment, Type};

/// What the type of a field says, as far as it is written out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Number,
    Count,
    /// An array, slice or vector: its length if that is a literal, and the shape of its entries.
    Array(Option<i64>, Box<Shape>),
    Unknown,
    /// Certainly not a number.
    Other,
}

/// The type behind references and parentheses.
pub(super) fn plain(ty: &Type) -> &Type {
    match ty {
        Type::Reference(reference) => plain(&reference.elem),
        Type::Paren(inner) => plain(&inner.elem),
        Type::Group(inner) => plain(&inner.elem),
        _ => ty,
    }
}

/// The entries of `Vec<f64>`.
fn argument(of: &PathSegment) -> Option<&Type> {
    match &of.arguments {
        PathArguments::AngleBracketed(list) => match list.args.first()? {
            GenericArgument::Type(ty) => Some(ty),
            _ => None,
        },
        _ => None,
    }
}

pub(super) fn shape(ty: &Type) -> Shape {
    match plain(ty) {
        Type::Array(array) => {
            let length = match &array.len {
                Expr::Lit(ExprLit { lit: Lit::Int(length), .. }) => length.base10_parse().ok(),
                _ => None,
            };
            Shape::Array(length, Box::new(shape(&array.elem)))
        }
        Type::Slice(slice) => Shape::Array(None, Box::new(shape(&slice.elem))),
        Type::Tuple(_) | Type::Never(_) => Shape::Other,
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else { return Shape::Unknown };
            let entry = || argument(last).map_or(Shape::Unknown, shape);
            match last.ident.to_string().as_str() {
                "f64" | "f32" | "i8" | "i16" | "i32" | "i64" | "isize" | "u8" | "u16" | "u32" | "u64" => {
                    Shape::Number
                }
                "usize" => Shape::Count,
                "Box" | "Rc" | "Arc" => entry(),
                "Vec" | "VecDeque" | "SmallVec" | "ArrayVec" => Shape::Array(None, Box::new(entry())),
                "String" | "str" | "bool" | "char" | "Option" | "Result" | "PhantomData" | "HashMap"
                | "BTreeMap" => Shape::Other,
                _ => Shape::Unknown,
            }
        }
        _ => Shape::Unknown,
    }
}

/// The generic type among `generics` that the numbers of a type are of: `P` for `[P; 3]`.
pub(super) fn generic(ty: &Type, generics: &Generics) -> Option<Ident> {
    match plain(ty) {
        Type::Array(array) => generic(&array.elem, generics),
        Type::Slice(slice) => generic(&slice.elem, generics),
        Type::Path(path) => match path.path.get_ident() {
            Some(name) => generics.type_params().any(|known| known.ident == *name).then(|| name.clone()),
            None => {
                let entry = argument(path.path.segments.last()?)?;
                matches!(shape(ty), Shape::Array(..)).then(|| generic(entry, generics))?
            }
        },
        _ => None,
    }
}

/// Whether a type is that of numbers that lie beside one another for certain.
pub(super) fn is_slice(ty: &Type, generics: &Generics) -> bool {
    let is_number = |ty: &Type| {
        let is_name = matches!(ty, Type::Path(path) if path.path.get_ident().is_some());
        is_name && (shape(ty) == Shape::Number || generic(ty, generics).is_some())
    };
    match plain(ty) {
        Type::Array(array) => is_number(&array.elem),
        Type::Slice(slice) => is_number(&slice.elem),
        // Another type of this name would have another path.
        Type::Path(path) if path.path.segments.len() == 1 => {
            path.path.segments.last().is_some_and(|last| match last.ident.to_string().as_str() {
                "Vec" => argument(last).is_some_and(is_number),
                "Box" | "Rc" | "Arc" => argument(last).is_some_and(|slice| is_slice(slice, generics)),
                _ => false,
            })
        }
        _ => false,
    }
}

/// Whether the numbers of a type are integers for certain.
pub(super) fn is_integer(ty: &Type) -> bool {
    match plain(ty) {
        Type::Array(array) => is_integer(&array.elem),
        Type::Slice(slice) => is_integer(&slice.elem),
        Type::Path(path) => path.path.segments.last().is_some_and(|last| match &last.arguments {
            PathArguments::AngleBracketed(list) => list
                .args
                .iter()
                .any(|argument| matches!(argument, GenericArgument::Type(ty) if is_integer(ty))),
            _ => {
                let integers =
                    ["i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128", "usize"];
                integers.iter().any(|integer| last.ident == integer)
            }
        }),
        _ => false,
    }
}

/// Whether a generic type of the struct stands in a type; a lifetime of the same name is another thing.
pub(super) fn mentions_generic(ty: &Type, generics: &Generics) -> bool {
    fn any(tokens: TokenStream, generics: &Generics) -> bool {
        let mut is_next_lifetime = false;
        tokens.into_iter().any(|token| {
            let is_lifetime = is_next_lifetime;
            is_next_lifetime = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '\'');
            match token {
                TokenTree::Ident(name) => {
                    !is_lifetime && generics.type_params().any(|known| known.ident == name)
                }
                TokenTree::Group(group) => any(group.stream(), generics),
                TokenTree::Punct(_) | TokenTree::Literal(_) => false,
            }
        })
    }
    any(ty.to_token_stream(), generics)
}
