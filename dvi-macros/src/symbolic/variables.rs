//! What stands below a node of that which derivatives are taken by: coordinates, velocities, time, sums.
//!
//! Most derivatives of most terms vanish, and a formula with many coordinates has many terms: which of them
//! a coordinate stands in is known without a walk through all.

use super::graph::{Graph, Id, Node};

/// A set of variables by their numbers, in the order in which their nodes were made.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables(Vec<u64>);

impl Variables {
    fn insert(&mut self, number: usize) {
        let length = self.0.len().max(number / 64 + 1);
        self.0.resize(length, 0);
        self.0[number / 64] |= 1 << (number % 64);
    }

    fn contains(&self, number: usize) -> bool {
        self.0.get(number / 64).is_some_and(|bits| bits >> (number % 64) & 1 == 1)
    }

    fn join(&mut self, other: &Self) {
        let length = self.0.len().max(other.0.len());
        self.0.resize(length, 0);
        self.0.iter_mut().zip(&other.0).for_each(|(bits, other)| *bits |= other);
    }
}

impl Graph {
    /// The variables below a node with the next id, which is one itself or not.
    pub(super) fn variables_below(&mut self, node: &Node, operands: &[Id]) -> Variables {
        let mut variables = Variables::default();
        operands.iter().for_each(|operand| variables.join(&self.variables[operand.0 as usize]));
        if node.varies() || matches!(node, Node::Reduce { .. }) {
            variables.insert(self.numbers.len());
            self.numbers.insert(self.next(), self.numbers.len());
        }
        variables
    }

    /// Whether the variable `by` stands nowhere below `of`.
    pub(super) fn is_free_of(&self, of: Id, by: Id) -> bool {
        self.numbers.get(&by).is_some_and(|number| !self.variables[of.0 as usize].contains(*number))
    }
}
