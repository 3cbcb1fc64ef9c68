//! Formulas in LaTeX, as they were written: the documentation of a system shows them.
//!
//! Names of `let`s stand for themselves, and each is defined on a line of its own. What the compiler makes of
//! a formula is not needed for that: the tree of the syntax is walked, and the few forms that a formula may
//! have become what is written on paper.

mod calls;
mod declared;
mod lines;
mod names;

use std::fmt::Write as _;

use syn::visit::Visit as _;
use syn::{BinOp, Expr, ExprIf, Lit, Local, Pat, Stmt, UnOp};

use crate::errors::text;
use crate::syntax::{Attribute, Factor, bound, closure, last_value};
use names::{Arrays, number};

#[cfg(test)]
mod tests;

pub(crate) use declared::declared;
pub(crate) use lines::{Equation, block};
use names::plain;

/// How tightly a formula holds together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    /// `\sum_j a_j` or `\sin x`, which seem to take all factors that follow.
    Series,
    Product,
    /// `\sin(x + y)` or `x^2`, of which no power is taken without parentheses.
    Function,
    Atom,
}

/// A formula in LaTeX.
#[derive(Clone, Debug)]
struct Tex {
    text: String,
    strength: Strength,
    /// Of `-x` that of x.
    unsigned: Option<Strength>,
}

impl Tex {
    fn new(strength: Strength, text: impl Into<String>) -> Self {
        Self { text: text.into(), strength, unsigned: None }
    }

    fn atom(text: impl Into<String>) -> Self {
        Self::new(Strength::Atom, text)
    }

    /// Its text where at least `around` is needed.
    fn within(&self, around: Strength) -> String {
        if self.strength < around { format!(r"\left({}\right)", self.text) } else { self.text.clone() }
    }

    fn negated(&self) -> Self {
        let unsigned = Some(self.strength.max(Strength::Series));
        Self { unsigned, ..Self::new(Strength::Sum, format!("-{}", self.last())) }
    }

    /// Without its minus, which stands in front of the whole product then.
    fn without_sign(self) -> (bool, Self) {
        match (self.unsigned, self.text.strip_prefix('-')) {
            (Some(strength), Some(text)) => (true, Self::new(strength, text)),
            _ => (false, self),
        }
    }

    /// The same, or with the minus of its first factor.
    fn signed(self, is_negative: bool) -> Self {
        if is_negative { self.negated() } else { self }
    }

    /// Its text as the last factor of a product.
    fn last(&self) -> String {
        self.within(Strength::Series)
    }
}

/// What walks formulas.
#[derive(Debug, Default)]
pub(crate) struct Typesetter {
    /// The coordinates that are rotations, whose nine entries have two indices on paper, each with the
    /// number of indices that it is one with.
    rotations: Vec<(String, usize)>,
    /// The names of vectors, each with the number of indices that it is one with.
    vectors: Vec<(String, usize)>,
    /// Names that have indices: of `a`, `a0` is no entry, and keeps its name as it is.
    arrays: Vec<String>,
    /// The `let`s of the formula at hand: names, and the terms of their values.
    lets: Vec<(String, Vec<String>)>,
}

impl Typesetter {
    pub(crate) fn new(attribute: &Attribute, vectors: Vec<(String, usize)>) -> Self {
        let rotations = attribute.coordinates.iter().filter(|block| block.factor == Factor::Rotation);
        let rotations =
            rotations.map(|block| (block.name.to_string(), usize::from(block.size.is_some()))).collect();
        let mut arrays = Arrays::default();
        attribute.formulas().for_each(|formula| arrays.visit_expr(formula));
        Self { rotations, vectors, arrays: arrays.0, lets: Vec::new() }
    }

    /// `name` = `formula`, with the `let`s in it.
    fn equation(&mut self, name: impl Into<String>, formula: &Expr) -> Equation {
        let terms = self.terms(formula);
        Equation::new(name.into(), terms, std::mem::take(&mut self.lets))
    }

