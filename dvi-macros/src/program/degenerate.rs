//! What is special to L = α·v − H: the one-form, the Hamiltonian, the right side of the flow.

use super::pairs::PairPrograms;
use super::{Programs, first_derivatives, mirrored_pair, rates, result, statements};
use crate::formulas::{DegenerateFormulas, Force, TimeTransform, dalpha};
use crate::internal::internal;
use crate::routine::Routine;
use crate::statement::{Output, Place, Statement};
use crate::structure::PairSum;
use crate::symbolic::{Contribution, Expr, Graph, SecondContribution, Weight};

/// What is generated for a degenerate system.
pub(crate) struct DegeneratePrograms {
    pub(crate) shared: Programs,
    pub(crate) hamiltonian: Routine,
    /// ∇H − F
    pub(crate) hamiltonian_gradient: Routine,
    pub(crate) one_form: Routine,
    /// ∇H − F + ∂α/∂t
    pub(crate) flow_source: Routine,
    pub(crate) one_form_jacobian: Routine,
    /// Where Ω is canonical, one entry a row; else nothing.
    pub(crate) conjugate_entries: Routine,
    pub(crate) momentum_gradients: Vec<Routine>,
    pub(crate) time: Option<TimeTransform<Routine>>,
    pub(crate) pairs: Option<PairPrograms>,
}

impl DegeneratePrograms {
    /// From the formulas, the second derivative of α·v, and whether Ω is canonical.
    pub(crate) fn new(
        graph: &mut Graph,
        formulas: &DegenerateFormulas,
        form_entries: &[SecondContribution],
        canonical: bool,
        pairs: Option<&PairSum>,
    ) -> Self {
        let lagrangian = graph.subtract(formulas.one_form, formulas.hamiltonian);
        let entries = graph.hessian(lagrangian);
        let DegenerateFormulas { force, momenta, events, .. } = formulas;
        let shared = Programs::new(graph, lagrangian, entries, force, None, [momenta, events]);
        let hamiltonian_gradient = hamiltonian_gradient(graph, formulas.hamiltonian, &formulas.force);
        let one_form = one_form(graph, formulas.one_form);
        let flow_source = flow_source(graph, &hamiltonian_gradient, &one_form);
        let one_form_jacobian = one_form_jacobian(graph, form_entries);
        let conjugate_entries = if canonical { conjugate_entries(&one_form_jacobian) } else { Vec::new() };
        let momenta = formulas.momenta.iter();
        let momentum_gradients: Vec<Vec<Statement>> =
            momenta.map(|value| first_derivatives(graph, *value, Output::Vector, Output::Lv)).collect();
        let time = formulas.time.map(|TimeTransform { rate, hamiltonian }| TimeTransform {
            rate: Routine::new(graph, result(rate)),
            hamiltonian: Routine::new(graph, result(hamiltonian)),
        });
        let pairs = pairs.map(|sum| PairPrograms::degenerate(graph, formulas, sum, &one_form));
        Self {
            shared,
            time,
            pairs,
            hamiltonian: Routine::new(graph, result(formulas.hamiltonian)),
            hamiltonian_gradient: Routine::new(graph, hamiltonian_gradient),
            one_form: Routine::new(graph, one_form),
            flow_source: Routine::new(graph, flow_source),
            one_form_jacobian: Routine::new(graph, one_form_jacobian),
            conjugate_entries: Routine::new(graph, conjugate_entries),
            momentum_gradients: momentum_gradients
                .into_iter()
                .map(|gradient| Routine::new(graph, gradient))
                .collect(),
        }
    }
}

/// ∇H − F
pub(super) fn hamiltonian_gradient(graph: &mut Graph, hamiltonian: Expr, force: &Force) -> Vec<Statement> {
    let by_hamiltonian = graph.gradient(hamiltonian, &[]);
    let contributions = graph.added(by_hamiltonian, negated(force));
    statements(graph, contributions, Output::Vector, Output::Lv)
}

fn negated(force: &Force) -> impl Iterator<Item = Contribution> {
    force.iter().map(|part| Contribution { value: part.value.negated(), ..part.clone() })
}

/// αᵢ = ∂(α·v)/∂vⁱ
fn one_form(graph: &mut Graph, one_form: Expr) -> Vec<Statement> {
    let derivatives = first_derivatives(graph, one_form, Output::Lq, Output::Vector);
    derivatives.into_iter().filter(|s| matches!(s.place, Place::Entry(Output::Vector, _))).collect()
}

pub(super) fn flow_source(
    graph: &mut Graph,
    hamiltonian_gradient: &[Statement],
    one_form: &[Statement],
) -> Vec<Statement> {
    let rates = rates(graph, one_form);
    hamiltonian_gradient.iter().cloned().chain(rates).collect()
}

fn one_form_jacobian(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Statement> {
    let mut statements = Vec::new();
    for (i, j, entry) in dalpha(graph, entries) {
        statements.extend(mirrored_pair(graph, entry, [Weight::A, Weight::B], [&i, &j]));
    }
    statements
}

/// Row i of a Dα + b (Dα)ᵀ has its off-diagonal entry at i's conjugate.
fn conjugate_entries(jacobian: &[Statement]) -> Vec<Statement> {
    let entry = |statement: &Statement| match &statement.place {
        Place::MatrixEntry(row, column) => (row.block != column.block)
            .then(|| Statement { place: Place::Entry(Output::Vector, row.clone()), ..statement.clone() }),
        Place::Result | Place::Entry(..) | Place::Constraint(_) | Place::ConstraintDerivative(..) => {
            internal("an entry of a matrix was expected")
        }
    };
    jacobian.iter().filter_map(entry).collect()
}
