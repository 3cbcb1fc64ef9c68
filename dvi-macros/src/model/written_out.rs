//! Sums over the components of a vector, `sum(0..3, |k| r[i][k])`, and over pairs of them: each component has
//! a block of its own, so that such a sum is written out term by term.

use std::ops::Range;

use syn::visit::{self, Visit};
use syn::{Expr, ExprClosure, ExprIndex, ExprPath, Ident, Pat, PatIdent, RangeLimits};

use super::Model;
use super::vectors::COMPONENTS;
use crate::syntax::{indexed, literal};

impl Model {
    /// The values of the indices of a sum, where its range is literal and one of them numbers components in
    /// its body.
    pub(crate) fn written_out(&self, range: &Expr, closure: &ExprClosure) -> Option<Range<i64>> {
        let Expr::Range(range) = range else { return None };
        let first = range.start.as_ref().map_or(Some(0), |start| literal(start))?;
        let last = literal(range.end.as_ref()?)?;
        let past = last.saturating_add(i64::from(matches!(range.limits, RangeLimits::Closed(_))));
        let is_short = past.saturating_sub(first) <= *COMPONENTS.end();
        let numbers_components = |index: &Pat| {
            let Pat::Ident(PatIdent { ident: index, .. }) = index else { return false };
            let mut search = Search { model: self, index, is_component: false, found: false };
            search.visit_expr(&closure.body);
            search.found
        };
        // Of pairs there is at least one.
        let has_terms = past.saturating_sub(first) >= closure.inputs.len() as i64;
        (is_short && has_terms && closure.inputs.iter().any(numbers_components)).then_some(first..past)
    }

    /// Which index is that of a component behind a name or another expression, counted from 0.
    fn component_behind(&self, base: &Expr) -> Option<usize> {
        let name = match base {
            Expr::Path(path) => path.path.get_ident()?,
            Expr::Field(_) => return None,
            _ => return Some(0),
        };
        if let Some(block) = self.blocks.iter().find(|block| block.name == *name) {
            return block.axis.map(|_| block.sizes().len());
        }
        let is_parameter = self.parameters.iter().any(|parameter| *name == parameter.text);
        (!is_parameter).then_some(0)
    }
}

/// Looks for an index where components are numbered.
struct Search<'a> {
    model: &'a Model,
    index: &'a Ident,
    is_component: bool,
    found: bool,
}

impl<'ast> Visit<'ast> for Search<'_> {
    fn visit_expr_index(&mut self, place: &'ast ExprIndex) {
        let (base, before) = indexed(&place.expr);
        self.visit_expr(&place.expr);
        let around = self.is_component;
        self.is_component = self.model.component_behind(base) == Some(before.len());
        self.visit_expr(&place.index);
        self.is_component = around;
    }

    fn visit_expr_path(&mut self, path: &'ast ExprPath) {
        self.found |= self.is_component && path.path.is_ident(self.index);
        visit::visit_expr_path(self, path);
    }
}