    /// The terms of a sum, each with its sign.
    fn terms(&mut self, formula: &Expr) -> Vec<String> {
        match formula {
            Expr::Paren(inner) => self.terms(&inner.expr),
            Expr::Block(block) => {
                self.bindings(&block.block);
                last_value(&block.block).map_or_else(Vec::new, |value| self.terms(value))
            }
            Expr::Binary(binary) if matches!(binary.op, BinOp::Add(_)) => {
                let mut terms = self.terms(&binary.left);
                let rest = self.terms(&binary.right).into_iter();
                terms.extend(
                    rest.map(|term| if term.starts_with(['-', '+']) { term } else { format!("+ {term}") }),
                );
                terms
            }
            Expr::Binary(binary) if matches!(binary.op, BinOp::Sub(_)) => {
                let mut terms = self.terms(&binary.left);
                terms.push(format!("- {}", self.expr(&binary.right).last()));
                terms
            }
            other => vec![self.expr(other).text],
        }
    }

    /// What all formulas share by a `let`.
    pub(crate) fn definition(&mut self, local: &Local) -> Vec<Equation> {
        self.define(local);
        let lets = std::mem::take(&mut self.lets).into_iter();
        lets.map(|(name, terms)| Equation::new(name, terms, Vec::new())).collect()
    }

    /// Takes down the `let`s of a block.
    fn bindings(&mut self, block: &syn::Block) {
        for statement in &block.stmts {
            if let Stmt::Local(local) = statement {
                self.define(local);
            }
        }
    }

    fn define(&mut self, local: &Local) {
        let Some(init) = crate::syntax::value(local) else { return };
        match (&local.pat, closure(init)) {
            (pat, Some(function)) => {
                let parameters: Vec<String> =
                    function.inputs.iter().map(|parameter| self.pattern(parameter)).collect();
                let name = format!(r"{}\left({}\right)", self.pattern(pat), parameters.join(", "));
                let value = self.terms(&function.body);
                self.lets.push((name, value));
            }
            (Pat::Tuple(names), None) => self.tuple(names, init),
            (pat, None) => {
                let value = self.terms(init);
                if self.is_vector(init) {
                    self.vectors.extend(bound(pat).into_iter().map(|name| (name.to_string(), 0)));
                }
                let name = self.pattern(pat);
                self.lets.push((name, value));
            }
        }
    }

    /// Takes down the names of `let (a, b) = (…, …)` and of `let (s, c) = x.sin_cos()`.
    fn tuple(&mut self, names: &syn::PatTuple, init: &Expr) {
        let names: Vec<String> = names.elems.iter().map(|name| self.pattern(name)).collect();
        let values: Vec<Vec<String>> = match init {
            Expr::Tuple(list) => list.elems.iter().map(|value| self.terms(value)).collect(),
            Expr::MethodCall(call) => {
                ["sin", "cos"].map(|name| vec![self.function(name, &[&call.receiver]).text]).into()
            }
            other => vec![vec![plain(&text(other))]],
        };
        self.lets.extend(names.into_iter().zip(values));
    }

    fn pattern(&mut self, pattern: &Pat) -> String {
        bound(pattern).first().map_or_else(|| plain(&text(pattern)), |name| self.symbol(&name.to_string()))
    }

    fn statements(&mut self, block: &syn::Block) -> Tex {
        self.bindings(block);
        match last_value(block) {
            Some(value) => self.expr(value),
            None => Tex::atom(plain(&text(block))),
        }
    }

