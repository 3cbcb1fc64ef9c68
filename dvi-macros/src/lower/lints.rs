//! Warnings: names of a formula that nothing uses, and indices that hide others.
//!
//! Stable Rust lets a macro warn of nothing, but the compiler warns of what the macro writes. For a name
//! without a use this is an argument without a use, at the place of that name:
//! ```text
//! const _: () = { fn unused(radius: ()) {} };
//! ```
//! For a hidden index it is the use of something deprecated, whose note is the warning.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::visit::Visit;
use syn::{Expr, Ident, Pat, Stmt};

use crate::syntax::{Member, bound, closure, value};

/// A name of an inner scope.
struct Local {
    name: Ident,
    index: bool,
    used: bool,
}

#[derive(Default)]
struct Names {
    open: Vec<Local>,
    unused: Vec<Ident>,
    hidden: Vec<Ident>,
}

/// Whether a formula names an index that is bound around it.
pub(super) fn uses(formula: &Expr, index: &Ident) -> bool {
    let mut names = Names::default();
    names.open.push(Local { name: index.clone(), index: true, used: false });
    names.visit_expr(formula);
    names.open.iter().any(|local| local.used)
}

/// The warnings of all formulas, each with the indices that are bound around it, and of the names that they
/// share, as items that the compiler warns of.
pub(crate) fn warnings<'a>(
    shared: &'a [syn::Local],
    formulas: impl Iterator<Item = (&'a Expr, &'a [Member])>,
) -> TokenStream {
    let mut names = Names::default();
    shared.iter().for_each(|local| names.define(local));
    for (formula, members) in formulas {
        let outside = names.open.len();
        let local = |member: &Member| Local { name: member.index.clone(), index: true, used: true };
        names.open.extend(members.iter().map(local));
        names.visit_expr(formula);
        names.close(outside);
    }
    names.close(0);
    let unused = names.unused.iter().map(|name| {
        quote!(const _: () = {
            #[allow(dead_code, non_snake_case)]
            fn unused(#name: ()) {}
        };)
    });
    let hidden = names.hidden.iter().map(|name| {
        let note =
            format!("it hides the index `{name}` of a sum around this one; give one of them another name");
        let span = name.span();
        let place = Ident::new("index", span);
        quote_spanned! {span=>
            const _: () = {
                #[deprecated(note = #note)]
                #[allow(non_upper_case_globals)]
                const #place: () = ();
                #place
            };
        }
    });
    quote!(#(#unused)* #(#hidden)*)
}

impl Names {
    fn define(&mut self, local: &syn::Local) {
        match value(local).map(|value| (closure(value), value)) {
            Some((Some(closure), _)) => self.visit_body(closure, false, false),
            Some((None, value)) => self.visit_expr(value),
            None => {}
        }
        self.bind(&local.pat, false);
    }

    /// A body with names bound around it, which are used in any case or not: indices, or parameters, which
    /// hide no index by mistake.
    fn visit_body(&mut self, closure: &syn::ExprClosure, index: bool, used: bool) {
        let outside = self.open.len();
        closure.inputs.iter().for_each(|input| self.bind(input, index));
        self.open[outside..].iter_mut().for_each(|local| local.used = used);
        self.visit_expr(&closure.body);
        self.close(outside);
    }

    fn bind(&mut self, pattern: &Pat, index: bool) {
        for name in bound(pattern) {
            if index && self.open.iter().any(|local| local.index && local.name == *name) {
                self.hidden.push(name.clone());
            }
            self.open.push(Local { name: name.clone(), index, used: false });
        }
    }

    fn close(&mut self, outside: usize) {
        let closed = self.open.split_off(outside);
        let unused =
            closed.into_iter().filter(|local| !local.used && !local.name.to_string().starts_with('_'));
        self.unused.extend(unused.map(|local| local.name));
    }
}

impl<'ast> Visit<'ast> for Names {
    fn visit_block(&mut self, block: &'ast syn::Block) {
        let outside = self.open.len();
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => self.define(local),
                other => self.visit_stmt(other),
            }
        }
        self.close(outside);
    }

    fn visit_expr_closure(&mut self, closure: &'ast syn::ExprClosure) {
        self.visit_body(closure, true, false);
    }

    /// A component `|j| 0.0` of a one-form has its index by its place in the list.
    fn visit_expr_array(&mut self, list: &'ast syn::ExprArray) {
        for component in &list.elems {
            match component {
                Expr::Closure(closure) => self.visit_body(closure, true, true),
                other => self.visit_expr(other),
            }
        }
    }

    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        if let Some(name) = path.path.get_ident()
            && let Some(local) = self.open.iter_mut().rev().find(|local| local.name == *name)
        {
            local.used = true;
        }
    }
}
