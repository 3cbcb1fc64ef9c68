//! What is generated for an energy with a sum over pairs: everything without the sum, and its kernel.

use super::degenerate::{flow_source, hamiltonian_gradient};
use super::regular::as_vector;
use super::{force_derivatives, gradient, linearize, result};
use crate::formulas::{DegenerateFormulas, Force, RegularFormulas};
use crate::routine::Routine;
use crate::statement::{Output, Place, Statement};
use crate::structure::PairSum;
use crate::symbolic::{Atom, Coordinate, Expr, Fold, Graph, Index, Loop, Range};

/// L = L_rest − Σ_{j<k} w_j w_k K(r²), or H = H_rest + Σ_{j<k} w_j w_k K(r²).
pub(crate) struct PairPrograms {
    pub(crate) sum: PairSum,
    /// K
    pub(crate) kernel: Routine,
    /// dK/d(r²)
    pub(crate) kernel_slope: Routine,
    /// L_rest
    pub(crate) lagrangian: Routine,
    pub(crate) gradient: Routine,
    pub(crate) linearize: Routine,
    /// E_rest
    pub(crate) energy: Routine,
    /// ∇H_rest − F of a degenerate system, ∂L_rest/∂q + F of a regular one.
    pub(crate) vector: Routine,
    /// ∇H_rest − F + ∂α/∂t of a degenerate system.
    pub(crate) flow_source: Option<Routine>,
    /// The energy put together of these parts, and the vector, for the self-check alone.
    pub(crate) together: Routine,
    pub(crate) together_vector: Routine,
}

/// What the sum leaves of a system.
struct Rest {
    lagrangian: Expr,
    energy: Expr,
    vector: Vec<Statement>,
    flow_source: Option<Vec<Statement>>,
}

impl PairPrograms {
    /// `slope` is what the kernel adds to the vector, times 2 w_j w_k (x_j − x_k).
    fn new(
        graph: &mut Graph,
        sum: &PairSum,
        rest: Rest,
        [of_kernel, slope]: [Expr; 2],
        force: &Force,
    ) -> Self {
        let of_pairs = pair_gradient(graph, sum, slope);
        let together_vector = rest.vector.iter().cloned().chain(of_pairs).collect();
        let gradient = gradient(graph, rest.lagrangian, force);
        let [entries, by_forces] = [graph.hessian(rest.lagrangian), force_derivatives(graph, force)];
        let linearize = linearize(graph, &gradient, [&entries, &by_forces]);
        let together = together(graph, sum, rest.energy);
        Self {
            kernel: Routine::new(graph, result(sum.kernel)),
            kernel_slope: Routine::new(graph, result(of_kernel)),
            lagrangian: Routine::new(graph, result(rest.lagrangian)),
            gradient: Routine::new(graph, gradient),
            linearize: Routine::new(graph, linearize),
            energy: Routine::new(graph, result(rest.energy)),
            together: Routine::new(graph, result(together)),
            vector: Routine::new(graph, rest.vector),
            flow_source: rest.flow_source.map(|statements| Routine::new(graph, statements)),
            together_vector: Routine::new(graph, together_vector),
            sum: sum.clone(),
        }
    }

    /// From the formulas, the sum that was found in H, and the components of α.
    pub(super) fn degenerate(
        graph: &mut Graph,
        formulas: &DegenerateFormulas,
        sum: &PairSum,
        one_form: &[Statement],
    ) -> Self {
        let slope = graph.derivative(sum.kernel, sum.square);
        let lagrangian = graph.subtract(formulas.one_form, sum.rest);
        let vector = hamiltonian_gradient(graph, sum.rest, &formulas.force);
        let flow_source = Some(flow_source(graph, &vector, one_form));
        let rest = Rest { lagrangian, energy: sum.rest, vector, flow_source };
        Self::new(graph, sum, rest, [slope, slope], &formulas.force)
    }

    /// From the formulas and the sum that was found in L.
    pub(super) fn regular(graph: &mut Graph, formulas: &RegularFormulas, sum: &PairSum) -> Self {
        let slope = graph.derivative(sum.kernel, sum.square);
        let energy = graph.energy(sum.rest);
        let gradient = gradient(graph, sum.rest, &formulas.force);
        let vector = gradient.iter().filter_map(|statement| as_vector(statement, Output::Lq)).collect();
        let rest = Rest { lagrangian: sum.rest, energy, vector, flow_source: None };
        Self::new(graph, sum, rest, [slope, slope.negated()], &formulas.force)
    }
}

fn together(graph: &mut Graph, sum: &PairSum, rest: Expr) -> Expr {
    let [first, second] = [Atom::Open(0), Atom::Open(1)];
    let term = sum.weighted(graph, sum.kernel, [first.clone(), second.clone()]);
    let above = Index::atom(first.clone()).plus(&Index::literal(1), 1);
    let inner = Range { lower: above, ..Range::up_to(sum.bodies.clone()) };
    let over_second = graph.fold(Fold::Sum, second, inner, term);
    let pairs = graph.fold(Fold::Sum, first, Range::up_to(sum.bodies.clone()), over_second);
    graph.add(rest, pairs)
}

/// 2 w_j w_k K' (x_j − x_k) on each coordinate of body j, and the opposite on that of body k, for all j <
/// k: the pairs of the energy, of which a check may visit some.
fn pair_gradient(graph: &mut Graph, sum: &PairSum, slope: Expr) -> Vec<Statement> {
    let bodies = [Atom::Open(0), Atom::Open(1)];
    let (differences, _) = sum.distance(graph, bodies.clone());
    let weighted = sum.weighted(graph, slope, bodies).scaled(2.0);
    let all = Range::up_to(sum.bodies.clone());
    let above = Range { lower: Index::open(0).plus(&Index::literal(1), 1), ..all.clone() };
    let loops = vec![Loop { depth: 0, range: all }, Loop { depth: 1, range: above }];
    let parts = sum.blocks.iter().zip(differences);
    parts
        .flat_map(|(block, difference)| {
            let value = graph.multiply(weighted, difference);
            [(0, value), (1, value.negated())].map(|(body, value)| Statement {
                loops: loops.clone(),
                place: Place::Entry(Output::Vector, Coordinate { block: *block, index: Index::open(body) }),
                value,
            })
        })
        .collect()
}
