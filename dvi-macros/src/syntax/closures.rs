//! Functions that a `let` of a formula names.

use syn::{Expr, ExprClosure};

/// `|a, b| …`, in parentheses or not.
pub(crate) fn closure(syntax: &Expr) -> Option<&ExprClosure> {
    match syntax {
        Expr::Paren(inner) => closure(&inner.expr),
        Expr::Closure(closure) => Some(closure),
        _ => None,
    }
}
