//! Holonomic constraints g(q, t) = 0: their values, the Jacobian G = ∂g/∂q, and how they change along a motion.

use super::{Place, Statement, Variable, variable};
use crate::internal::internal;
use crate::routine::Routine;
use crate::symbolic::{Contribution, Expr, Graph, Index, Loop};

/// A constraint as it is declared, a single one or a family.
#[derive(Clone, Debug)]
pub(crate) struct Constraint {
    /// The loop over the members of a family.
    pub(crate) over: Option<Loop>,
    /// The number of a member, counted from 0.
    pub(crate) member: Index,
    pub(crate) value: Expr,
}

/// An entry of g: the number of a declared constraint, and that of a member of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) constraint: u32,
    pub(crate) member: Index,
}

/// What is generated for the constraints of a system.
pub(crate) struct Constraints {
    /// The number of members of each declared constraint; one below zero stands for zero.
    pub(crate) lengths: Vec<Index>,
    /// g
    pub(crate) value: Routine,
    /// g and G
    pub(crate) jacobian: Routine,
    /// G v + ∂g/∂t
    pub(crate) rate: Routine,
    /// v·∂²g/∂q∂q v + 2 ∂²g/∂t∂q v + ∂²g/∂t∂t
    pub(crate) curvature: Routine,
}

impl Constraint {
    pub(crate) fn single(value: Expr) -> Self {
        Self { over: None, member: Index::literal(0), value }
    }

    /// How many constraints these are; none if the number is negative.
    pub(crate) fn length(&self) -> Index {
        match &self.over {
            Some(over) => over.range.upper.plus(&over.range.lower, -1),
            None => Index::literal(1),
        }
    }

    pub(crate) fn loops(&self) -> Vec<Loop> {
        self.over.iter().cloned().collect()
    }
}

impl Constraints {
    pub(super) fn new(graph: &mut Graph, constraints: &[Constraint]) -> Self {
        let values: Vec<Statement> = statements(constraints, |constraint| constraint.value);
        let rates = changes(graph, constraints);
        let curvatures = changes(graph, &rates);
        let [rate, curvature] = [&rates, &curvatures].map(|changes| {
            let changing = statements(changes, |constraint| constraint.value);
            changing.into_iter().filter(|statement| !statement.value.is_zero()).collect()
        });
        let mut jacobian = values.clone();
        jacobian.extend(jacobian_entries(graph, constraints));
        Self {
            lengths: constraints.iter().map(Constraint::length).collect(),
            value: Routine::new(graph, values),
            jacobian: Routine::new(graph, jacobian),
            rate: Routine::new(graph, rate),
            curvature: Routine::new(graph, curvature),
        }
    }
}

fn row(number: usize, constraint: &Constraint) -> Row {
    Row { constraint: number as u32, member: constraint.member.clone() }
}

fn statements(constraints: &[Constraint], value: impl Fn(&Constraint) -> Expr) -> Vec<Statement> {
    let statement = |(number, constraint): (usize, &Constraint)| Statement {
        loops: constraint.loops(),
        place: Place::Constraint(row(number, constraint)),
        value: value(constraint),
    };
    constraints.iter().enumerate().map(statement).collect()
}

/// The rates of change along a motion without acceleration, in place of the values.
fn changes(graph: &mut Graph, constraints: &[Constraint]) -> Vec<Constraint> {
    let rate = |constraint: &Constraint| Constraint {
        value: graph.rate(constraint.value, &constraint.loops()),
        ..constraint.clone()
    };
    constraints.iter().map(rate).collect()
}

/// The entries of G.
fn jacobian_entries(graph: &mut Graph, constraints: &[Constraint]) -> Vec<Statement> {
    let mut entries = Vec::new();
    for (number, constraint) in constraints.iter().enumerate() {
        for Contribution { loops, target, value } in graph.gradient(constraint.value, &constraint.loops()) {
            let (Variable::Position, column) = variable(graph, target) else {
                internal("a velocity in a constraint")
            };
            let place = Place::ConstraintDerivative(row(number, constraint), column);
            entries.push(Statement { loops, place, value });
        }
    }
    entries
}
