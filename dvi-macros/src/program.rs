//! What the generated functions compute, as statements over the graph.
//!
//! Every formula of `dvi_core::Lagrangian` becomes a
//! list of them here, by differentiation alone: the discrete equations of any scheme are weighted sums of
//! these, and the schemes supply the weights. `degenerate` and `regular` add what is special to each.

use crate::formulas::{Constraint, DeclaredConstraints, Force, Seams};
use crate::routine::Routine;
use crate::statement::{Output, Place, Statement};
use crate::symbolic::{
    Contribution, Coordinate, Expr, Graph, Loop, Node, SecondContribution, Variable, Weight,
};
use crate::syntax::Constrained;

mod constraints;
mod degenerate;
mod pairs;
mod regular;

pub(crate) use constraints::Constraints;
pub(crate) use degenerate::DegeneratePrograms;
pub(crate) use pairs::PairPrograms;
pub(crate) use regular::RegularPrograms;

/// What is generated for every system.
pub(crate) struct Programs {
    pub(crate) lagrangian: Routine,
    /// F, if there are forces.
    pub(crate) forces: Option<Routine>,
    pub(crate) constraints: Option<Constraints>,
    /// L, all components of F and all constraints, added up: no number where one of them is none.
    pub(crate) probe: Routine,
    /// No number outside of the domain of L and of all forces, if these do not know all positions.
    pub(crate) domain: Option<Routine>,
    pub(crate) gradient: Routine,
    pub(crate) linearize: Routine,
    pub(crate) momenta: Vec<Routine>,
    pub(crate) events: Vec<EventPrograms>,
    /// Numbers at whose zeros L or a force is not smooth.
    pub(crate) seams: Vec<Routine>,
    /// The second derivative of L, and the first ones of F.
    pub(crate) entries: Vec<SecondContribution>,
}

/// What is generated for an event.
pub(crate) struct EventPrograms {
    pub(crate) value: Routine,
    /// ∂g/∂q and ∂g/∂v
    pub(crate) gradient: Routine,
    /// ∂g/∂t
    pub(crate) by_time: Routine,
}

impl EventPrograms {
    fn new(graph: &mut Graph, value: Expr) -> Self {
        let gradient = first_derivatives(graph, value, Output::Lq, Output::Lv);
        let time = graph.intern(Node::Time);
        let by_time = result(graph.derivative(value, time));
        let [value, gradient, by_time] =
            [result(value), gradient, by_time].map(|statements| Routine::new(graph, statements));
        Self { value, gradient, by_time }
    }
}

impl Programs {
    /// From L, its second derivative, the force, the constraints, the momenta, and the events.
    fn new(
        graph: &mut Graph,
        lagrangian: Expr,
        mut entries: Vec<SecondContribution>,
        force: &Force,
        constraints: Option<&DeclaredConstraints>,
        [momenta, events]: [&[Expr]; 2],
    ) -> Self {
        let gradient = gradient(graph, lagrangian, force);
        let by_forces = force_derivatives(graph, force);
        let linearize = linearize(graph, &gradient, [&entries, &by_forces]);
        entries.extend(by_forces);
        let domain = domain(graph, lagrangian, force);
        Self {
            lagrangian: Routine::new(graph, result(lagrangian)),
            forces: (!force.is_empty()).then(|| {
                let applied = statements(graph, force.clone(), Output::Vector, Output::Lv);
                Routine::new(graph, applied)
            }),
            constraints: constraints.map(|declared| Constraints::new(graph, declared)),
            probe: probe(graph, lagrangian, force, constraints.map_or(&[], |declared| &declared.list)),
            domain: (!domain.is_zero()).then(|| Routine::new(graph, result(domain))),
            gradient: Routine::new(graph, gradient),
            linearize: Routine::new(graph, linearize),
            momenta: momenta.iter().map(|value| Routine::new(graph, result(*value))).collect(),
            events: events.iter().map(|value| EventPrograms::new(graph, *value)).collect(),
            seams: Vec::new(),
            entries,
        }
    }

    /// Adds the seams, each once, where it moves. They come last: what they make in the graph changes the
    /// order of no sum of another function.
    pub(crate) fn add_seams(&mut self, graph: &mut Graph, seams: &Seams) {
        let mut known: Vec<Expr> = Vec::new();
        for &[a, b] in seams {
            let difference = graph.subtract(a, b);
            // The same seam from its other side.
            let opposite = match graph.node(difference.node).clone() {
                Node::Sum(terms) => {
                    let terms: Vec<Expr> = terms.iter().map(|term| term.scaled(-difference.scale)).collect();
                    graph.sum(&terms)
                }
                _ => difference.negated(),
            };
            let is_known = known.iter().any(|seam| [difference, opposite].contains(seam));
            if !is_known && graph.depends(difference.node, Node::varies) {
                known.push(difference);
                self.seams.push(Routine::new(graph, result(difference)));
            }
        }
    }
}

/// ∂L/∂q + F and ∂L/∂v
fn gradient(graph: &mut Graph, lagrangian: Expr, force: &Force) -> Vec<Statement> {
    let by_lagrangian = graph.gradient(lagrangian, &[]);
    let contributions = graph.added(by_lagrangian, force.iter().cloned());
    statements(graph, contributions, Output::Lq, Output::Lv)
}

