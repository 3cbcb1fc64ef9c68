//! Sizes: of what arrays of coordinates and ranges of sums are made, and where they stand in the struct.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{BinOp, Expr, ExprLit, Ident, Lit, Member, Type};

use super::shape::{Shape, plain, shape};
use super::{Model, ParameterName, SizeName};
use crate::errors::{Errors, text};
use crate::internal::internal;
use crate::symbolic::{Atom, Index, Size};
use crate::syntax::{indexed, name_of};

/// The largest dimension that a literal size may give: such a state lives on the stack.
const LARGEST: i64 = 1 << 20;

impl Model {
    /// The size of an array of coordinates with its text; 1 where it is none, which is reported.
    pub(super) fn read_size(
        &mut self,
        name: &Ident,
        size: &Expr,
        axes: i64,
        errors: &mut Errors,
    ) -> (Index, String) {
        let index = self.declared_size(name, size, axes).unwrap_or_else(|message| {
            let kind = format!("size {}", size.to_token_stream());
            errors.push_once(&kind, size, message);
            self.lost_coordinates = true;
            Index::literal(1)
        });
        (index, size.to_token_stream().to_string().replace("r#", "").replace(' ', ""))
    }

    /// The size of an array of coordinates, of which each entry counts as `axes`, or what is wrong with it.
    fn declared_size(&mut self, name: &Ident, size: &Expr, axes: i64) -> Result<Index, String> {
        let index = self.size_form(size).map_err(|found| match found {
            Some(name) => {
                let system = &self.item.ident;
                format!(
                    "`{name}` is not declared: write `struct {system}<const {name}: usize>`, or take the size \
                     from a field of type `usize`"
                )
            }
            None => "expected a size: a literal, a const generic, a field of type `usize`, `field.len()`, or sums \
                     and products of these"
                .into(),
        })?;
        let so_far = self.dimension().as_literal().unwrap_or(0);
        match index.as_literal() {
            Some(..1) => Err(format!("`{name}` would have no coordinates")),
            Some(size) if size.saturating_mul(axes) > LARGEST - so_far => Err(format!(
                "a state of this size does not fit on the stack (at most {LARGEST} coordinates); take the size \
                 from a field: `{name}[field.len()]`"
            )),
            _ => Ok(index),
        }
    }

