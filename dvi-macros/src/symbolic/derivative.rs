//! Differentiation in forward mode, over the local scalars of one term.
//!
//! [`Graph::derivative`] is the tangent of one expression along one node. A formula with sums has as
//! many coordinates as its sizes say, but only a few *local* ones: the coordinates that its text
//! mentions, inside the sums that they stand in. [`Graph::gradient`] differentiates with respect to
//! those and says where each result goes: a [`Contribution`] is a loop nest, a target and a value, and
//! ∂f/∂qⁱ is the sum of the contributions that land on i. A sum stays a sum; its derivative with
//! respect to a coordinate from outside is the sum of the derivatives, with respect to its own
//! coordinates a scatter, weighted by ∂f/∂(the sum). [`Graph::hessian`] does this twice.

use super::functions::Unary;
use super::graph::{Binary, Coordinate, Expr, Fold, Graph, Id, Node, Variable, leaf};
use super::index::{Atom, Index, Loop, Range, Renaming};
use crate::work::step;

/// `value`, added to the entry `target` in every pass of the loops.
#[derive(Clone, Debug)]
pub(crate) struct Contribution {
    /// The loop number k is over the open index of depth k.
    pub(crate) loops: Vec<Loop>,
    /// A coordinate or velocity node.
    pub(crate) target: Id,
    pub(crate) value: Expr,
}

/// `value`, added to the entry (`row`, `column`) in every pass of the loops, and to its mirror image
/// too if `mirrored`.
#[derive(Clone, Debug)]
pub(crate) struct SecondContribution {
    pub(crate) loops: Vec<Loop>,
    pub(crate) row: Id,
    pub(crate) column: Id,
    pub(crate) value: Expr,
    pub(crate) mirrored: bool,
}

/// The variables that one place of a formula stands for: those that its index reaches, in the loops that
/// decide its value.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Family {
    variable: Variable,
    block: u32,
    index: Index,
    ranges: Vec<Range>,
}

/// What a part of a formula is multiplied by in the derivative of the whole.
#[derive(Clone, Copy)]
struct Outer {
    factor: Expr,
    /// How often the formula as written asks for that part: where it does not, the part need not be a
    /// number.
    asked: Expr,
}

impl Graph {
    /// ∂of/∂by with `by` taken as an independent variable, whatever it depends on.
    pub(crate) fn derivative(&mut self, of: Expr, by: Id) -> Expr {
        self.node_derivative(of.node, by).scaled(of.scale)
    }

    pub(super) fn node_derivative(&mut self, of: Id, by: Id) -> Expr {
        step();
        if of == by {
            return Expr::ONE;
        }
        // An operand has a smaller id than the node that uses it.
        if of < by || self.is_free_of(of, by) {
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
            Node::Product(factors) => self.product_derivative(&factors, &[], by),
            Node::Reciprocal(u) => self.reciprocal_derivative(of, u, by),
            Node::Unary(function, u) => {
                if let Some(derivative) = self.function_of_root(function, u, of, by) {
                    return derivative;
                }
                let derivative = self.chain(u, by, |graph| graph.unary_derivative(function, u, of.into()));
                match function {
                    Unary::Sqrt | Unary::Cbrt => self.unless_empty(&[u], derivative),
                    _ => derivative,
                }
            }
            Node::Call(function, order, u) => self.chain(u, by, |graph| graph.call(function, order + 1, u)),
            Node::ScalarField(field, partial, at) => {
                let terms = (0..at.len()).map(|axis| {
                    let along =
                        |graph: &mut Self| graph.scalar_field(field, partial.along(axis), at.clone());
                    self.chain(at[axis], by, along)
                });
                let terms: Vec<Expr> = terms.collect();
                self.factored_sum(&terms)
            }
            Node::Binary(function, a, b) => {
                if let (Binary::Powf, Some(p)) = (function, b.as_number())
                    && let Some(derivative) = self.power_of_square(a, p, by)
                {
                    return derivative;
                }
                let tangents = [self.derivative(a, by), self.derivative(b, by)];
                if tangents.iter().all(|tangent| tangent.is_zero()) {
                    return Expr::ZERO;
                }
                let partials = self.binary_derivatives(function, a, b, of.into());
                let terms = [0, 1].map(|k| {
                    let term = self.multiply(partials[k], tangents[k]);
                    self.unless_empty(&[tangents[k]], term)
                });
                self.factored_sum(&terms)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let (then, otherwise) = (self.derivative(then, by), self.derivative(otherwise, by));
                self.choose(left, relation, right, then, otherwise)
            }
            Node::Reduce { fold, height, range, body } => {
                // A loop that neither of the two knows.
                let depth = self.free(of).depth().max(self.free(by).depth());
                let inner = self.opened(height, body, depth);
                let mut tangent = self.derivative(inner, by);
                if fold == Fold::Product {
                    let others = self.other_factors(height, &range, body, depth);
                    tangent = self.multiply(tangent, others);
                }
                self.fold(Fold::Sum, Atom::Open(depth), range, tangent)
            }
            Node::One | leaf!() => Expr::ZERO,
        }
    }

