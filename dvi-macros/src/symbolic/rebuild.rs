//! Formulas again, with some nodes replaced.

use rustc_hash::FxHashMap as HashMap;

use super::graph::{Expr, Graph, Id, Node, leaf};
use super::index::{Atom, Range};

impl Graph {
    /// Rebuilds `root` with some nodes replaced, everything else through the constructors.
    pub(crate) fn rebuild(&mut self, root: Id, replace: impl FnMut(&mut Self, Id) -> Option<Expr>) -> Expr {
        self.rebuild_with(root, replace, Range::clone)
    }

    pub(super) fn rebuild_with(
        &mut self,
        root: Id,
        mut replace: impl FnMut(&mut Self, Id) -> Option<Expr>,
        range: impl Fn(&Range) -> Range,
    ) -> Expr {
        let mut new: HashMap<Id, Expr> = HashMap::default();
        for id in self.reachable([root]) {
            let value = match replace(self, id) {
                Some(value) => value,
                None => self.rebuilt(id, &new, &range),
            };
            new.insert(id, value);
        }
        new[&root]
    }

    fn rebuilt(&mut self, id: Id, new: &HashMap<Id, Expr>, range: &impl Fn(&Range) -> Range) -> Expr {
        let of = |old: &Expr| new[&old.node].scaled(old.scale);
        match self.node(id).clone() {
            Node::Sum(terms) => {
                let terms: Vec<Expr> = terms.iter().map(of).collect();
                if self.unsigned_sums.contains(&id) { self.unsigned_sum(&terms) } else { self.sum(&terms) }
            }
            Node::Product(factors) => {
                let powers: Vec<Expr> =
                    factors.iter().map(|(factor, exponent)| self.power(new[factor], *exponent)).collect();
                self.product(&powers)
            }
            Node::Reciprocal(operand) => self.reciprocal(new[&operand]),
            Node::Unary(function, operand) => self.unary(function, of(&operand)),
            Node::Binary(function, a, b) => self.binary(function, of(&a), of(&b)),
            Node::Call(function, order, operand) => self.call(function, order, of(&operand)),
            Node::ScalarField(field, partial, at) => {
                self.scalar_field(field, partial, at.iter().map(of).collect())
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                self.choose(of(&left), relation, of(&right), of(&then), of(&otherwise))
            }
            Node::Reduce { fold, height, range: known, body } => {
                self.fold(fold, Atom::Bound(height), range(&known), of(&body))
            }
            Node::One | leaf!() => id.into(),
        }
    }

    /// The value at v = 0.
    pub(crate) fn at_rest(&mut self, of: Expr) -> Expr {
        let still = |graph: &mut Self, id| graph.node(id).is_velocity().then_some(Expr::ZERO);
        self.rebuild(of.node, still).scaled(of.scale)
    }
}
