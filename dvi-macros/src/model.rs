//! Tree to model: coordinates with their sizes, parameters with their shapes, functions.
//!
//! The symbolic core knows blocks, parameters, sizes and functions by number; the tables here say what
//! they are.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Expr, ExprLit, Fields, GenericParam, Ident, ItemStruct, Lit, Path, Type};

use crate::errors::Errors;
use crate::symbolic::{Index, Names, Size};
use crate::syntax::{Attribute, Declaration, Function};

/// A block of coordinates: one, or an array.
#[derive(Debug)]
pub(crate) struct Block {
    pub(crate) name: Ident,
    /// The size of an array, with its text.
    pub(crate) array: Option<(Index, String)>,
}

/// A size that is not a literal.
#[derive(Debug)]
pub(crate) struct SizeName {
    pub(crate) text: String,
    /// Its value as an expression of type `usize` in a method of the struct.
    pub(crate) tokens: TokenStream,
    /// Whether the compiler knows it: a const generic.
    pub(crate) constant: bool,
}

/// A constant of the system: a field of the struct, or a path.
#[derive(Debug)]
pub(crate) struct ParameterName {
    pub(crate) text: String,
    /// The place in a method of the struct.
    pub(crate) tokens: TokenStream,
    pub(crate) shape: Shape,
}

/// What the type of a field says, as far as it is written out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Number,
    Count,
    /// An array, slice or vector, with its length if that is a literal.
    Array(Option<i64>),
    Unknown,
    /// Certainly not a number.
    Other,
}

#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) item: ItemStruct,
    pub(crate) blocks: Vec<Block>,
    pub(crate) sizes: Vec<SizeName>,
    pub(crate) parameters: Vec<ParameterName>,
    pub(crate) functions: Vec<Function>,
    pub(crate) crate_path: Path,
}

impl Model {
    pub(crate) fn new(attribute: &mut Attribute, item: ItemStruct, errors: &mut Errors) -> Self {
        let crate_path = attribute.crate_path.take().unwrap_or_else(|| syn::parse_quote!(::dvi_core));
        let parameters = fields(&item, errors);
        let functions = std::mem::take(&mut attribute.functions);
        let mut model =
            Self { item, blocks: Vec::new(), sizes: Vec::new(), parameters, functions, crate_path };
        for declaration in &attribute.coordinates {
            model.declare(declaration, errors);
        }
        for function in &model.functions {
            if function.derivatives.len() < 3 {
                let message =
                    "a function needs itself and its first two derivatives: write `f = [f, df, d2f]`";
                errors.push(&function.name, message);
            }
        }
        model
    }

    fn declare(&mut self, declaration: &Declaration, errors: &mut Errors) {
        let Declaration { name, size } = declaration;
        if self.blocks.iter().any(|block| block.name == *name) {
            errors.push(name, format!("coordinate `{name}` is declared twice"));
            return;
        }
        if self.parameters.iter().any(|parameter| *name == parameter.text) {
            errors.push(
                name,
                format!("coordinate `{name}` has the name of a field of the struct; rename one of them"),
            );
        }
        let array = size.as_ref().map(|size| {
            let index = self.size(size).unwrap_or_else(|| {
                errors.push(
                    size,
                    "expected a size: a literal, a const generic, a field of type `usize`, or `field.len()`",
                );
                Index::literal(1)
            });
            if index.as_literal().is_some_and(|size| size < 1) {
                errors.push(size, format!("`{name}` would have no coordinates"));
            }
            (index, size.to_token_stream().to_string().replace(' ', ""))
        });
        self.blocks.push(Block { name: name.clone(), array });
    }

