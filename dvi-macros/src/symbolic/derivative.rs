//! Differentiation in forward mode, over the local scalars of one term.
//!
//! [`Graph::derivative`] is the tangent of one expression along one node. A formula with sums has as
//! many coordinates as its sizes say, but only a few *local* ones: the coordinates that its text
//! mentions, inside the sums that they stand in. [`Graph::gradient`] differentiates with respect to
//! those and says where each result goes: a [`Contribution`] is a loop nest, a target and a value, and
//! ∂f/∂qⁱ is the sum of the contributions that land on i. A sum stays a sum; its derivative with
//! respect to a coordinate from outside is the sum of the derivatives, with respect to its own
//! coordinates a scatter, weighted by ∂f/∂(the sum). [`Graph::hessian`] does this twice.

use super::graph::{Expr, Graph, Id, Node};
use super::index::Binder;

/// `value`, added to the entry `target` in every pass of the loops.
#[derive(Clone, Debug)]
pub(crate) struct Contribution {
    pub(crate) loops: Vec<Binder>,
    /// A coordinate or velocity node.
    pub(crate) target: Id,
    pub(crate) value: Expr,
}

/// `value`, added to the entry (`row`, `column`) in every pass of the loops, and to its mirror image
/// too if `mirrored`.
#[derive(Clone, Debug)]
pub(crate) struct SecondContribution {
    pub(crate) loops: Vec<Binder>,
    pub(crate) row: Id,
    pub(crate) column: Id,
    pub(crate) value: Expr,
    pub(crate) mirrored: bool,
}

fn levels(loops: &[Binder]) -> u64 {
    loops.iter().fold(0, |levels, binder| levels | 1 << binder.level)
}

impl Graph {
    /// ∂of/∂by with `by` taken as an independent variable, whatever it depends on.
    pub(crate) fn derivative(&mut self, of: Expr, by: Id) -> Expr {
        self.node_derivative(of.node, by).scaled(of.scale)
    }

    pub(super) fn node_derivative(&mut self, of: Id, by: Id) -> Expr {
        if of == by {
            return Expr::ONE;
        }
        // An operand has a smaller id than the node that uses it.
        if of < by {
            return Expr::ZERO;
        }
        if let Some(known) = self.derivatives.get(&(of, by)) {
            return *known;
        }
        let derivative = self.apply_rule(of, by);
        self.derivatives.insert((of, by), derivative);
        derivative
    }

    fn apply_rule(&mut self, of: Id, by: Id) -> Expr {
        match self.node(of).clone() {
            Node::Sum(terms) => {
                let tangents: Vec<Expr> = terms.iter().map(|term| self.derivative(*term, by)).collect();
                self.factored_sum(&tangents)
            }
            Node::Product(factors) => self.product_derivative(&factors, by),
            Node::Reciprocal(u) => self.reciprocal_derivative(of, u, by),
            Node::Unary(function, u) => {
                self.chain(u, by, |graph| graph.unary_derivative(function, u, of.into()))
            }
            Node::Call(function, order, u) => self.chain(u, by, |graph| graph.call(function, order + 1, u)),
            Node::Binary(function, a, b) => {
                let tangents = [self.derivative(a, by), self.derivative(b, by)];
                if tangents.iter().all(|tangent| tangent.is_zero()) {
                    return Expr::ZERO;
                }
                let partials = self.binary_derivatives(function, a, b, of.into());
                let terms =
                    [self.multiply(partials[0], tangents[0]), self.multiply(partials[1], tangents[1])];
                self.factored_sum(&terms)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let (then, otherwise) = (self.derivative(then, by), self.derivative(otherwise, by));
                self.choose(left, relation, right, then, otherwise)
            }
            // A variable that depends on the level of this sum is not the one bound inside of it.
            Node::Reduce(binder, _) if self.free(by) & (1 << binder.level) != 0 => Expr::ZERO,
            Node::Reduce(binder, body) => {
                let tangent = self.node_derivative(body, by);
                self.reduce(binder, tangent)
            }
            _ => Expr::ZERO,
        }
    }

    fn chain(&mut self, inner: Expr, by: Id, outer: impl FnOnce(&mut Self) -> Expr) -> Expr {
        let tangent = self.derivative(inner, by);
        if tangent.is_zero() {
            return Expr::ZERO;
        }
        let outer = outer(self);
        self.multiply(outer, tangent)
    }

    /// The gradient of `root`, which stands inside `loops`, by all coordinates and velocities.
    pub(crate) fn gradient(&mut self, root: Expr, loops: &[Binder]) -> Vec<Contribution> {
        let mut found = Vec::new();
        self.collect(root, Expr::ONE, loops, None, &mut found);
        found
    }

    /// Adds the contributions of weight · body; with `newest` given, only those of variables that
    /// depend on that level, because the others were taken further out.
    fn collect(
        &mut self,
        body: Expr,
        weight: Expr,
        loops: &[Binder],
        newest: Option<u32>,
        found: &mut Vec<Contribution>,
    ) {
        let open = levels(loops);
        let belongs = |free: u64| free & !open == 0 && newest.is_none_or(|level| free & (1 << level) != 0);
        let local: Vec<Id> =
            self.reachable([body.node]).into_iter().filter(|id| belongs(self.free(*id))).collect();
        for id in local {
            match self.node(id).clone() {
                Node::Coordinate(_) | Node::Velocity(_) => {
                    let partial = self.derivative(body, id);
                    let value = self.multiply(weight, partial);
                    if !value.is_zero() {
                        found.push(Contribution { loops: loops.to_vec(), target: id, value });
                    }
                }
                Node::Reduce(binder, inner) => {
                    let partial = self.derivative(body, id);
                    let weight = self.multiply(weight, partial);
                    if weight.is_zero() {
                        continue;
                    }
                    let (binder, inner) = self.opened(binder, inner, open);
                    let level = binder.level;
                    let inside: Vec<Binder> = loops.iter().cloned().chain([binder]).collect();
                    self.collect(inner, weight, &inside, Some(level), found);
                }
                _ => {}
            }
        }
    }

    /// A sum with its levels moved out of the way of the open ones.
    fn opened(&mut self, binder: Binder, body: Id, open: u64) -> (Binder, Expr) {
        if open >> binder.level == 0 {
            return (binder, body.into());
        }
        let by = 64 - open.leading_zeros() - binder.level;
        let body = self.shift(body, binder.level, by);
        (Binder { level: binder.level + by, ..binder }, body)
    }

    /// The second derivative of `root` by all coordinates and velocities. Each unordered pair of
    /// distinct variables appears once, mirrored.
    pub(crate) fn hessian(&mut self, root: Expr) -> Vec<SecondContribution> {
        let mut found = Vec::new();
        for first in self.gradient(root, &[]) {
            for second in self.gradient(first.value, &first.loops) {
                let (row, column) = (self.origin(first.target), self.origin(second.target));
                // The pair (column, row) comes along on its own way, with the same value.
                if row <= column {
                    found.push(SecondContribution {
                        loops: second.loops,
                        row: first.target,
                        column: second.target,
                        value: second.value,
                        mirrored: row < column,
                    });
                }
            }
        }
        found
    }

    fn origin(&self, node: Id) -> Id {
        self.origins.get(&node).map_or(node, |earlier| self.origin(*earlier))
    }
}
