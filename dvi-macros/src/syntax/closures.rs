//! Functions that a `let` of a formula names, and names that a pattern gives.

use syn::{Expr, ExprClosure, Ident, Pat};

/// `|a, b| …`, in parentheses or not.
pub(crate) fn closure(syntax: &Expr) -> Option<&ExprClosure> {
    match syntax {
        Expr::Paren(inner) => closure(&inner.expr),
        Expr::Closure(closure) => Some(closure),
        _ => None,
    }
}

/// The names of a pattern; patterns of another kind are refused where formulas are read.
pub(crate) fn bound(pattern: &Pat) -> Vec<&Ident> {
    match pattern {
        Pat::Ident(name) => vec![&name.ident],
        Pat::Type(typed) => bound(&typed.pat),
        Pat::Tuple(list) => list.elems.iter().flat_map(bound).collect(),
        _ => Vec::new(),
    }
}
