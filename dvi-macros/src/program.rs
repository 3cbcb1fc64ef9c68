//! What the generated functions compute, as statements over the graph.
//!
//! A statement is a loop nest, a place and a value. Every formula of `dvi_core::Lagrangian` and
//! `dvi_core::DegenerateLagrangian` becomes a list of them here, by differentiation alone: the discrete
//! equations of any scheme are weighted sums of these, and the schemes supply the weights.

use crate::symbolic::{Binder, Coordinate, Expr, Graph, Node, SecondContribution, Weight};

/// An array that a generated function writes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Output {
    /// ∂L/∂q
    Lq,
    /// ∂L/∂v
    Lv,
    /// The only vector of a function that sets one.
    Vector,
}

#[derive(Clone, Debug)]
pub(crate) enum Place {
    /// The value that the function returns.
    Result,
    Entry(Output, Coordinate),
    MatrixEntry(Coordinate, Coordinate),
}

#[derive(Clone, Debug)]
pub(crate) struct Statement {
    pub(crate) loops: Vec<Binder>,
    pub(crate) place: Place,
    pub(crate) value: Expr,
}

/// The formulas of a degenerate system.
#[derive(Clone, Debug)]
pub(crate) struct Formulas {
    /// α·v
    pub(crate) one_form: Expr,
    pub(crate) hamiltonian: Expr,
    pub(crate) momenta: Vec<Expr>,
}

/// A variable of a derivative: position or velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variable {
    Position,
    Velocity,
}

pub(crate) struct Programs {
    pub(crate) lagrangian: Vec<Statement>,
    pub(crate) gradient: Vec<Statement>,
    pub(crate) linearize: Vec<Statement>,
    pub(crate) hamiltonian: Vec<Statement>,
    pub(crate) hamiltonian_gradient: Vec<Statement>,
    pub(crate) one_form: Vec<Statement>,
    /// ∇H + ∂α/∂t
    pub(crate) flow_source: Vec<Statement>,
    pub(crate) one_form_jacobian: Vec<Statement>,
    pub(crate) partner_entries: Vec<Statement>,
    pub(crate) momenta: Vec<(Vec<Statement>, Vec<Statement>)>,
    /// The second derivative of L.
    pub(crate) entries: Vec<SecondContribution>,
}

pub(crate) fn variable(graph: &Graph, id: crate::symbolic::Id) -> Option<(Variable, Coordinate)> {
    match graph.node(id) {
        Node::Coordinate(coordinate) => Some((Variable::Position, coordinate.clone())),
        Node::Velocity(coordinate) => Some((Variable::Velocity, coordinate.clone())),
        _ => None,
    }
}

impl Programs {
    /// From the formulas, the second derivative of α·v, and whether Ω is canonical.
    pub(crate) fn new(
        graph: &mut Graph,
        formulas: &Formulas,
        form_entries: &[SecondContribution],
        canonical: bool,
    ) -> Self {
        let lagrangian = graph.subtract(formulas.one_form, formulas.hamiltonian);
        let entries = graph.hessian(lagrangian);
        let gradient = first_derivatives(graph, lagrangian, Output::Lq, Output::Lv);
        let mut linearize = gradient.clone();
        linearize.extend(weighted_hessian(graph, &entries));
        let hamiltonian_gradient = first_derivatives(graph, formulas.hamiltonian, Output::Vector, Output::Lv);
        let one_form = one_form(graph, formulas.one_form);
        let flow_source = flow_source(graph, &hamiltonian_gradient, &one_form);
        let momenta = formulas.momenta.iter();
        let momenta = momenta
            .map(|value| (result(*value), first_derivatives(graph, *value, Output::Vector, Output::Lv)))
            .collect();
        Self {
            lagrangian: result(lagrangian),
            hamiltonian: result(formulas.hamiltonian),
            one_form_jacobian: one_form_jacobian(graph, form_entries),
            partner_entries: if canonical { partner_entries(graph, form_entries) } else { Vec::new() },
            gradient,
            linearize,
            hamiltonian_gradient,
            one_form,
            flow_source,
            momenta,
            entries,
        }
    }
}

fn result(value: Expr) -> Vec<Statement> {
    vec![Statement { loops: Vec::new(), place: Place::Result, value }]
}

fn first_derivatives(graph: &mut Graph, of: Expr, position: Output, velocity: Output) -> Vec<Statement> {
    let contributions = graph.gradient(of, &[]);
    let statement = |contribution: crate::symbolic::Contribution| {
        let (kind, coordinate) = variable(graph, contribution.target)?;
        let output = if kind == Variable::Position { position } else { velocity };
        let place = Place::Entry(output, coordinate);
        Some(Statement { loops: contribution.loops, place, value: contribution.value })
    };
    contributions.into_iter().filter_map(statement).collect()
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

/// `value` on (row, column) and, with the other weight, on (column, row).
fn mirrored_pair(
    graph: &mut Graph,
    entry: &SecondContribution,
    weights: [Weight; 2],
    coordinates: [&Coordinate; 2],
) -> Vec<Statement> {
    let mut place = |weight: Weight, row: &Coordinate, column: &Coordinate| {
        let weight = graph.intern(Node::Weight(weight)).into();
        let value = graph.multiply(weight, entry.value);
        Statement {
            loops: entry.loops.clone(),
            place: Place::MatrixEntry(row.clone(), column.clone()),
            value,
        }
    };
    let [row, column] = coordinates;
    let mut statements = vec![place(weights[0], row, column)];
    if entry.mirrored {
        statements.push(place(weights[1], column, row));
    }
    statements
}

fn weighted_hessian(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Statement> {
    let mut statements = Vec::new();
    for entry in entries {
        let (Some((row, r)), Some((column, c))) = (variable(graph, entry.row), variable(graph, entry.column))
        else {
            continue;
        };
        let weights = match (row, column) {
            (Variable::Position, Variable::Position) => [Weight::Qq, Weight::Qq],
            (Variable::Position, Variable::Velocity) => [Weight::Qv, Weight::Vq],
            (Variable::Velocity, Variable::Position) => [Weight::Vq, Weight::Qv],
            (Variable::Velocity, Variable::Velocity) => [Weight::Vv, Weight::Vv],
        };
        statements.extend(mirrored_pair(graph, entry, weights, [&r, &c]));
    }
    statements
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
