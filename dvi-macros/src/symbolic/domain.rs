//! Where a formula is a number, as another one that costs less.
//!
//! √u stands for each root, logarithm and power of u, which are numbers where it is, and a table stands for
//! itself. A function of the user's is left out: its derivatives, which steps evaluate, are no numbers where
//! it is none. What velocities decide is left out too: they follow from momenta, and are in the domain of L
//! where these have any.

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
        let inside = match node {
            Node::Unary(Unary::Sqrt | Unary::Ln | Unary::Log2 | Unary::Log10, u)
            | Node::Binary(Binary::Powf, u, _) => *u,
            Node::Unary(Unary::Ln1p, u) => self.add(Expr::ONE, *u),
            Node::Unary(Unary::Acosh, u) => self.subtract(*u, Expr::ONE),
            Node::Unary(Unary::Asin | Unary::Acos | Unary::Atanh, u) => self.one_minus_square(*u),
            Node::ScalarField(..) => return self.is_of_positions(id).then_some(id.into()),
            _ => return None,
        };
        let is_number = inside.scale > 0.0 && self.is_never_negative(inside.node);
        (!is_number && self.is_of_positions(inside.node)).then(|| self.unary(Unary::Sqrt, inside))
    }

    /// Whether positions or the time decide on its value, and no velocities.
    fn is_of_positions(&self, id: Id) -> bool {
        self.depends(id, |node| matches!(node, Node::Coordinate(_) | Node::Time))
            && !self.depends(id, |node| matches!(node, Node::Velocity(_)))
    }
}