    /// A literal, a const generic, a field of type `usize`, or `field.len()`.
    pub(crate) fn size(&mut self, expr: &Expr) -> Option<Index> {
        match expr {
            Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => {
                // Beyond all integers is beyond all sizes.
                Some(Index::literal(value.base10_digits().parse().unwrap_or(i64::MAX)))
            }
            Expr::Paren(inner) => self.size(&inner.expr),
            Expr::Group(inner) => self.size(&inner.expr),
            Expr::Path(path) => self.named_size(&path.path.get_ident()?.to_string()),
            Expr::MethodCall(call) if call.method == "len" && call.args.is_empty() => {
                let known = self.place(&call.receiver)?;
                let known = &self.parameters[known as usize];
                if !matches!(known.shape, Shape::Array(..) | Shape::Unknown) {
                    return None;
                }
                let (text, tokens) = (format!("{}.len()", known.text), known.tokens.clone());
                Some(self.intern_size(text, quote!(#tokens.len()), false))
            }
            Expr::Field(_) => match name_of(expr) {
                Some(name) => self.named_size(&name.to_string()),
                None => {
                    let known = self.nested_parameter(expr)?;
                    let known = &self.parameters[known as usize];
                    let (text, tokens) = (known.text.clone(), known.tokens.clone());
                    Some(self.intern_size(text, tokens, false))
                }
            },
            _ => None,
        }
    }

    /// A const generic or a field of type `usize`.
    pub(crate) fn named_size(&mut self, name: &str) -> Option<Index> {
        let mut generics = self.item.generics.const_params();
        if let Some(known) = generics.find(|known| known.ident == name && shape(&known.ty) == Shape::Count) {
            let tokens = known.ident.to_token_stream();
            return Some(self.intern_size(name.to_string(), tokens, true));
        }
        let field = self.parameters.iter().find(|p| p.text == name && p.shape == Shape::Count)?;
        let tokens = field.tokens.clone();
        Some(self.intern_size(name.to_string(), tokens, false))
    }

    /// What is known of the length of a parameter, or of its entries at a deeper `level`.
    pub(crate) fn lengths(&mut self, parameter: u32, level: usize) -> Vec<Index> {
        let text = self.parameters[parameter as usize].text.clone();
        let fields = self.item.fields.iter();
        let declared = fields.filter(|field| field.ident.as_ref().is_some_and(|name| *name == text));
        let written = declared.filter_map(|field| array_length(&field.ty, level)).next().cloned();
        let mut lengths: Vec<Index> = written.and_then(|length| self.size(&length)).into_iter().collect();
        if level == 0 {
            let named = format!("{text}.len()");
            let known = self.sizes.iter().position(|size| size.text == named);
            lengths.extend(known.map(|known| Index::size(Size(known as u32))));
        }
        lengths
    }

    fn intern_size(&mut self, text: String, tokens: TokenStream, constant: bool) -> Index {
        let known = self.sizes.iter().position(|size| size.text == text).unwrap_or_else(|| {
            self.sizes.push(SizeName { text, tokens, constant });
            self.sizes.len() - 1
        });
        Index::size(Size(known as u32))
    }

    /// A size, or a sum, difference or product of sizes; the name that is at fault, if it is one.
    ///
    /// Stable Rust computes no array length from a const generic. A block of such a size is a `Vec`.
    fn size_form(&mut self, expr: &Expr) -> Result<Index, Option<Ident>> {
        match expr {
            Expr::Paren(inner) => self.size_form(&inner.expr),
            Expr::Binary(binary) => {
                let (left, right) = (self.size_form(&binary.left)?, self.size_form(&binary.right)?);
                if [&left, &right].iter().any(|part| !part.is_short()) {
                    return Err(None);
                }
                match (binary.op, left.as_literal(), right.as_literal()) {
                    (BinOp::Add(_), ..) => Ok(left.plus(&right, 1)),
                    (BinOp::Sub(_), Some(above), Some(below)) if above >= below => {
                        Ok(Index::literal(above - below))
                    }
                    (BinOp::Sub(_), Some(_), Some(_)) => Err(None),
                    // A difference below zero is zero, so it is no affine form but a size of its own.
                    (BinOp::Sub(_), ..) => {
                        let (above, below) = (self.size_tokens(&left), self.size_tokens(&right));
                        let tokens = quote!((#above).saturating_sub(#below));
                        Ok(self.intern_size(format!("({})", text(expr)), tokens, false))
                    }
                    (BinOp::Mul(_), ..) => Ok(left.product(&right)),
                    _ => Err(None),
                }
            }
            _ => self.size(expr).ok_or_else(|| match expr {
                Expr::Path(path) => {
                    let name = path.path.get_ident().filter(|name| is_upper(name));
                    name.filter(|name| !self.is_generic(name)).cloned()
                }
                _ => None,
            }),
        }
    }

    fn is_generic(&self, name: &Ident) -> bool {
        let generics = &self.item.generics;
        let types = generics.type_params().map(|ty| &ty.ident);
        types.chain(generics.const_params().map(|constant| &constant.ident)).any(|known| known == name)
    }

    /// A sum of multiples of sizes as an expression of type `usize`, the largest one beyond all; no
    /// coefficient is negative.
    pub(crate) fn size_tokens(&self, size: &Index) -> TokenStream {
        let term = |(atom, coefficient): &(Atom, i64)| match (self.atom_tokens(atom), *coefficient) {
            (tokens, 1) => tokens,
            (tokens, factor) => {
                let factor = factor.unsigned_abs() as usize;
                quote!(#tokens.saturating_mul(#factor))
            }
        };
        let constant = size.constant.unsigned_abs() as usize;
        let constant = (constant > 0 || size.terms.is_empty()).then(|| quote!(#constant));
        let terms = size.terms.iter().map(term).chain(constant);
        terms.reduce(|before, term| quote!(#before.saturating_add(#term))).unwrap_or_default()
    }

    fn atom_tokens(&self, atom: &Atom) -> TokenStream {
        match atom {
            Atom::Size(Size(known)) => self.sizes[*known as usize].tokens.clone(),
            Atom::Product(factors) => {
                let factors = factors.iter().map(|factor| self.atom_tokens(factor));
                factors.reduce(|before, factor| quote!(#before.saturating_mul(#factor))).unwrap_or_default()
            }
            Atom::Open(_) | Atom::Bound(_) | Atom::Remainder(..) | Atom::Row(..) => {
                internal("a size depends on an index")
            }
        }
    }

    /// The parameter at `name`, `self.name`, `p.m` or `self.p.m`.
    fn place(&mut self, expr: &Expr) -> Option<u32> {
        match name_of(expr) {
            Some(name) => self.parameters.iter().position(|p| *name == p.text).map(|known| known as u32),
            None => self.nested_parameter(expr),
        }
    }

    /// The parameter at `p.m` and `self.p.m`, to any depth, where `p` is a field whose type is not known to
    /// have no fields. The compiler says whether there is such a place.
    pub(crate) fn nested_parameter(&mut self, expr: &Expr) -> Option<u32> {
        let Expr::Field(field) = expr else { return None };
        let Member::Named(member) = &field.member else { return None };
        let base = self.place(&field.base)?;
        let base = &self.parameters[base as usize];
        if base.shape != Shape::Unknown {
            return None;
        }
        let (text, tokens) = (format!("{}.{member}", base.text), &base.tokens);
        if let Some(known) = self.parameters.iter().position(|parameter| parameter.text == text) {
            return Some(known as u32);
        }
        let tokens = quote!(#tokens.#member);
        self.parameters.push(ParameterName::of_unknown_type(text, tokens));
        Some(self.parameters.len() as u32 - 1)
    }

    /// Whether an expression is a field of integers, or an entry of one.
    pub(crate) fn is_integer_field(&mut self, expr: &Expr) -> bool {
        self.place(indexed(expr).0).is_some_and(|known| self.parameters[known as usize].integer)
    }
}

/// The length of an array type, or of its entries at a deeper `level`.
fn array_length(ty: &Type, level: usize) -> Option<&Expr> {
    match (plain(ty), level) {
        (Type::Array(array), 0) => Some(&array.len),
        (Type::Array(array), _) => array_length(&array.elem, level - 1),
        _ => None,
    }
}

/// Whether a name is written as that of a constant.
fn is_upper(name: &Ident) -> bool {
    name.to_string().chars().all(|letter| letter.is_uppercase() || letter.is_ascii_digit() || letter == '_')
}
