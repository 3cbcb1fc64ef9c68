//! What is generated for a Hamiltonian with a sum over pairs: everything without the sum, and its kernel.

use super::degenerate::{DegenerateFormulas, flow_source, hamiltonian_gradient};
use super::{Output, Place, Statement, gradient, result};
use crate::routine::Routine;
use crate::structure::PairSum;
use crate::symbolic::{Atom, Coordinate, Expr, Fold, Graph, Index, Loop, Range};

/// H = H_rest + Σ_{j<k} w_j w_k K(r²).
pub(crate) struct PairPrograms {
    pub(crate) sum: PairSum,
    /// K
    pub(crate) kernel: Routine,
    /// dK/d(r²)
    pub(crate) kernel_slope: Routine,
    /// α·v − H_rest
    pub(crate) lagrangian: Routine,
    pub(crate) gradient: Routine,
    /// H_rest
    pub(crate) hamiltonian: Routine,
    pub(crate) hamiltonian_gradient: Routine,
    pub(crate) flow_source: Routine,
    /// H and ∇H − F put together of these parts, for the self-check alone.
    pub(crate) together: Routine,
    pub(crate) together_gradient: Routine,
}

impl PairPrograms {
    /// From the formulas, the sum that was found in them, and the components of α.
    pub(super) fn new(
        graph: &mut Graph,
        formulas: &DegenerateFormulas,
        sum: &PairSum,
        one_form: &[Statement],
    ) -> Self {
        let slope = graph.derivative(sum.kernel, sum.square);
        let lagrangian = graph.subtract(formulas.one_form, sum.rest);
        let of_lagrangian = gradient(graph, lagrangian, &formulas.force);
        let of_rest = hamiltonian_gradient(graph, sum.rest, &formulas.force);
        let flow_source = flow_source(graph, &of_rest, one_form);
        let together = together(graph, sum);
        let together_gradient = of_rest.iter().cloned().chain(pair_gradient(graph, sum, slope)).collect();
        Self {
            kernel: Routine::new(graph, result(sum.kernel)),
            kernel_slope: Routine::new(graph, result(slope)),
            lagrangian: Routine::new(graph, result(lagrangian)),
            gradient: Routine::new(graph, of_lagrangian),
            hamiltonian: Routine::new(graph, result(sum.rest)),
            hamiltonian_gradient: Routine::new(graph, of_rest),
            flow_source: Routine::new(graph, flow_source),
            together: Routine::new(graph, result(together)),
            together_gradient: Routine::new(graph, together_gradient),
            sum: sum.clone(),
        }
    }
}

fn together(graph: &mut Graph, sum: &PairSum) -> Expr {
    let [first, second] = [Atom::Open(0), Atom::Open(1)];
    let term = sum.weighted(graph, sum.kernel, [first.clone(), second.clone()]);
    let above = Index::atom(first.clone()).plus(&Index::literal(1), 1);
    let inner = Range { lower: above, ..Range::up_to(sum.bodies.clone()) };
    let over_second = graph.fold(Fold::Sum, second, inner, term);
    let pairs = graph.fold(Fold::Sum, first, Range::up_to(sum.bodies.clone()), over_second);
    graph.add(sum.rest, pairs)
}

/// w_j w_k 2 K' (x_j − x_k) on each coordinate of body j, for all k ≠ j.
fn pair_gradient(graph: &mut Graph, sum: &PairSum, slope: Expr) -> Vec<Statement> {
    let bodies = [Atom::Open(0), Atom::Open(1)];
    let (differences, _) = sum.distance(graph, bodies.clone());
    let weighted = sum.weighted(graph, slope, bodies).scaled(2.0);
    let all = Range::up_to(sum.bodies.clone());
    let others = Range { except: Some(Index::open(0)), ..all.clone() };
    let loops = vec![Loop { depth: 0, range: all }, Loop { depth: 1, range: others }];
    let parts = sum.blocks.iter().zip(differences);
    parts
        .map(|(block, difference)| Statement {
            loops: loops.clone(),
            place: Place::Entry(Output::Vector, Coordinate { block: *block, index: Index::open(0) }),
            value: graph.multiply(weighted, difference),
        })
        .collect()
}
