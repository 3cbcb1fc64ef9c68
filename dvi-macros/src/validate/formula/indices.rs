//! Index arithmetic of the text, on integers.

use syn::{BinOp, Expr, Lit};

use super::{Binding, Evaluation, NoValue, Value, place_text, unknown, written};

impl Evaluation<'_> {
    /// Whether an expression is index arithmetic: it names an index or a size.
    pub(super) fn is_index(&self, syntax: &Expr) -> bool {
        match syntax {
            Expr::Path(path) => {
                let text = self.texts.of(syntax, || written(path));
                match self.bound(&text) {
                    Some(binding) => {
                        matches!(binding, Binding::Index(_) | Binding::Argument(None, Some(_)))
                    }
                    None => self.size(&text).is_some(),
                }
            }
            Expr::Paren(inner) => self.is_index(&inner.expr),
            Expr::Binary(binary) => self.is_index(&binary.left) || self.is_index(&binary.right),
            Expr::MethodCall(call) => call.method == "len",
            _ => false,
        }
    }

    pub(super) fn index(&mut self, syntax: &Expr) -> Value<i64> {
        match syntax {
            Expr::Lit(literal) => match &literal.lit {
                Lit::Int(value) => Ok(value.base10_parse().unwrap_or_else(|_| unknown(syntax))),
                _ => unknown(syntax),
            },
            Expr::Paren(inner) => self.index(&inner.expr),
            Expr::Unary(unary) => Ok(-self.index(&unary.expr)?),
            Expr::Binary(binary) => {
                let (left, right) = (self.index(&binary.left)?, self.index(&binary.right)?);
                match binary.op {
                    BinOp::Add(_) => Ok(left + right),
                    BinOp::Sub(_) => Ok(left - right),
                    BinOp::Mul(_) => Ok(left * right),
                    BinOp::Rem(_) => left.checked_rem_euclid(right).ok_or(NoValue::OutOfRange),
                    _ => unknown(syntax),
                }
            }
            Expr::Path(_) | Expr::Field(_) | Expr::MethodCall(_) => {
                let name = self.texts.of(syntax, || place_text(syntax));
                match (self.bound(&name), self.size(&name)) {
                    (Some(Binding::Index(index) | Binding::Argument(_, Some(index))), _) => Ok(index),
                    (None, Some(size)) => Ok(size),
                    _ => unknown(syntax),
                }
            }
            _ => unknown(syntax),
        }
    }
}
