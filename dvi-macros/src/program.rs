//! What the generated functions compute, as statements over the graph.
//!
//! A statement is a loop nest, a place and a value. Every formula of `dvi_core::Lagrangian` becomes a
//! list of them here, by differentiation alone: the discrete equations of any scheme are weighted sums of
//! these, and the schemes supply the weights. `degenerate` and `regular` add what is special to each.

use crate::internal::internal;
use crate::routine::Routine;
use crate::symbolic::{Contribution, Coordinate, Expr, Graph, Id, Loop, Node, SecondContribution, Weight};

mod degenerate;
mod regular;

pub(crate) use degenerate::{DegenerateFormulas, DegeneratePrograms, TimeTransform, dalpha};
pub(crate) use regular::{RegularFormulas, RegularPrograms};

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
    pub(crate) loops: Vec<Loop>,
    pub(crate) place: Place,
    pub(crate) value: Expr,
}

/// A variable of a derivative: position or velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variable {
    Position,
    Velocity,
}

/// What is generated for every system.
pub(crate) struct Programs {
    pub(crate) lagrangian: Routine,
    pub(crate) gradient: Routine,
    pub(crate) linearize: Routine,
    pub(crate) momenta: Vec<Routine>,
    /// The second derivative of L.
    pub(crate) entries: Vec<SecondContribution>,
}

/// What a derivative is by.
pub(crate) fn variable(graph: &Graph, id: Id) -> (Variable, Coordinate) {
    match graph.node(id) {
        Node::Coordinate(coordinate) => (Variable::Position, coordinate.clone()),
        Node::Velocity(coordinate) => (Variable::Velocity, coordinate.clone()),
        other => internal(format!("a derivative by {other:?}")),
    }
}

impl Programs {
    /// From L, its second derivative, and the momenta.
    fn new(graph: &mut Graph, lagrangian: Expr, entries: Vec<SecondContribution>, momenta: &[Expr]) -> Self {
        let gradient = first_derivatives(graph, lagrangian, Output::Lq, Output::Lv);
        let mut linearize = gradient.clone();
        linearize.extend(weighted_hessian(graph, &entries));
        Self {
            lagrangian: Routine::new(graph, result(lagrangian)),
            gradient: Routine::new(graph, gradient),
            linearize: Routine::new(graph, linearize),
            momenta: momenta.iter().map(|value| Routine::new(graph, result(*value))).collect(),
            entries,
        }
    }
}

fn result(value: Expr) -> Vec<Statement> {
    vec![Statement { loops: Vec::new(), place: Place::Result, value }]
}

fn first_derivatives(graph: &mut Graph, of: Expr, position: Output, velocity: Output) -> Vec<Statement> {
    let contributions = graph.gradient(of, &[]);
    let statement = |contribution: Contribution| {
        let (kind, coordinate) = variable(graph, contribution.target);
        let output = match kind {
            Variable::Position => position,
            Variable::Velocity => velocity,
        };
        let place = Place::Entry(output, coordinate);
        Statement { loops: contribution.loops, place, value: contribution.value }
    };
    contributions.into_iter().map(statement).collect()
}

/// ∂/∂t of each statement that depends on t.
fn rates(graph: &mut Graph, statements: &[Statement]) -> Vec<Statement> {
    let time = graph.intern(Node::Time);
    let rate = |statement: &Statement| {
        let value = graph.derivative(statement.value, time);
        (!value.is_zero()).then(|| Statement { value, ..statement.clone() })
    };
    statements.iter().filter_map(rate).collect()
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
        let ((row, r), (column, c)) = (variable(graph, entry.row), variable(graph, entry.column));
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
