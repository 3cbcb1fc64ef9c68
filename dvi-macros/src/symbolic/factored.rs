//! Sums that derivatives produce: nobody wrote them, so that common factors may go out of them, and a
//! constant over a denominator.

use super::graph::{Expr, Graph, Id, Node};

impl Graph {
    /// A sum that a derivative produced: its common factors go out, and a constant joins a quotient
    /// where that makes the quotient's numerator no longer: 1 − 2x²/(x² + y²) = (y² − x²)/(x² + y²).
    pub(super) fn factored_sum(&mut self, terms: &[Expr]) -> Expr {
        let total = self.unsigned_sum(terms);
        let Node::Sum(terms) = self.node(total.node).clone() else { return total };
        if terms.len() == 1 {
            return total;
        }
        let shared = self.shared_factors(&terms);
        if !shared.is_empty() {
            let rest: Vec<Expr> = terms.iter().map(|term| self.without(*term, &shared)).collect();
            let rest = self.factored_sum(&rest);
            let shared: Vec<Expr> =
                shared.iter().map(|(id, exponent)| self.power((*id).into(), *exponent)).collect();
            let shared = self.product(&shared);
            return self.multiply(rest, shared).scaled(total.scale);
        }
        match terms.as_slice() {
            [constant, quotient] if constant.node == Self::ONE => {
                match self.over_denominator(*constant, *quotient) {
                    Some(joined) => joined.scaled(total.scale),
                    None => total,
                }
            }
            _ => total,
        }
    }

    fn shared_factors(&self, terms: &[Expr]) -> Vec<(Id, u32)> {
        let mut shared = terms.first().map_or_else(Vec::new, |first| self.factors(first.node));
        for term in terms.iter().skip(1) {
            let factors = self.factors(term.node);
            shared.retain_mut(|(id, exponent)| match factors.iter().find(|(other, _)| other == id) {
                Some((_, other)) => {
                    *exponent = (*exponent).min(*other);
                    true
                }
                None => false,
            });
        }
        shared
    }

    /// `term` divided by factors that it is known to have.
    fn without(&mut self, term: Expr, divisor: &[(Id, u32)]) -> Expr {
        let kept: Vec<Expr> = self
            .factors(term.node)
            .into_iter()
            .filter_map(|(id, exponent)| {
                let taken = divisor.iter().find(|(other, _)| *other == id).map_or(0, |(_, taken)| *taken);
                (exponent > taken).then(|| self.power(id.into(), exponent - taken))
            })
            .collect();
        self.product(&kept).scaled(term.scale)
    }

    /// constant + k·m/D over D, if m is one of the terms of D.
    fn over_denominator(&mut self, constant: Expr, quotient: Expr) -> Option<Expr> {
        for (factor, _) in self.factors(quotient.node) {
            let Node::Reciprocal(denominator) = *self.node(factor) else { continue };
            let Node::Sum(parts) = self.node(denominator).clone() else { continue };
            let numerator = self.without(quotient, &[(factor, 1)]);
            if parts.iter().any(|part| part.node == numerator.node) {
                let mut terms: Vec<Expr> = parts.iter().map(|part| part.scaled(constant.scale)).collect();
                terms.push(numerator);
                let joined = self.unsigned_sum(&terms);
                return Some(self.multiply(joined, factor.into()));
            }
        }
        None
    }
}
