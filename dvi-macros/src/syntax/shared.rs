//! `let = { let r2 = x * x + y * y; let gap = |a, b| …; }`: names that all formulas of a system know.

use proc_macro2::{Ident, TokenStream};
use syn::{Expr, Local, Stmt};

use super::cut::value_of;
use super::{Attribute, form_of};
use crate::errors::{Errors, text};

/// The word that declares them.
const WORD: &str = "let";

impl Attribute {
    /// Takes down the definitions. Where one cannot be read, its name is lost.
    pub(super) fn accept_shared(&mut self, name: &Ident, tokens: TokenStream, errors: &mut Errors) {
        let Some(value) = value_of(name, tokens, errors) else {
            self.lost_names = true;
            return;
        };
        let Expr::Block(block) = value else {
            self.lost_names = true;
            errors.push(value, format!("names for all formulas are written `{}`", form_of(WORD)));
            return;
        };
        if block.block.stmts.is_empty() {
            errors.push(&block, format!("no name is defined here: write `{}`", form_of(WORD)));
        }
        for statement in block.block.stmts {
            match statement {
                Stmt::Local(local) => self.shared.push(local),
                other => {
                    self.lost_names = true;
                    errors.push(&other, no_definition(&other));
                }
            }
        }
    }

    /// What the shared names stand for, as it was written.
    pub(super) fn shared_values(&self) -> impl Iterator<Item = &Expr> {
        self.shared.iter().filter_map(value)
    }

    pub(super) fn shared_values_mut(shared: &mut [Local]) -> impl Iterator<Item = &mut Expr> {
        shared.iter_mut().filter_map(|local| local.init.as_mut()).map(|init| &mut *init.expr)
    }
}

/// What a `let` gives a name to.
pub(crate) fn value(local: &Local) -> Option<&Expr> {
    local.init.as_ref().filter(|init| init.diverge.is_none()).map(|init| &*init.expr)
}

fn no_definition(statement: &Stmt) -> String {
    match statement {
        Stmt::Expr(Expr::Assign(equation), _) => {
            format!("a name is defined by `let {} = {};`", text(&equation.left), text(&equation.right))
        }
        _ => "definitions stand here, each as `let name = …;`, and no value behind them: the formulas are arguments of \
              their own"
            .to_string(),
    }
}
