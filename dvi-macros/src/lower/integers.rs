//! Integers in real formulas: `as f64` behind integers that Rust would divide without a remainder.
//!
//! A formula is real: `1/2*x` is 0.5·x, as it is on paper. But `(3 / 2) as f64` is 1 in Rust, and the
//! `as` says that integers were meant; so a division of integers in front of an `as` is refused.

use syn::{BinOp, Expr as Syntax, Lit, UnOp};

use super::{Binding, Lowering, Written};
use crate::symbolic::Expr;
use crate::syntax::last_value;

impl Lowering<'_> {
    /// `value as f64`: numbers pass, and an index becomes a number.
    pub(super) fn cast(&mut self, cast: &syn::ExprCast) -> Option<Expr> {
        let is_float = matches!(&*cast.ty, syn::Type::Path(path) if path.path.is_ident("f64"));
        if !is_float {
            return self.refuse(&cast.ty, "formulas are real: only `as f64` is possible here");
        }
        if let Some(block) = block_with_names(&cast.expr) {
            return self.refuse(block, "write `as f64` at the integers inside of this block");
        }
        if let Some(division) = self.integer_division(&cast.expr) {
            let (left, right) = (&division.left, &division.right);
            let message = format!(
                "Rust would divide these integers and drop the remainder; write `{} / {}` for the quotient",
                Self::as_real(left),
                Self::as_real(right)
            );
            return self.refuse(&division, message);
        }
        if self.is_index(&cast.expr) {
            let index = self.index(&cast.expr)?;
            return Some(self.graph.count(index));
        }
        self.expr(&cast.expr)
    }

    /// The first division of two integers in an expression.
    fn integer_division(&mut self, syntax: &Syntax) -> Option<syn::ExprBinary> {
        match syntax {
            Syntax::Path(path) => match self.binding_of(&path.path.get_ident()?.to_string()) {
                Some(Binding::Value { written: Written::Quotient(division), .. }) => {
                    Some((**division).clone())
                }
                _ => None,
            },
            Syntax::Block(block) => self.integer_division(last_value(&block.block)?),
            Syntax::Paren(inner) => self.integer_division(&inner.expr),
            Syntax::Unary(unary) => self.integer_division(&unary.expr),
            Syntax::Binary(binary) => {
                let inside = self.integer_division(&binary.left);
                let inside = inside.or_else(|| self.integer_division(&binary.right));
                inside.or_else(|| {
                    let divides = matches!(binary.op, BinOp::Div(_));
                    (divides && self.may_be_integer(&binary.left) && self.may_be_integer(&binary.right))
                        .then(|| binary.clone())
                })
            }
            Syntax::MethodCall(call) => {
                let inside = self.integer_division(&call.receiver);
                inside.or_else(|| call.args.iter().find_map(|argument| self.integer_division(argument)))
            }
            Syntax::If(choice) => {
                let then = last_value(&choice.then_branch).and_then(|value| self.integer_division(value));
                let otherwise = choice.else_branch.as_ref();
                then.or_else(|| otherwise.and_then(|(_, otherwise)| self.integer_division(otherwise)))
            }
            _ => None,
        }
    }

    /// Whether Rust may take an expression for an integer: it does, or it is a constant or a field of a
    /// field, whose type is not known here.
    fn may_be_integer(&mut self, syntax: &Syntax) -> bool {
        let unknown = match syntax {
            Syntax::Paren(inner) => return self.may_be_integer(&inner.expr),
            Syntax::Path(path) => {
                let segments = &path.path.segments;
                let is_std =
                    |segment: &syn::PathSegment| segment.ident == "consts" || segment.ident == "f64";
                segments.len() > 1 && !segments.iter().any(is_std)
            }
            Syntax::Field(field) => is_part_of_field(&field.base),
            Syntax::Index(index) => {
                matches!(&*index.expr, Syntax::Field(field) if is_part_of_field(&field.base))
            }
            _ => false,
        };
        unknown || self.is_integer(syntax)
    }

    /// Whether Rust takes an expression for an integer: it is made of literals without a point, indices,
    /// sizes and integer fields.
    fn is_integer(&mut self, syntax: &Syntax) -> bool {
        match syntax {
            Syntax::Lit(literal) => {
                matches!(&literal.lit, Lit::Int(value) if !value.suffix().starts_with('f'))
            }
            Syntax::Paren(inner) => self.is_integer(&inner.expr),
            Syntax::Unary(unary) => matches!(unary.op, UnOp::Neg(_)) && self.is_integer(&unary.expr),
            Syntax::Binary(binary) => self.is_integer(&binary.left) && self.is_integer(&binary.right),
            Syntax::Path(path) => match path.path.get_ident() {
                Some(name) => match self.binding_of(&name.to_string()) {
                    Some(Binding::Value { written, .. }) => !matches!(written, Written::Real),
                    Some(Binding::Index { .. }) => true,
                    Some(Binding::Function(_)) => false,
                    None => self.model.is_integer_field(syntax) || self.model.size(syntax).is_some(),
                },
                None => false,
            },
            Syntax::Field(_) | Syntax::Index(_) => self.model.is_integer_field(syntax),
            Syntax::MethodCall(call) => {
                let keeps = ["abs", "min", "max", "pow"].iter().any(|name| call.method == name);
                call.method == "len" || (keeps && self.is_integer(&call.receiver))
            }
            Syntax::If(choice) => {
                let then = last_value(&choice.then_branch).is_some_and(|value| self.is_integer(value));
                then && choice.else_branch.as_ref().is_some_and(|(_, otherwise)| self.is_integer(otherwise))
            }
            Syntax::Block(block) => last_value(&block.block).is_some_and(|value| self.is_integer(value)),
            _ => false,
        }
    }

    /// What Rust takes a value for.
    pub(super) fn written(&mut self, syntax: &Syntax) -> Written {
        match (self.is_integer(syntax), self.integer_division(syntax)) {
            (false, _) => Written::Real,
            (true, None) => Written::Integer,
            (true, Some(division)) => Written::Quotient(Box::new(division)),
        }
    }

    /// A number as it is written where a real one is needed.
    pub(super) fn real_text(&mut self, syntax: &Syntax) -> String {
        if self.is_integer(syntax) { Self::as_real(syntax) } else { crate::errors::text(syntax) }
    }

    /// An integer as a real number in Rust.
    fn as_real(syntax: &Syntax) -> String {
        match syntax {
            Syntax::Lit(syn::ExprLit { lit: Lit::Int(value), .. }) => format!("{}.0", value.base10_digits()),
            Syntax::Binary(_) | Syntax::If(_) => format!("(({}) as f64)", crate::errors::text(syntax)),
            other => format!("({} as f64)", crate::errors::text(other)),
        }
    }
}

/// A block that binds names, in parentheses or not.
fn block_with_names(syntax: &Syntax) -> Option<&syn::ExprBlock> {
    match syntax {
        Syntax::Paren(inner) => block_with_names(&inner.expr),
        Syntax::Block(block) => (block.block.stmts.len() > 1).then_some(block),
        _ => None,
    }
}

/// Whether this is a field, so that what stands behind it belongs to a struct whose fields are not known
/// here.
fn is_part_of_field(base: &Syntax) -> bool {
    match base {
        Syntax::Path(path) => !path.path.is_ident("self"),
        _ => true,
    }
}