/// The gradient, and the second derivatives times their weights.
fn linearize(
    graph: &mut Graph,
    gradient: &[Statement],
    [of_lagrangian, of_forces]: [&[SecondContribution]; 2],
) -> Vec<Statement> {
    let mut statements = gradient.to_vec();
    statements.extend(weighted_hessian(graph, of_lagrangian));
    // The derivative of friction may be infinite at rest: times zero it would be no number, where the mass
    // matrix alone is asked for.
    statements.extend(weighted_hessian(graph, of_forces).into_iter().map(|statement| {
        let value = graph.where_finite(statement.value);
        Statement { value, ..statement }
    }));
    statements
}

fn probe(graph: &mut Graph, lagrangian: Expr, force: &Force, constraints: &[Constraint]) -> Routine {
    let forces = force.iter().map(|part| (part.loops.clone(), part.value));
    let constraints = constraints.iter().map(|constraint| (constraint.loops.clone(), constraint.value));
    let sum = with_all(graph, lagrangian, forces.chain(constraints));
    Routine::new(graph, result(sum))
}

fn domain(graph: &mut Graph, lagrangian: Expr, force: &Force) -> Expr {
    let of_lagrangian = graph.domain(lagrangian.node);
    let of_forces: Vec<_> =
        force.iter().map(|part| (part.loops.clone(), graph.domain(part.value.node))).collect();
    with_all(graph, of_lagrangian, of_forces)
}

/// The sum of one number and of all values of others in their loops.
fn with_all(graph: &mut Graph, one: Expr, others: impl IntoIterator<Item = (Vec<Loop>, Expr)>) -> Expr {
    others.into_iter().fold(one, |sum, (loops, value)| {
        let added = loops.into_iter().rev().fold(value, |value, over| graph.summed(value, over));
        graph.add(sum, added)
    })
}

/// ∂F/∂q and ∂F/∂v, in the rows of ∂L/∂q.
fn force_derivatives(graph: &mut Graph, force: &Force) -> Vec<SecondContribution> {
    let mut found = Vec::new();
    for Contribution { loops, target, value } in force {
        found.extend(graph.gradient(*value, loops).into_iter().map(|by| SecondContribution {
            loops: by.loops,
            row: *target,
            column: by.target,
            value: by.value,
            mirrored: false,
        }));
    }
    found
}

impl Programs {
    /// The values of L, of all forces and of all constraints: what the motion depends on.
    pub(crate) fn dynamics(&self) -> impl Iterator<Item = &Routine> {
        let constraints = self.constraints.iter().map(|constraints| &constraints.value);
        [&self.lagrangian].into_iter().chain(&self.forces).chain(constraints)
    }

    /// The values of the momenta, of the events and of the seams: what is looked at.
    pub(crate) fn observed(&self) -> impl Iterator<Item = &Routine> {
        self.momenta.iter().chain(self.events.iter().map(|event| &event.value)).chain(&self.seams)
    }

    /// Whether the time stands in L, in a force or in a constraint; not whether it stands in a gap.
    pub(crate) fn depends_on_time(&self, graph: &Graph) -> bool {
        let constraints = self.constraints.iter().filter(|constraints| constraints.of != Constrained::Gaps);
        let constraints = constraints.map(|constraints| &constraints.value);
        let routines = [&self.lagrangian].into_iter().chain(&self.forces).chain(constraints);
        let mut statements = routines.flat_map(|routine| &routine.statements);
        statements.any(|statement| graph.depends(statement.value.node, Node::is_time))
    }
}

fn result(value: Expr) -> Vec<Statement> {
    vec![Statement { loops: Vec::new(), place: Place::Result, value }]
}

fn first_derivatives(graph: &mut Graph, of: Expr, position: Output, velocity: Output) -> Vec<Statement> {
    let contributions = graph.gradient(of, &[]);
    statements(graph, contributions, position, velocity)
}

/// Contributions by positions in one array and by velocities in another.
fn statements(
    graph: &Graph,
    contributions: Vec<Contribution>,
    position: Output,
    velocity: Output,
) -> Vec<Statement> {
    let statement = |contribution: Contribution| {
        let (kind, coordinate) = graph.variable(contribution.target);
        let output = match kind {
            Variable::Position => position,
            Variable::Velocity => velocity,
        };
        let place = Place::Entry(output, coordinate.clone());
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

/// `value` on (row, column) and, with the other weight, on (column, row): on the diagonal with the sum of
/// both.
fn mirrored_pair(
    graph: &mut Graph,
    entry: &SecondContribution,
    weights: [Weight; 2],
    coordinates: [&Coordinate; 2],
) -> Vec<Statement> {
    let [one, other] = weights.map(|weight| graph.intern(Node::Weight(weight)).into());
    let [row, column] = coordinates;
    let places = match (entry.mirrored, row == column) {
        (false, _) => vec![(one, row, column)],
        (true, false) => vec![(one, row, column), (other, column, row)],
        (true, true) => vec![(graph.add(one, other), row, column)],
    };
    let statement = |(weight, row, column): (Expr, &Coordinate, &Coordinate)| Statement {
        loops: entry.loops.clone(),
        place: Place::MatrixEntry(row.clone(), column.clone()),
        value: graph.multiply(weight, entry.value),
    };
    places.into_iter().map(statement).collect()
}

fn weighted_hessian(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Statement> {
    let mut statements = Vec::new();
    for entry in entries {
        let [(row, r), (column, c)] = [entry.row, entry.column].map(|id| {
            let (kind, coordinate) = graph.variable(id);
            (kind, coordinate.clone())
        });
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
