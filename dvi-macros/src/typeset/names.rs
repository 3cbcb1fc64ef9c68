//! Names, places in arrays, and numbers.

use syn::ext::IdentExt as _;
use syn::visit::{self, Visit};
use syn::{Expr, ExprField, ExprIndex, Member};

use super::{Strength, Typesetter};
use crate::errors::text;
use crate::syntax::name_of;
use crate::words::{VELOCITIES, constant};

/// The names of Greek letters, as LaTeX has them; `lambda_` is a name of Rust's, too.
#[rustfmt::skip]
const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "vartheta", "iota", "kappa", "lambda",
    "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "varphi", "chi", "psi", "omega",
    "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Phi", "Omega",
];

/// A text that stays as it is.
pub(super) fn plain(text: &str) -> String {
    let escaped = |letter: char| match letter {
        '\\' | '^' | '~' => " ".to_owned(),
        '_' | '{' | '}' | '&' | '%' | '$' | '#' => format!("\\{letter}"),
        letter => letter.to_string(),
    };
    format!(r"\texttt{{{}}}", text.chars().map(escaped).collect::<String>())
}

/// A word of a name: a letter, a Greek one, or more.
fn word(word: &str) -> String {
    if GREEK.contains(&word) {
        format!("\\{word}")
    } else if word.chars().count() == 1 || word.chars().all(|letter| letter.is_ascii_digit()) {
        word.to_owned()
    } else {
        format!(r"\mathit{{{word}}}")
    }
}

/// What a name is made of: its first word, and what stands below: `k_r` and `mass2` have indices.
fn parts(name: &str) -> (&str, Vec<&str>) {
    let mut words = name.split('_').filter(|word| !word.is_empty());
    let first = words.next().unwrap_or(name);
    let letters = first.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let letters = if letters.is_empty() { first } else { letters };
    let digits = Some(&first[letters.len()..]).filter(|digits| !digits.is_empty());
    (letters, digits.into_iter().chain(words).collect())
}

/// The names that have indices in formulas.
#[derive(Debug, Default)]
pub(super) struct Arrays(pub(super) Vec<String>);

impl<'ast> Visit<'ast> for Arrays {
    fn visit_expr_index(&mut self, index: &'ast ExprIndex) {
        let name = match &*index.expr {
            Expr::Path(path) => path.path.get_ident(),
            Expr::Field(ExprField { member: Member::Named(name), .. }) => Some(name),
            _ => None,
        };
        self.0.extend(name.map(|name| name.unraw().to_string()).filter(|name| !self.0.contains(name)));
        visit::visit_expr_index(self, index);
    }
}

/// Digits as Rust writes them: `2.0` is 2, and `1e-3` is 10⁻³.
pub(super) fn number(digits: &str) -> String {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).map_or((digits, None), |(m, e)| (m, Some(e)));
    let mantissa = mantissa.strip_suffix(".0").or(mantissa.strip_suffix('.')).unwrap_or(mantissa);
    match (mantissa, exponent.map(|exponent| exponent.trim_start_matches('+'))) {
        (mantissa, None) => mantissa.to_owned(),
        ("1", Some(exponent)) => format!("10^{{{exponent}}}"),
        (mantissa, Some(exponent)) => format!(r"{mantissa} \cdot 10^{{{exponent}}}"),
    }
}

impl Typesetter {
    /// A name on paper.
    pub(super) fn symbol(&self, name: &str) -> String {
        self.placed(name, None, &[])
    }

    /// Whether a formula is a vector, as far as its names tell.
    pub(super) fn is_vector(&mut self, formula: &Expr) -> bool {
        match formula {
            Expr::Paren(inner) => self.is_vector(&inner.expr),
            Expr::Unary(unary) => self.is_vector(&unary.expr),
            Expr::Binary(binary) => self.is_vector(&binary.left) || self.is_vector(&binary.right),
            Expr::Array(_) => true,
            Expr::MethodCall(call) => call.method == "cross",
            Expr::Call(call) => match (&*call.func, call.args.first()) {
                (Expr::Path(path), Some(of)) if VELOCITIES.iter().any(|name| path.path.is_ident(name)) => {
                    self.is_vector(of)
                }
                _ => false,
            },
            place => {
                self.place(place).is_some_and(|(name, indices)| self.is_named_vector(&name, indices.len()))
            }
        }
    }

    fn is_named_vector(&self, name: &str, indices: usize) -> bool {
        let known = self.vectors.iter().rev().find(|(known, _)| known == name);
        known.is_some_and(|(_, count)| *count == indices)
    }

