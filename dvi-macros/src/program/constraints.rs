//! Constraints of the positions, g(q, t) = 0, or of the velocities, a(q, v, t) = 0, or gaps, g(q, t) ≥ 0:
//! their values, their derivatives, and how they change along a motion.

use crate::formulas::{Constraint, DeclaredConstraints};
use crate::routine::Routine;
use crate::statement::{Place, Row, Statement};
use crate::symbolic::{Contribution, Count, Expr, Graph, Node, Variable, Weight};
use crate::syntax::Constrained;

/// What is generated for the constraints of a system.
pub(crate) struct Constraints {
    pub(crate) of: Constrained,
    /// The number of members of each declared constraint; one below zero stands for zero.
    pub(crate) lengths: Vec<Count>,
    /// g or a
    pub(crate) value: Routine,
    /// The entries of ∂g/∂q, or of ∂a/∂q and ∂a/∂v.
    pub(crate) derivatives: Vec<(Variable, Statement)>,
    /// g and ∂g/∂q, or a and the weighted sum of ∂a/∂q and ∂a/∂v.
    pub(crate) jacobian: Routine,
    /// v·∂g/∂q + ∂g/∂t, and the same of a.
    pub(crate) rate: Routine,
    /// v·∂²g/∂q∂q v + 2 ∂²g/∂t∂q v + ∂²g/∂t∂t of constraints of the positions.
    pub(crate) curvature: Option<Routine>,
}

impl Constraints {
    pub(super) fn new(graph: &mut Graph, declared: &DeclaredConstraints) -> Self {
        let DeclaredConstraints { of, list: constraints } = declared;
        let values: Vec<Statement> = statements(constraints, |constraint| constraint.value);
        let rates = changes(graph, constraints);
        let curvature = (*of == Constrained::Positions).then(|| {
            let curvatures = changes(graph, &rates);
            Routine::new(graph, changing(&curvatures))
        });
        let derivatives = derivatives(graph, constraints);
        let mut jacobian = values.clone();
        for (variable, statement) in &derivatives {
            let value = match of {
                Constrained::Positions | Constrained::Gaps => statement.value,
                Constrained::Velocities => weighted(graph, *variable, statement.value),
            };
            jacobian.push(Statement { value, ..statement.clone() });
        }
        Self {
            of: *of,
            lengths: constraints.iter().map(Constraint::length).collect(),
            value: Routine::new(graph, values),
            jacobian: Routine::new(graph, jacobian),
            rate: Routine::new(graph, changing(&rates)),
            curvature,
            derivatives,
        }
    }
}

fn row(number: usize, constraint: &Constraint) -> Row {
    Row { constraint: number as u32, member: constraint.member() }
}

fn statements(constraints: &[Constraint], value: impl Fn(&Constraint) -> Expr) -> Vec<Statement> {
    let statement = |(number, constraint): (usize, &Constraint)| Statement {
        loops: constraint.loops.clone(),
        place: Place::Constraint(row(number, constraint)),
        value: value(constraint),
    };
    constraints.iter().enumerate().map(statement).collect()
}

/// The rates of change along a motion without acceleration, in place of the values.
fn changes(graph: &mut Graph, constraints: &[Constraint]) -> Vec<Constraint> {
    let rate = |constraint: &Constraint| Constraint {
        value: graph.rate(constraint.value, &constraint.loops),
        ..constraint.clone()
    };
    constraints.iter().map(rate).collect()
}

fn changing(changes: &[Constraint]) -> Vec<Statement> {
    let statements = statements(changes, |constraint| constraint.value);
    statements.into_iter().filter(|statement| !statement.value.is_zero()).collect()
}

/// The derivatives of all constraints.
fn derivatives(graph: &mut Graph, constraints: &[Constraint]) -> Vec<(Variable, Statement)> {
    let mut entries = Vec::new();
    for (number, constraint) in constraints.iter().enumerate() {
        for Contribution { loops, target, value } in graph.gradient(constraint.value, &constraint.loops) {
            let (by, column) = graph.variable(target);
            let place = Place::ConstraintDerivative(row(number, constraint), column.clone());
            entries.push((by, Statement { loops, place, value }));
        }
    }
    entries
}

/// A derivative by a position or by a velocity, times the weight of these.
fn weighted(graph: &mut Graph, by: Variable, derivative: Expr) -> Expr {
    let weight = match by {
        Variable::Position => Weight::Q,
        Variable::Velocity => Weight::V,
    };
    let weight = graph.intern(Node::Weight(weight)).into();
    graph.multiply(weight, derivative)
}
