//! Rust that a formula cannot hold: each kind of it is reported once, with what to write instead.

use syn::{BinOp, Expr as Syntax, UnOp};

use super::Lowering;

impl Lowering<'_> {
    pub(super) fn unsupported(&mut self, syntax: &Syntax) {
        if let Syntax::Binary(binary) = syntax
            && matches!(binary.op, BinOp::BitXor(_))
        {
            self.not_a_power(binary, &binary.left, &binary.right);
            return;
        }
        let (kind, advice) = describe(syntax);
        self.errors.push_once(kind, syntax, format!("a formula cannot hold {kind}{advice}"));
    }
}

fn describe(syntax: &Syntax) -> (&'static str, &'static str) {
    match syntax {
        Syntax::Array(_) | Syntax::Repeat(_) => {
            ("a list", "; a list of components stands in `one_form = […]` only")
        }
        Syntax::Assign(_) => ("an assignment", "; name a value with `let`"),
        Syntax::Async(_) | Syntax::Await(_) => ("asynchronous code", "; all values are numbers"),
        Syntax::Break(_) | Syntax::Continue(_) | Syntax::Return(_) => {
            ("a jump", "; its value is its last expression")
        }
        Syntax::Closure(_) => ("a closure outside of a sum", "; write `sum(0..n, |j| …)`"),
        Syntax::ForLoop(_) | Syntax::Loop(_) | Syntax::While(_) => ("a loop", "; write `sum(0..n, |j| …)`"),
        Syntax::Macro(_) => ("a macro call", "; it is differentiated before macros are expanded"),
        Syntax::Match(_) => ("`match`", "; write `if … { … } else { … }`"),
        Syntax::Range(_) => ("a range outside of a sum", "; write `sum(0..n, |j| …)`"),
        Syntax::Reference(_) => ("a reference", "; all values are numbers"),
        Syntax::Struct(_) => ("a struct", "; all values are numbers"),
        Syntax::Tuple(_) => ("a tuple", "; all values are numbers"),
        Syntax::Try(_) => ("`?`", "; all values are numbers"),
        Syntax::Unsafe(_) => ("unsafe code", "; all values are numbers"),
        Syntax::Field(_) => ("fields of values", "; parameters are written `name`, `name[i]` or `self.name`"),
        Syntax::Path(_) => ("a qualified path", "; a constant is written `NAME` or `Type::NAME`"),
        Syntax::Let(_) => ("a pattern", "; a condition compares with `<`, `<=`, `>` or `>=`"),
        Syntax::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => {
            ("a dereference", "; all values are numbers")
        }
        Syntax::Unary(_) => ("`!` outside of a condition", "; write `if !(a < b) { … } else { … }`"),
        Syntax::Binary(binary) => match binary.op {
            BinOp::Rem(_) => ("`%` outside of an index", "; in an index it is written `x[(j + 1) % n]`"),
            BinOp::Eq(_) | BinOp::Ne(_) | BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_) => {
                ("a comparison outside of a condition", "; write `if a < b { … } else { … }`")
            }
            BinOp::And(_) | BinOp::Or(_) => {
                ("logic outside of a condition", "; write `if a < b && c < d { … } else { … }`")
            }
            BinOp::BitXor(_) | BinOp::BitAnd(_) | BinOp::BitOr(_) | BinOp::Shl(_) | BinOp::Shr(_) => {
                ("bit operations", "; all values are real numbers")
            }
            _ => ("an assignment", "; name a value with `let`"),
        },
        _ => ("this kind of expression", "; it is made of operators, methods of `f64`, `let`, `if` and sums"),
    }
}