    fn expr(&mut self, formula: &Expr) -> Tex {
        match formula {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Int(digits) => Tex::atom(number(digits.base10_digits())),
                Lit::Float(digits) => Tex::atom(number(digits.base10_digits())),
                other => Tex::atom(plain(&text(other))),
            },
            Expr::Paren(inner) => self.expr(&inner.expr),
            Expr::Group(inner) => self.expr(&inner.expr),
            Expr::Cast(cast) => self.expr(&cast.expr),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => self.expr(&unary.expr).negated(),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Path(_) | Expr::Field(_) => Tex::atom(self.name(formula)),
            Expr::Index(_) => Tex::atom(self.indexed(formula)),
            Expr::Array(list) => {
                let components: Vec<String> =
                    list.elems.iter().map(|component| self.expr(component).text).collect();
                Tex::atom(format!(r"\left({}\right)", components.join(", ")))
            }
            Expr::MethodCall(call) => {
                let arguments: Vec<&Expr> = std::iter::once(&*call.receiver).chain(&call.args).collect();
                self.function(&call.method.to_string(), &arguments)
            }
            Expr::Call(call) => self.call(call),
            Expr::Block(block) => self.statements(&block.block),
            Expr::If(choice) => self.choice(choice),
            other => Tex::atom(plain(&text(other))),
        }
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> Tex {
        let [left, right] = [&binary.left, &binary.right].map(|part| self.expr(part));
        match binary.op {
            BinOp::Add(_) => {
                let is_negative = right.text.starts_with('-');
                let right = if is_negative { right.within(Strength::Product) } else { right.text };
                Tex::new(Strength::Sum, format!("{} + {right}", left.text))
            }
            BinOp::Sub(_) => Tex::new(Strength::Sum, format!("{} - {}", left.text, right.last())),
            BinOp::Mul(_) => {
                let is_series = right.strength == Strength::Series;
                let strength = if is_series { Strength::Series } else { Strength::Product };
                let is_digit = |first: char| first.is_ascii_digit();
                let (is_negative, left) = left.without_sign();
                let [left, right] = [left.within(Strength::Product), right.last()];
                let sign = if right.starts_with(is_digit) { r"\cdot" } else { r"\," };
                Tex::new(strength, format!("{left} {sign} {right}")).signed(is_negative)
            }
            BinOp::Div(_) => {
                let (is_negative, above) = left.without_sign();
                let fraction = format!(r"\frac{{{}}}{{{}}}", above.text, right.text);
                Tex::new(Strength::Product, fraction).signed(is_negative)
            }
            BinOp::Rem(_) => {
                let [left, right] = [left, right].map(|part| part.within(Strength::Product));
                Tex::new(Strength::Sum, format!(r"{left} \bmod {right}"))
            }
            _ => Tex::atom(plain(&text(binary))),
        }
    }

    fn choice(&mut self, choice: &ExprIf) -> Tex {
        let mut cases = String::new();
        let mut choice = choice;
        loop {
            let [then, condition] =
                [self.statements(&choice.then_branch).text, self.condition(&choice.cond)];
            let _ = write!(cases, r"{then} & \text{{if }} {condition} \\ ");
            match choice.else_branch.as_ref().map(|(_, otherwise)| &**otherwise) {
                Some(Expr::If(next)) => choice = next,
                otherwise => {
                    let otherwise = otherwise.map_or_else(String::new, |value| self.expr(value).text);
                    let _ = write!(cases, r"{otherwise} & \text{{otherwise}}");
                    return Tex::new(Strength::Series, format!(r"\begin{{cases}} {cases} \end{{cases}}"));
                }
            }
        }
    }

    fn condition(&mut self, condition: &Expr) -> String {
        match condition {
            Expr::Paren(inner) => format!(r"\left({}\right)", self.condition(&inner.expr)),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => {
                format!(r"\neg {}", self.condition(&unary.expr))
            }
            Expr::Binary(binary) => {
                let relation = match binary.op {
                    BinOp::Lt(_) => "<",
                    BinOp::Le(_) => r"\le",
                    BinOp::Gt(_) => ">",
                    BinOp::Ge(_) => r"\ge",
                    BinOp::And(_) | BinOp::Or(_) => {
                        let [left, right] = [&binary.left, &binary.right].map(|part| self.condition(part));
                        let word = if matches!(binary.op, BinOp::And(_)) { "and" } else { "or" };
                        return format!(r"{left} \text{{ {word} }} {right}");
                    }
                    _ => return plain(&text(condition)),
                };
                let [left, right] = [&binary.left, &binary.right].map(|part| self.expr(part).text);
                format!("{left} {relation} {right}")
            }
            other => plain(&text(other)),
        }
    }
}
