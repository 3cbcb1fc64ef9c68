//! Where a formula is a number, as another one that costs less.
//!
//! √u stands for a root of u, which is a number where it is, and 1/√u for a logarithm, which is infinite at
//! the end of its domain. A power whose exponent has no value yet, a function of the user's and a table stand
//! for themselves: nothing is known of them. What velocities decide is left out: they follow from momenta,
//! and are in the domain of L where these have any.

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

use super::functions::Unary;
use super::graph::{Binary, Expr, Fold, Graph, Id, Node};
use super::index::Atom;

impl Graph {
    /// A formula that is no number where `root` is none on a whole region of positions; zero if it is one
    /// everywhere.
    pub(crate) fn domain(&mut self, root: Id) -> Expr {
        self.domain_below(root, &mut HashMap::default())
    }

    fn domain_below(&mut self, root: Id, known: &mut HashMap<Id, Expr>) -> Expr {
        if let Some(domain) = known.get(&root) {
            return *domain;
        }
        let (mut seen, mut next, mut parts) = (HashSet::default(), vec![root], Vec::new());
        while let Some(id) = next.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.node(id).clone() {
                Node::Reduce { height, range, body, .. } => {
                    let inside = self.domain_below(body.node, known);
                    parts.push(self.fold(Fold::Sum, Atom::Bound(height), range, inside));
                }
                Node::Choose { left, right, .. }
                    if self.has_velocity(left.node) || self.has_velocity(right.node) => {}
                Node::Choose { left, relation, right, then, otherwise } => {
                    let [then, otherwise] =
                        [then, otherwise].map(|branch| self.domain_below(branch.node, known));
                    parts.push(self.choose(left, relation, right, then, otherwise));
                    next.extend([left.node, right.node]);
                }
                node => {
                    parts.extend(self.domain_of(id, &node));
                    next.extend(node.operands());
                }
            }
        }
        let domain = self.sum(&parts);
        known.insert(root, domain);
        domain
    }

    /// The same of one node, whose operands are numbers.
    fn domain_of(&mut self, id: Id, node: &Node) -> Option<Expr> {
        let (inside, ends_in_infinity) = match node {
            Node::Unary(Unary::Sqrt, u) => (*u, false),
            Node::Unary(Unary::Ln | Unary::Log2 | Unary::Log10, u) => (*u, true),
            Node::Binary(Binary::Powf, u, exponent) if exponent.as_number().is_some() => (*u, false),
            Node::Unary(Unary::Ln1p, u) => (self.add(Expr::ONE, *u), true),
            Node::Unary(Unary::Acosh, u) => (self.subtract(*u, Expr::ONE), false),
            Node::Unary(Unary::Asin | Unary::Acos, u) => (self.one_minus_square(*u), false),
            Node::Unary(Unary::Atanh, u) => (self.one_minus_square(*u), true),
            Node::Binary(Binary::Powf, u, _) if u.scale > 0.0 && self.is_never_negative(u.node) => {
                return None;
            }
            Node::Binary(Binary::Powf, ..) | Node::Call(..) | Node::ScalarField(..) => {
                return self.is_of_positions(id).then_some(id.into());
            }
            _ => return None,
        };
        let is_number = inside.scale > 0.0 && self.is_never_negative(inside.node);
        if is_number || !self.is_of_positions(inside.node) {
            return None;
        }
        let root = self.unary(Unary::Sqrt, inside);
        Some(if ends_in_infinity { self.reciprocal(root) } else { root })
    }

    /// Whether positions or the time decide on its value, and no velocities.
    fn is_of_positions(&self, id: Id) -> bool {
        self.depends(id, |node| node.is_position() || node.is_time()) && !self.has_velocity(id)
    }
}
