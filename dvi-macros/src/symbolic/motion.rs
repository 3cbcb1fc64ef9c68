//! The rate of change of a function of the positions and the time along a motion.

use super::derivative::Contribution;
use super::graph::{Expr, Graph, Node};
use super::index::Loop;

impl Graph {
    /// v·∂f/∂q + ∂f/∂t of a function that stands inside `loops`. Velocities in it do not change: there is no
    /// acceleration.
    pub(crate) fn rate(&mut self, of: Expr, loops: &[Loop]) -> Expr {
        let time = self.intern(Node::Time);
        let mut terms = vec![self.derivative(of, time)];
        for Contribution { loops: around, target, value } in self.gradient(of, loops) {
            if self.node(target).is_velocity() {
                continue;
            }
            let velocity = self.velocity_of(target).into();
            let term = self.multiply(value, velocity);
            let sums = around.into_iter().skip(loops.len()).collect::<Vec<Loop>>();
            terms.push(sums.into_iter().rev().fold(term, |term, over| self.summed(term, over)));
        }
        self.factored_sum(&terms)
    }
}
