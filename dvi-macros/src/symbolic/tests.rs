//! The functions and their derivatives, and the normal form. Formulas as a whole are left to the self-check
//! and to the oracle.

use super::simplify::HIGH;
use super::{Coordinate, Graph, Id, Index, Node};

mod evaluate;
mod functions;

fn coordinate(graph: &mut Graph, block: u32) -> Id {
    graph.intern(Node::Coordinate(Coordinate { block, index: Index::literal(0) }))
}

/// What the constructors promise of each node, in all graphs of all tests.
pub(super) fn is_normal(graph: &Graph, node: &Node) -> bool {
    match node {
        Node::Sum(terms) => {
            let ordered = terms.windows(2).all(|pair| pair[0].node < pair[1].node);
            let several = terms.len() >= 2 || terms.iter().any(|term| term.scale.abs() != 1.0);
            several && ordered && terms.iter().all(|term| !term.is_zero())
        }
        Node::Product(factors) => {
            let ordered = factors.windows(2).all(|pair| pair[0].0 < pair[1].0);
            let several = factors.len() > 1 || factors[0].1 > 1;
            let is_one = factors.iter().any(|(id, _)| matches!(graph.node(*id), Node::One));
            ordered && several && !is_one && factors.iter().all(|(_, exponent)| *exponent > 0)
        }
        Node::Reciprocal(of) => match graph.node(*of) {
            Node::Reciprocal(_) | Node::One => false,
            Node::Product(factors) => factors.len() > 1 || factors[0].1 < HIGH,
            _ => true,
        },
        Node::Reduce { range, .. } => !range.is_empty(),
        Node::Unary(_, of) => of.as_number().is_none(),
        Node::Binary(_, a, b) => a.as_number().is_none() || b.as_number().is_none(),
        Node::Choose { then, otherwise, .. } => then != otherwise,
        _ => true,
    }
}
