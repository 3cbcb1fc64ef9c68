//! What expressions are made of: functions that a `let` of a formula names, names that a pattern gives,
//! places in arrays, and values of blocks.

use syn::punctuated::Punctuated;
use syn::{Block, Expr, ExprArray, ExprClosure, ExprLit, ExprTuple, Ident, Lit, Member, Pat, Stmt, Token};

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

/// The name that an expression is.
pub(crate) fn ident(syntax: &Expr) -> Option<&Ident> {
    match syntax {
        Expr::Path(path) => path.path.get_ident(),
        _ => None,
    }
}

/// `name` in `name` and in `self.name`.
pub(crate) fn name_of(syntax: &Expr) -> Option<&Ident> {
    ident(syntax).or_else(|| own_field(syntax))
}

/// The value of an integer literal, in parentheses or not.
pub(crate) fn literal(syntax: &Expr) -> Option<i64> {
    match syntax {
        Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => value.base10_parse().ok(),
        Expr::Paren(inner) => literal(&inner.expr),
        _ => None,
    }
}

/// `name` in `self.name`.
pub(crate) fn own_field(syntax: &Expr) -> Option<&Ident> {
    let Expr::Field(field) = syntax else { return None };
    match (&*field.base, &field.member) {
        (Expr::Path(base), Member::Named(name)) if base.path.is_ident("self") => Some(name),
        _ => None,
    }
}

/// `a` and `b` of `[a, b]` and of `(a, b)`.
pub(crate) fn elements(syntax: &Expr) -> Option<&Punctuated<Expr, Token![,]>> {
    match syntax {
        Expr::Array(ExprArray { elems, .. }) | Expr::Tuple(ExprTuple { elems, .. }) => Some(elems),
        _ => None,
    }
}

/// `x` and `i`, `j` of `x[i][j]`.
pub(crate) fn indexed(mut syntax: &Expr) -> (&Expr, Vec<&Expr>) {
    let mut indices = Vec::new();
    while let Expr::Index(place) = syntax {
        indices.insert(0, &*place.index);
        syntax = &place.expr;
    }
    (syntax, indices)
}

/// The expression at the end of a block.
pub(crate) fn last_value(block: &Block) -> Option<&Expr> {
    match block.stmts.last() {
        Some(Stmt::Expr(value, None)) => Some(value),
        _ => None,
    }
}
