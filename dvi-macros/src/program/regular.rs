//! What is special to a regular L: the energy, the force, and the rate of the momentum.

use super::pairs::PairPrograms;
use super::{Programs, rates, result};
use crate::formulas::RegularFormulas;
use crate::routine::Routine;
use crate::statement::{Output, Place, Statement};
use crate::structure::PairSum;
use crate::symbolic::{Graph, SecondContribution};

/// What is generated for a regular system.
pub(crate) struct RegularPrograms {
    pub(crate) shared: Programs,
    /// E = v·∂L/∂v − L
    pub(crate) energy: Routine,
    /// ∂L/∂q + F
    pub(crate) force: Routine,
    /// ∂L/∂v
    pub(crate) momentum: Routine,
    /// ∂²L/∂t∂v
    pub(crate) momentum_rate: Routine,
    pub(crate) pairs: Option<PairPrograms>,
}

impl RegularPrograms {
    /// From the formulas, the second derivative of L, and the sum over pairs that was found in it.
    pub(crate) fn new(
        graph: &mut Graph,
        formulas: &RegularFormulas,
        entries: Vec<SecondContribution>,
        pairs: Option<&PairSum>,
    ) -> Self {
        let RegularFormulas { lagrangian, force, constraints, momenta, events, .. } = formulas;
        let shared =
            Programs::new(graph, *lagrangian, entries, force, constraints.as_ref(), [momenta, events]);
        let energy = result(graph.energy(*lagrangian));
        let part = |output| shared.gradient.statements.iter().filter_map(move |s| as_vector(s, output));
        let [force, momentum]: [Vec<Statement>; 2] =
            [Output::Lq, Output::Lv].map(|output| part(output).collect());
        let rate = rates(graph, &momentum);
        let [energy, force, momentum, momentum_rate] =
            [energy, force, momentum, rate].map(|s| Routine::new(graph, s));
        let pairs = pairs.map(|sum| PairPrograms::regular(graph, formulas, sum));
        Self { shared, energy, force, momentum, momentum_rate, pairs }
    }
}

/// The statement of an entry of `output`, with its value in the only vector.
pub(super) fn as_vector(statement: &Statement, output: Output) -> Option<Statement> {
    let (_, coordinate) = statement.place.entry().filter(|(found, _)| *found == output)?;
    Some(Statement { place: Place::Entry(Output::Vector, coordinate.clone()), ..statement.clone() })
}
