//! What is special to a regular L: the energy and the force.

use super::{Output, Place, Programs, Statement, result};
use crate::routine::Routine;
use crate::symbolic::{Expr, Graph, SecondContribution};

/// The formulas of a regular system.
#[derive(Clone, Debug)]
pub(crate) struct RegularFormulas {
    pub(crate) lagrangian: Expr,
    /// Whether L is a polynomial of degree at most two in v.
    pub(crate) quadratic: bool,
    pub(crate) momenta: Vec<Expr>,
}

/// What is generated for a regular system.
pub(crate) struct RegularPrograms {
    pub(crate) shared: Programs,
    /// E = v·∂L/∂v − L
    pub(crate) energy: Routine,
    /// ∂L/∂q
    pub(crate) force: Routine,
}

impl RegularPrograms {
    /// From the formulas and the second derivative of L.
    pub(crate) fn new(
        graph: &mut Graph,
        formulas: &RegularFormulas,
        entries: Vec<SecondContribution>,
    ) -> Self {
        let shared = Programs::new(graph, formulas.lagrangian, entries, &formulas.momenta);
        let energy = result(graph.energy(formulas.lagrangian));
        let force = shared.gradient.statements.iter().filter_map(as_force).collect();
        Self { shared, energy: Routine::new(graph, energy), force: Routine::new(graph, force) }
    }
}

/// The statement of a derivative by a position, with its value in the only vector.
fn as_force(statement: &Statement) -> Option<Statement> {
    match &statement.place {
        Place::Entry(Output::Lq, coordinate) => {
            Some(Statement { place: Place::Entry(Output::Vector, coordinate.clone()), ..statement.clone() })
        }
        Place::Result | Place::Entry(..) | Place::MatrixEntry(..) => None,
    }
}
