//! Whether a formula is affine in the velocities, reported on the smallest term that is not.

use std::collections::HashMap;

use quote::ToTokens;
use syn::Expr as Syntax;

use super::{Lowering, Role};
use crate::symbolic::{Expr, Graph, Id, Node};

/// The degree of a node in the velocities: 0, 1, or 2 for everything beyond. Operands come before
/// the nodes that use them.
fn velocity_degree(graph: &Graph, root: Id, known: &mut HashMap<Id, u8>) -> u8 {
    let mut open = vec![root];
    while let Some(&node) = open.last() {
        let unknown = |id: &Id| !known.contains_key(id);
        let waiting: Vec<Id> = graph.node(node).operands().into_iter().filter(unknown).collect();
        if waiting.is_empty() || known.contains_key(&node) {
            let degree = degree_above(graph, node, known);
            known.insert(node, degree);
            open.pop();
        } else {
            open.extend(waiting);
        }
    }
    known[&root]
}

fn degree_above(graph: &Graph, node: Id, known: &HashMap<Id, u8>) -> u8 {
    let degrees: Vec<u8> = graph.node(node).operands().iter().map(|id| known[id]).collect();
    let largest = degrees.iter().copied().max().unwrap_or(0);
    match graph.node(node) {
        Node::Velocity(_) => 1,
        Node::Sum(_) | Node::Reduce(..) => largest,
        Node::Product(factors) => {
            let sum: u32 =
                factors.iter().zip(&degrees).map(|((_, e), d)| e.saturating_mul(u32::from(*d))).sum();
            u8::try_from(sum.min(2)).unwrap_or(2)
        }
        // Left, right, then, otherwise.
        Node::Choose { .. } if degrees[0] == 0 && degrees[1] == 0 => largest,
        _ if largest > 0 => 2,
        _ => 0,
    }
}

impl Lowering<'_> {
    fn degree(&mut self, value: Expr) -> u8 {
        velocity_degree(self.graph, value.node, &mut self.degrees)
    }

    /// Passes `value` on if it is affine in the velocities.
    pub(super) fn affine(&mut self, syntax: &impl ToTokens, value: Expr) -> Option<Expr> {
        if self.degree(value) < 2 {
            return Some(value);
        }
        let message = match self.role {
            Role::OneForm => "a one-form is linear in d(·): this term is not",
            _ => {
                "this term is not affine in the velocities, so the Lagrangian is not degenerate in the sense of \
                 `#[degenerate_lagrangian]`; a regular Lagrangian belongs to `#[lagrangian]`"
            }
        };
        self.errors.push(syntax, message);
        None
    }

    /// The two sides of a condition do not depend on velocities.
    pub(super) fn check_at_rest(&mut self, condition: &Syntax, sides: &[Expr]) -> Option<()> {
        if sides.iter().all(|side| self.degree(*side) == 0) {
            return Some(());
        }
        let message = "this condition depends on a velocity, so L is not affine in the velocities; \
                       a condition compares coordinates, parameters and `t`";
        self.errors.push(condition, message);
        None
    }

    /// In a one-form, a term without d(·) cannot be added to one with it.
    pub(super) fn check_homogeneous(&mut self, left: (&Syntax, Expr), right: (&Syntax, Expr)) -> Option<()> {
        if self.role != Role::OneForm {
            return Some(());
        }
        let stray = match (self.degree(left.1), self.degree(right.1)) {
            (0, 1) if !left.1.is_zero() => left.0,
            (1, 0) if !right.1.is_zero() => right.0,
            _ => return Some(()),
        };
        self.errors.push(stray, "this term of the one-form has no d(·): write `… * d(x)` for a coordinate x");
        None
    }
}