    /// `name` with `indices`, below `accent` if there is one.
    pub(super) fn placed(&self, name: &str, accent: Option<&str>, indices: &[String]) -> String {
        let name = name.strip_prefix("r#").unwrap_or(name);
        let (first, below) = parts(name);
        let is_other = !below.is_empty() && self.arrays.iter().any(|array| array == first);
        let (first, mut below) = if is_other {
            (format!(r"\mathit{{{}}}", name.replace('_', r"\_")), Vec::new())
        } else {
            (word(first), below.into_iter().map(word).collect())
        };
        let is_bold = self.is_named_vector(name, indices.len());
        let first = if is_bold { format!(r"\mathbf{{{first}}}") } else { first };
        below.extend_from_slice(indices);
        let first = accent.map_or_else(|| first.clone(), |accent| format!("{accent}{{{first}}}"));
        if below.is_empty() { first } else { format!("{first}_{{{}}}", below.join(",")) }
    }

    /// A name, or a field of something that has one.
    pub(super) fn name(&self, formula: &Expr) -> String {
        match formula {
            Expr::Path(path) => match path.path.get_ident() {
                Some(name) if name == "PI" => r"\pi".to_owned(),
                Some(name) => self.symbol(&name.to_string()),
                None => {
                    let last =
                        path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
                    constant(&last).map_or_else(|| plain(&text(path)), |(_, sign)| sign.to_owned())
                }
            },
            Expr::Field(field) => {
                let member = match &field.member {
                    Member::Named(name) => self.symbol(&name.to_string()),
                    Member::Unnamed(index) => index.index.to_string(),
                };
                match &*field.base {
                    Expr::Path(base) if base.path.is_ident("self") => member,
                    base => format!("{}.{member}", self.name(base)),
                }
            }
            other => plain(&text(other)),
        }
    }

    /// A place in an array.
    pub(super) fn indexed(&mut self, formula: &Expr) -> String {
        self.accented(formula, None)
    }

    /// A coordinate with an accent on its name, as `\dot{x}_i`; of a rotation, its angular velocity.
    pub(super) fn velocity(&mut self, of: &Expr, accent: &str) -> String {
        match self.place(of) {
            Some((name, indices)) if self.is_entry(&name, &indices) => {
                let (place, of) =
                    indices.split_last().map_or(("", [].as_slice()), |(k, of)| (k.as_str(), of));
                format!(r"\omega\left({}\right)_{{{place}}}", self.placed(&name, None, of))
            }
            Some(_) => self.accented(of, Some(accent)),
            None => format!("{accent}{{{}}}", self.expr(of).text),
        }
    }

    fn accented(&mut self, formula: &Expr, accent: Option<&str>) -> String {
        let Some((name, mut indices)) = self.place(formula) else {
            return self.of_other(formula);
        };
        if let (true, Some(last)) = (self.is_entry(&name, &indices), indices.last())
            && let Ok(entry) = last.parse::<u32>()
        {
            indices.pop();
            indices.extend([entry / 3, entry % 3].map(|index| index.to_string()));
        }
        self.placed(&name, accent, &indices)
    }

    /// Whether this is one of the nine entries of a rotation, by its number.
    fn is_entry(&self, name: &str, indices: &[String]) -> bool {
        self.rotations.iter().any(|(known, count)| known == name && indices.len() == count + 1)
    }

    /// The name and the indices of a place in an array that has a name of its own.
    fn place(&mut self, formula: &Expr) -> Option<(String, Vec<String>)> {
        match formula {
            Expr::Paren(inner) => self.place(&inner.expr),
            Expr::Index(index) => {
                let (name, mut indices) = self.place(&index.expr)?;
                indices.push(self.expr(&index.index).text);
                Some((name, indices))
            }
            other => Some((name_of(other)?.to_string(), Vec::new())),
        }
    }

    /// A place in an array that has no name of its own.
    fn of_other(&mut self, formula: &Expr) -> String {
        if let Some(component) = velocity_of_component(formula) {
            return self.expr(&component).text;
        }
        match formula {
            Expr::Index(index) => {
                let [of, at] = [&index.expr, &index.index].map(|part| self.expr(part));
                format!("{}_{{{}}}", of.within(Strength::Atom), at.text)
            }
            other => self.expr(other).text,
        }
    }
}

/// `dot(r[i][k])` for `dot(r[i])[k]`.
fn velocity_of_component(formula: &Expr) -> Option<Expr> {
    let Expr::Index(ExprIndex { expr, index, .. }) = formula else { return None };
    let Expr::Call(call) = &**expr else { return None };
    let Expr::Path(path) = &*call.func else { return None };
    let of = call.args.first()?;
    let is_velocity = VELOCITIES.iter().any(|name| path.path.is_ident(name));
    is_velocity.then(|| syn::parse_quote!(#path(#of[#index])))
}