    /// A literal, a const generic, a field of type `usize`, or `field.len()`.
    pub(crate) fn size(&mut self, expr: &Expr) -> Option<Index> {
        match expr {
            Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => value.base10_parse().ok().map(Index::literal),
            Expr::Paren(inner) => self.size(&inner.expr),
            Expr::Path(path) => self.named_size(&path.path.get_ident()?.to_string()),
            Expr::MethodCall(call) if call.method == "len" && call.args.is_empty() => {
                let field = field_name(&call.receiver)?;
                let known =
                    self.parameters.iter().find(|p| p.text == field && matches!(p.shape, Shape::Array(_)))?;
                let tokens = known.tokens.clone();
                Some(self.intern_size(format!("{field}.len()"), quote!(#tokens.len()), false))
            }
            Expr::Field(_) => self.named_size(&field_name(expr)?),
            _ => None,
        }
    }

    fn named_size(&mut self, name: &str) -> Option<Index> {
        let generic = self.item.generics.params.iter().find_map(|parameter| match parameter {
            GenericParam::Const(constant) if constant.ident == name => Some(constant.ident.clone()),
            _ => None,
        });
        if let Some(ident) = generic {
            return Some(self.intern_size(name.to_string(), ident.to_token_stream(), true));
        }
        let field = self.parameters.iter().find(|p| p.text == name && p.shape == Shape::Count)?;
        let tokens = field.tokens.clone();
        Some(self.intern_size(name.to_string(), tokens, false))
    }

    fn intern_size(&mut self, text: String, tokens: TokenStream, constant: bool) -> Index {
        let known = self.sizes.iter().position(|size| size.text == text).unwrap_or_else(|| {
            self.sizes.push(SizeName { text, tokens, constant });
            self.sizes.len() - 1
        });
        Index::size(Size(known as u32))
    }

    /// The parameter that a path such as `Self::G` stands for.
    pub(crate) fn path_parameter(&mut self, path: &Path) -> u32 {
        let text = path.to_token_stream().to_string().replace(' ', "");
        let known = self.parameters.iter().position(|parameter| parameter.text == text);
        let position = known.unwrap_or_else(|| {
            self.parameters.push(ParameterName { text, tokens: quote!(#path), shape: Shape::Unknown });
            self.parameters.len() - 1
        });
        position as u32
    }

    pub(crate) fn block_size(&self, block: usize) -> Index {
        self.blocks[block].array.as_ref().map_or_else(|| Index::literal(1), |(size, _)| size.clone())
    }

    /// The number of coordinates as an index expression.
    pub(crate) fn dimension(&self) -> Index {
        (0..self.blocks.len()).fold(Index::default(), |sum, block| sum.plus(&self.block_size(block), 1))
    }

    /// Whether the compiler knows the size of a block.
    pub(crate) fn is_constant(&self, block: usize) -> bool {
        self.block_size(block).terms.iter().all(|(atom, _)| match atom {
            crate::symbolic::Atom::Size(size) => self.sizes[size.0 as usize].constant,
            _ => false,
        })
    }
}

impl Names for Model {
    fn coordinate(&self, block: u32) -> (String, bool) {
        let block = &self.blocks[block as usize];
        (block.name.to_string(), block.array.is_some())
    }
    fn parameter(&self, field: u32) -> &str {
        &self.parameters[field as usize].text
    }
    fn size(&self, size: u32) -> &str {
        &self.sizes[size as usize].text
    }
    fn function(&self, function: u32) -> String {
        self.functions[function as usize].name.to_string()
    }
}

/// `name` in `name` and in `self.name`.
fn field_name(expr: &Expr) -> Option<String> {
    match expr {
        Expr::Path(path) => path.path.get_ident().map(Ident::to_string),
        Expr::Field(field) => match (&*field.base, &field.member) {
            (Expr::Path(base), syn::Member::Named(name)) if base.path.is_ident("self") => {
                Some(name.to_string())
            }
            _ => None,
        },
        _ => None,
    }
}

fn fields(item: &ItemStruct, errors: &mut Errors) -> Vec<ParameterName> {
    match &item.fields {
        Fields::Named(fields) => fields
            .named
            .iter()
            .filter_map(|field| {
                let name = field.ident.as_ref()?;
                Some(ParameterName {
                    text: name.to_string(),
                    tokens: quote!(self.#name),
                    shape: shape(&field.ty),
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

fn shape(ty: &Type) -> Shape {
    match ty {
        Type::Array(array) => match &array.len {
            Expr::Lit(ExprLit { lit: Lit::Int(length), .. }) => Shape::Array(length.base10_parse().ok()),
            _ => Shape::Array(None),
        },
        Type::Slice(_) => Shape::Array(None),
        Type::Reference(reference) => shape(&reference.elem),
        Type::Paren(inner) => shape(&inner.elem),
        Type::Group(inner) => shape(&inner.elem),
        Type::Tuple(_) | Type::Never(_) => Shape::Other,
        Type::Path(path) => {
            match path.path.segments.last().map(|segment| segment.ident.to_string()).as_deref() {
                Some("f64" | "f32" | "i8" | "i16" | "i32" | "i64" | "u8" | "u16" | "u32" | "u64") => {
                    Shape::Number
                }
                Some("usize") => Shape::Count,
                Some("Vec" | "VecDeque" | "SmallVec" | "ArrayVec") => Shape::Array(None),
                Some("String" | "str" | "bool" | "char") => Shape::Other,
                _ => Shape::Unknown,
            }
        }
        _ => Shape::Unknown,
    }
}
