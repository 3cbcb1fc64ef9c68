//! What is special to L = α·v − H: the one-form, the Hamiltonian, the right side of the flow.

use super::{
    Output, Place, Programs, Statement, Variable, first_derivatives, mirrored_pair, result, variable,
};
use crate::symbolic::{Coordinate, Expr, Graph, Node, SecondContribution, Weight};

/// The formulas of a degenerate system.
#[derive(Clone, Debug)]
pub(crate) struct DegenerateFormulas {
    /// α·v
    pub(crate) one_form: Expr,
    pub(crate) hamiltonian: Expr,
    pub(crate) momenta: Vec<Expr>,
}

/// What is generated for a degenerate system.
pub(crate) struct DegeneratePrograms {
    pub(crate) shared: Programs,
    pub(crate) hamiltonian: Vec<Statement>,
    pub(crate) hamiltonian_gradient: Vec<Statement>,
    pub(crate) one_form: Vec<Statement>,
    /// ∇H + ∂α/∂t
    pub(crate) flow_source: Vec<Statement>,
    pub(crate) one_form_jacobian: Vec<Statement>,
    pub(crate) partner_entries: Vec<Statement>,
    pub(crate) momentum_gradients: Vec<Vec<Statement>>,
}

impl DegeneratePrograms {
    /// From the formulas, the second derivative of α·v, and whether Ω is canonical.
    pub(crate) fn new(
        graph: &mut Graph,
        formulas: &DegenerateFormulas,
        form_entries: &[SecondContribution],
        canonical: bool,
    ) -> Self {
        let lagrangian = graph.subtract(formulas.one_form, formulas.hamiltonian);
        let entries = graph.hessian(lagrangian);
        let shared = Programs::new(graph, lagrangian, entries, &formulas.momenta);
        let hamiltonian_gradient = first_derivatives(graph, formulas.hamiltonian, Output::Vector, Output::Lv);
        let one_form = one_form(graph, formulas.one_form);
        let flow_source = flow_source(graph, &hamiltonian_gradient, &one_form);
        let momenta = formulas.momenta.iter();
        let momentum_gradients =
            momenta.map(|value| first_derivatives(graph, *value, Output::Vector, Output::Lv)).collect();
        Self {
            shared,
            hamiltonian: result(formulas.hamiltonian),
            one_form_jacobian: one_form_jacobian(graph, form_entries),
            partner_entries: if canonical { partner_entries(graph, form_entries) } else { Vec::new() },
            hamiltonian_gradient,
            one_form,
            flow_source,
            momentum_gradients,
        }
    }
}

/// αᵢ = ∂(α·v)/∂vⁱ
fn one_form(graph: &mut Graph, one_form: Expr) -> Vec<Statement> {
    let derivatives = first_derivatives(graph, one_form, Output::Lq, Output::Vector);
    derivatives.into_iter().filter(|s| matches!(s.place, Place::Entry(Output::Vector, _))).collect()
}

fn flow_source(
    graph: &mut Graph,
    hamiltonian_gradient: &[Statement],
    one_form: &[Statement],
) -> Vec<Statement> {
    let time = graph.intern(Node::Time);
    let rates = one_form.iter().filter_map(|statement| {
        let value = graph.derivative(statement.value, time);
        (!value.is_zero()).then(|| Statement { value, ..statement.clone() })
    });
    let rates: Vec<Statement> = rates.collect();
    hamiltonian_gradient.iter().cloned().chain(rates).collect()
}

/// The entries of Dα: ∂αᵢ/∂qʲ = ∂²(α·v)/∂vⁱ∂qʲ, as (i, j, entry).
pub(crate) fn dalpha<'a>(
    graph: &Graph,
    entries: &'a [SecondContribution],
) -> Vec<(Coordinate, Coordinate, &'a SecondContribution)> {
    let pair =
        |entry: &'a SecondContribution| match (variable(graph, entry.row)?, variable(graph, entry.column)?) {
            ((Variable::Velocity, i), (Variable::Position, j))
            | ((Variable::Position, j), (Variable::Velocity, i)) => Some((i, j, entry)),
            _ => None,
        };
    entries.iter().filter_map(pair).collect()
}

fn one_form_jacobian(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Statement> {
    let mut statements = Vec::new();
    for (i, j, entry) in dalpha(graph, entries) {
        statements.extend(mirrored_pair(graph, entry, [Weight::A, Weight::B], [&i, &j]));
    }
    statements
}

/// Row i of a Dα + b (Dα)ᵀ has its off-diagonal entry at i's partner.
fn partner_entries(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Statement> {
    one_form_jacobian(graph, entries)
        .into_iter()
        .filter_map(|statement| match statement.place {
            Place::MatrixEntry(row, column) if row != column => {
                Some(Statement { place: Place::Entry(Output::Vector, row), ..statement })
            }
            _ => None,
        })
        .collect()
}
