//! What is declared by name in the arguments: coordinates, momenta, functions, forces.

use std::fmt;

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Expr, Path, Token, Type};

use super::closures::ident;
use super::cut::expression;
use crate::errors::text;

/// `x`, `x[n]`, `r[n][3]`, `q[n][m]`, `R: SO3`, `s: S2` or `s[n]: S2`.
#[derive(Debug)]
pub(crate) struct Declaration {
    pub(crate) name: Ident,
    pub(crate) size: Option<Expr>,
    /// The number of components, if the entries are vectors, or the second size.
    pub(crate) components: Option<Expr>,
    pub(crate) factor: Factor,
}

/// Where the coordinates of a block live.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Factor {
    /// ℝⁿ.
    #[default]
    Line,
    /// `SO3`: the entries of a rotation matrix, row by row. The velocities are those of its angular velocity
    /// in the body.
    Rotation,
    /// `S2`: a unit vector.
    Sphere,
}

impl Factor {
    /// The factor of this name, beside ℝⁿ, which has none.
    fn named(name: &str) -> Option<Self> {
        match name {
            "SO3" => Some(Self::Rotation),
            "S2" => Some(Self::Sphere),
            _ => None,
        }
    }

    /// The number of coordinates of one rotation or one unit vector.
    pub(crate) fn coordinates(self) -> Option<usize> {
        match self {
            Self::Line => None,
            Self::Rotation => Some(9),
            Self::Sphere => Some(3),
        }
    }

    /// The dimension of the manifold, if that is not declared.
    pub(crate) fn dimension(self) -> Option<usize> {
        match self {
            Self::Line => None,
            Self::Rotation => Some(3),
            Self::Sphere => Some(2),
        }
    }
}

/// `name = formula` in `momenta(...)` and `events(...)`.
#[derive(Debug)]
pub(crate) struct Named {
    pub(crate) name: Ident,
    pub(crate) formula: Expr,
}

/// `f = [path, path_of_derivative, …]` in `functions(...)`, with two derivatives or three.
#[derive(Debug)]
pub(crate) struct Function {
    pub(crate) name: Ident,
    pub(crate) derivatives: Vec<Path>,
}

/// An entry of `functions(...)`.
#[derive(Debug)]
pub(super) enum Declared {
    Function(Function),
    ScalarField(ScalarFieldPath),
}

/// `psi = path`: a function of several variables that stands somewhere else than in the struct.
#[derive(Debug)]
pub(crate) struct ScalarFieldPath {
    pub(crate) name: Ident,
    pub(crate) path: Path,
}

/// `gauge = F`, or `gauge = auto`.
#[derive(Debug)]
pub(crate) enum Gauge {
    Formula(Expr),
    /// The compiler is to find one; the word.
    Auto(Ident),
}

/// `time_transform = ρ`, with the word.
#[derive(Debug)]
pub(crate) struct TimeTransform {
    pub(crate) word: Ident,
    pub(crate) rate: Expr,
}

/// A generalised force, as it is declared.
#[derive(Debug)]
pub(crate) enum Force {
    /// `force = […]`: a component for each block.
    Components(syn::ExprArray),
    /// `force(x) = …`: that on one block.
    On(Ident, Expr),
}

impl Gauge {
    pub(super) fn new(formula: Expr) -> Self {
        let word = ident(&formula).filter(|word| **word == "auto").cloned();
        word.map_or(Self::Formula(formula), Self::Auto)
    }
}

/// `x` or `x[n]`, as it was written.
impl fmt::Display for Declaration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        self.size.as_ref().map_or(Ok(()), |size| write!(f, "[{}]", text(size)))
    }
}

impl Parse for Declaration {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name = match input.call(Ident::parse_any) {
            Ok(name) if syn::parse2::<Ident>(name.clone().into_token_stream()).is_ok() => name,
            Ok(keyword) => {
                let is_never_raw =
                    ["self", "Self", "super", "crate", "_"].iter().any(|word| keyword == word);
                let raw = if is_never_raw { String::new() } else { format!("write `r#{keyword}`, or ") };
                let message = format!("`{keyword}` is a keyword of Rust: {raw}take another name");
                return Err(syn::Error::new(keyword.span(), message));
            }
            Err(error) => {
                return Err(syn::Error::new(
                    error.span(),
                    "expected the name of a coordinate, as in `coordinates(x, y)`",
                ));
            }
        };
        let size = bracketed(input, || format!("`{name}[]` has no size: write `{name}[n]`"))?;
        let components = match size {
            Some(_) => bracketed(input, || {
                format!("the second size is missing: write `{name}[n][3]` for n vectors, or `{name}[n][m]`")
            })?,
            None => None,
        };
        if input.peek(syn::token::Bracket) {
            let message = format!(
                "a coordinate has two sizes at most: write `{name}[n][m]`, or `{name}[n][3]` for n vectors"
            );
            return Err(input.error(message));
        }
        let mut declared = Self { name, size, components, factor: Factor::Line };
        if input.peek(Token![:]) {
            declared.factor = factor(input, &declared)?;
        }
        if !input.is_empty() {
            return Err(input.error(
                "a coordinate is declared as `x`, `x[n]`, `r[n][3]`, `q[n][m]`, `R: SO3`, `s: S2` or \
                 `s[n]: S2`, and followed by `,`",
            ));
        }
        Ok(declared)
    }
}