    /// The product over `range` without the factor at the open index of `depth`.
    fn other_factors(&mut self, height: u32, range: &Range, body: Expr, depth: u32) -> Expr {
        self.fold(Fold::Product, Atom::Bound(height), range.without(Index::open(depth)), body)
    }

    fn chain(&mut self, inner: Expr, by: Id, outer: impl FnOnce(&mut Self) -> Expr) -> Expr {
        let tangent = self.derivative(inner, by);
        if tangent.is_zero() {
            return Expr::ZERO;
        }
        let outer = outer(self);
        let derivative = self.multiply(outer, tangent);
        if self.has_domain(outer.node) { self.unless_empty(&[tangent], derivative) } else { derivative }
    }

    /// The gradient of `root`, which stands inside `loops`, by all coordinates and velocities.
    pub(crate) fn gradient(&mut self, root: Expr, loops: &[Loop]) -> Vec<Contribution> {
        let mut found = Vec::new();
        self.collect(root, Outer { factor: Expr::ONE, asked: Expr::ONE }, loops, None, &mut found);
        found
    }

    /// Adds the contributions of outer · body, where it is asked for; with `newest` given, only those of
    /// variables that depend on the loop at that depth, because the others were taken further out.
    fn collect(
        &mut self,
        body: Expr,
        outer: Outer,
        loops: &[Loop],
        newest: Option<u32>,
        found: &mut Vec<Contribution>,
    ) {
        // What depends on the index of a closed sum is differentiated when that sum has been opened.
        let belongs = |graph: &Self, id: &Id| {
            let free = graph.free(*id);
            free.bound == 0 && newest.is_none_or(|depth| free.open & (1 << depth) != 0)
        };
        let local: Vec<Id> =
            self.reachable([body.node]).into_iter().filter(|id| belongs(self, id)).collect();
        for id in local {
            match self.node(id).clone() {
                Node::Coordinate(_) | Node::Velocity(_) => {
                    let partial = self.derivative(body, id);
                    let value = self.multiply(outer.factor, partial);
                    let value = self.where_asked(outer.asked, value);
                    if !value.is_zero() {
                        found.push(Contribution { loops: loops.to_vec(), target: id, value });
                    }
                }
                Node::Reduce { fold, height, range, body: inner } => {
                    let partial = self.derivative(body, id);
                    let mut factor = self.multiply(outer.factor, partial);
                    if factor.is_zero() {
                        continue;
                    }
                    let inside_asked = self.asked(body.node, id);
                    let asked = self.multiply(outer.asked, inside_asked);
                    let depth = loops.len() as u32;
                    if fold == Fold::Product {
                        let others = self.other_factors(height, &range, inner, depth);
                        factor = self.multiply(factor, others);
                    }
                    let inner = self.opened(height, inner, depth);
                    let inside: Vec<Loop> = loops.iter().cloned().chain([Loop { depth, range }]).collect();
                    self.collect(inner, Outer { factor, asked }, &inside, Some(depth), found);
                }
                _ => {}
            }
        }
    }

    /// The sum of contributions, with one value for each place.
    pub(crate) fn added(
        &mut self,
        mut contributions: Vec<Contribution>,
        others: impl Iterator<Item = Contribution>,
    ) -> Vec<Contribution> {
        for other in others {
            let same =
                |known: &&mut Contribution| known.target == other.target && known.loops == other.loops;
            match contributions.iter_mut().find(same) {
                Some(known) => known.value = self.add(known.value, other.value),
                None => contributions.push(other),
            }
        }
        contributions.retain(|contribution| !contribution.value.is_zero());
        contributions
    }

    /// The second derivative of `root` by all coordinates and velocities.
    ///
    /// Each place of the formula belongs to one [`Family`], in the first derivative as in the second.
    /// The block of two families is the transpose of the block with their roles exchanged, so one of the
    /// two is enough, mirrored; the block of a family with itself is complete as it comes.
    pub(crate) fn hessian(&mut self, root: Expr) -> Vec<SecondContribution> {
        let mut found = Vec::new();
        for first in self.gradient(root, &[]) {
            let row = self.family(first.target, &first.loops);
            for second in self.gradient(first.value, &first.loops) {
                let column = self.family(second.target, &second.loops);
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

    fn family(&self, target: Id, loops: &[Loop]) -> Family {
        let (variable, Coordinate { block, index }) = self.variable(target);
        let mut needed = index.free().open;
        for outer in loops.iter().rev() {
            if needed & (1 << outer.depth) != 0 {
                needed |= outer.range.as_written().free().open;
            }
        }
        // The loops that matter, numbered from the outside.
        let mut ranges: Vec<Range> = Vec::new();
        let mut numbers: Vec<Renaming> = Vec::new();
        for outer in loops.iter().filter(|outer| needed & (1 << outer.depth) != 0) {
            let to = Atom::Open(ranges.len() as u32);
            let range = outer.range.as_written();
            ranges.push(numbers.iter().fold(range, |range, number| range.renamed(number)));
            numbers.push(Renaming { from: Atom::Open(outer.depth), to });
        }
        let index = numbers.iter().fold(index.clone(), |index, number| index.renamed(number));
        Family { variable, block: *block, index, ranges }
    }
}
