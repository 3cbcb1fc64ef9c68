//! Rust that a formula cannot hold: each kind of it is reported once, with what to write instead.

use syn::{BinOp, Expr as Syntax, Member, Pat, UnOp};

use super::{Binding, Lowering, Value};
use crate::errors::text;
use crate::syntax::{ident, indexed};
use crate::words::is_method;

impl Lowering<'_> {
    pub(super) fn unsupported<T>(&mut self, syntax: &Syntax) -> Option<T> {
        if let Some(message) = self.meant_by(syntax) {
            return self.refuse(syntax, message);
        }
        let (kind, advice) = describe(syntax);
        self.errors.refuse_once(kind, syntax, format!("a formula cannot hold {kind}{advice}"))
    }

    /// What to write for `r[i].x` of a vector.
    fn component_called(&self, field: &syn::ExprField) -> Option<String> {
        let Member::Named(name) = &field.member else { return None };
        let component = ["x", "y", "z"].iter().position(|axis| name == axis)?;
        let root = ident(indexed(&field.base).0)?;
        let index = match self.binding_of(&root.to_string()) {
            Some(Binding::Value { value: Some(Value::Vector(_)), .. }) => "",
            Some(_) => return None,
            None => {
                let first = self.model.coordinate_of(root)?.start;
                let is_array = self.model.blocks[first].axis.is_some();
                if !is_array && self.model.whole(first).is_none() {
                    return None;
                }
                if is_array && matches!(&*field.base, Syntax::Path(_)) { "[i]" } else { "" }
            }
        };
        Some(format!("a component of a vector is written `{}{index}[{component}]`", text(&field.base)))
    }

    /// What to write for that which comes from elsewhere.
    fn meant_by(&self, syntax: &Syntax) -> Option<String> {
        match syntax {
            // |x| * y
            Syntax::Closure(closure) => match closure.inputs.first() {
                Some(Pat::Ident(of))
                    if closure.inputs.len() == 1 && self.is_declared(&of.ident.to_string()) =>
                {
                    Some(format!("an absolute value is written `{}.abs()`", of.ident))
                }
                _ => None,
            },
            Syntax::Field(field) => self.component_called(field).or_else(|| {
                if let Member::Named(method) = &field.member
                    && is_method(&method.to_string())
                {
                    let written = Self::as_method(&method.to_string(), Some(&field.base), &[]);
                    return Some(format!("write `{written}`"));
                }
                let of = text(&field.base);
                let block = self.model.blocks.iter().find(|block| block.name == of)?;
                match &field.member {
                    Member::Unnamed(index) => Some(format!("an entry is written `{of}[{}]`", index.index)),
                    Member::Named(name) if name == "dot" => {
                        self.velocity_called(&block.velocity_name().to_string())
                    }
                    Member::Named(_) => None,
                }
            }),
            _ => None,
        }
    }
}

fn describe(syntax: &Syntax) -> (&'static str, &'static str) {
    match syntax {
        Syntax::Repeat(_) => ("a list of equal entries", "; a vector is written `[a, b, c]`"),
        Syntax::Assign(_) => ("an assignment", "; name a value with `let`"),
        Syntax::Async(_) | Syntax::Await(_) => ("asynchronous code", "; all values are numbers"),
        Syntax::Break(_) | Syntax::Continue(_) | Syntax::Return(_) => {
            ("a jump", "; its value is its last expression")
        }
        Syntax::Closure(_) => {
            ("a closure outside of a sum", "; write `sum(0..n, |j| …)`, or name it: `let f = |a| …;`")
        }
        Syntax::ForLoop(_) | Syntax::Loop(_) | Syntax::While(_) => ("a loop", "; write `sum(0..n, |j| …)`"),
        Syntax::Macro(_) => ("a macro call", "; it is differentiated before macros are expanded"),
        Syntax::Match(_) => ("`match`", "; write `if … { … } else { … }`"),
        Syntax::Range(_) => ("a range outside of a sum", "; write `sum(0..n, |j| …)`"),
        Syntax::Reference(_) => ("a reference", "; all values are numbers"),
        Syntax::Struct(_) => ("a struct", "; all values are numbers"),
        Syntax::Tuple(_) => ("a tuple", "; all values are numbers"),
        Syntax::Try(_) => ("`?`", "; all values are numbers"),
        Syntax::Unsafe(_) => ("unsafe code", "; all values are numbers"),
        Syntax::Field(_) => {
            ("fields of values", "; parameters are written `name`, `name[i]`, `name.field` or `self.name`")
        }
        Syntax::Path(_) => ("a qualified path", "; a constant is written `NAME` or `Type::NAME`"),
        Syntax::Let(_) => ("a pattern", "; a condition compares with `<`, `<=`, `>` or `>=`"),
        Syntax::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => {
            ("a dereference", "; all values are numbers")
        }
        Syntax::Unary(_) => ("`!` outside of a condition", "; write `if !(a < b) { … } else { … }`"),
        Syntax::Binary(binary) => match binary.op {
            BinOp::Rem(_) => (
                "`%` outside of an index",
                "; in an index it is written `x[(j + 1) % n]`, and the remainder of a number is a function \
                 of your own, declared by `functions(f = [f, df, d2f])`",
            ),
            BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) => {
                ("a comparison outside of a condition", "; write `if a < b { … } else { … }`")
            }
            BinOp::And(_) | BinOp::Or(_) => {
                ("logic outside of a condition", "; write `if a < b && c < d { … } else { … }`")
            }
            BinOp::BitAnd(_) | BinOp::BitOr(_) | BinOp::Shl(_) | BinOp::Shr(_) => {
                ("bit operations", "; all values are real numbers")
            }
            _ => ("an assignment", "; name a value with `let`"),
        },
        _ => {
            ("this kind of expression", "; it is made of operators, methods of `f64`, `let`, `if` and sums")
        }
    }
}