/// What stands in brackets, if there are some.
fn bracketed(input: ParseStream<'_>, empty: impl FnOnce() -> String) -> syn::Result<Option<Expr>> {
    if !input.peek(syn::token::Bracket) {
        return Ok(None);
    }
    let content;
    let bracket = syn::bracketed!(content in input);
    if content.is_empty() {
        return Err(syn::Error::new(bracket.span.join(), empty()));
    }
    expression(&content).map(Some)
}

/// What stands behind the colon of `R: SO3`, of a declaration that is read up to there.
fn factor(input: ParseStream<'_>, declared: &Declaration) -> syn::Result<Factor> {
    let name = declared.to_string();
    input.parse::<Token![:]>()?;
    let advice = format!(
        "what a coordinate is, if it is no number, is `{name}: SO3`, a rotation matrix, or `{name}: S2`, a unit vector"
    );
    let at = input.span();
    match input.parse::<Type>().map_err(|_| syn::Error::new(at, &advice))? {
        Type::Array(array) => {
            let message = format!(
                "an array of coordinates is declared by its size alone: `{name}[{}]`",
                text(&array.len)
            );
            Err(syn::Error::new_spanned(array, message))
        }
        Type::Path(path) if path.path.is_ident("f64") || path.path.is_ident("f32") => {
            let message = format!("a coordinate is a number where nothing else is said: write `{name}`");
            Err(syn::Error::new_spanned(path, message))
        }
        word => {
            let written = word.to_token_stream().to_string();
            let factor = Factor::named(&written).ok_or_else(|| syn::Error::new_spanned(word, &advice))?;
            match &declared.components {
                Some(components) => {
                    let message =
                        format!("the components are those of `{written}`: write `{name}: {written}`");
                    Err(syn::Error::new_spanned(components, message))
                }
                None => Ok(factor),
            }
        }
    }
}

impl Named {
    /// Of a kind: momentum, or event.
    pub(super) fn parse(input: ParseStream<'_>, kind: &str) -> syn::Result<Self> {
        let (all, at) = (input.fork(), input.span());
        let unnamed = |input: ParseStream<'_>| {
            let formula = input.parse::<TokenStream>()?;
            let article = if kind.starts_with('e') { "an" } else { "a" };
            let message = format!("{article} {kind} has a name: write `name = {}`", text(&formula));
            Err(syn::Error::new_spanned(formula, message))
        };
        let Ok(name) = input.parse::<Ident>() else { return unnamed(&all) };
        if input.peek(Token![:]) || input.is_empty() {
            return Err(syn::Error::new(at, format!("this {kind} has no formula: write `{name} = …`")));
        }
        if !input.peek(Token![=]) {
            return unnamed(&all);
        }
        input.parse::<Token![=]>()?;
        Ok(Self { name, formula: expression(input)? })
    }
}

impl Parse for Declared {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name: Ident = input.parse()?;
        let advice = format!(
            "a function is declared by its path and those of its first two derivatives, or three: write `{name} = [f, df, d2f]`; \
             a value that implements `ScalarField` is declared by its path alone: write `{name} = path`"
        );
        let at_fault = |at: Span| syn::Error::new(at, &advice);
        if !input.peek(Token![=]) {
            return Err(at_fault(name.span()));
        }
        input.parse::<Token![=]>()?;
        if !input.peek(syn::token::Bracket) {
            let at = input.span();
            let path = input.parse::<Path>().map_err(|_| at_fault(at))?;
            return Ok(Self::ScalarField(ScalarFieldPath { name, path }));
        }
        let content;
        let bracket = syn::bracketed!(content in input);
        let derivatives = Punctuated::<Path, Token![,]>::parse_terminated(&content)
            .map_err(|error| at_fault(error.span()))?;
        if !(3..=4).contains(&derivatives.len()) {
            return Err(at_fault(bracket.span.join()));
        }
        Ok(Self::Function(Function { name, derivatives: derivatives.into_iter().collect() }))
    }
}
