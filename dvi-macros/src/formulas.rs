//! The formulas of a system, in the graph, and what they are differentiated by.

use crate::symbolic::{Contribution, Coordinate, Count, Expr, Graph, Loop, SecondContribution, Variable};
use crate::syntax::Constrained;

/// The formulas of a degenerate system.
#[derive(Clone, Debug)]
pub(crate) struct DegenerateFormulas {
    /// α·v, with the differential of the gauge.
    pub(crate) one_form: Expr,
    pub(crate) hamiltonian: Expr,
    /// F, if there is one.
    pub(crate) gauge: Option<Expr>,
    /// α·v without it.
    pub(crate) declared: Expr,
    pub(crate) time: Option<TimeTransform<Expr>>,
    pub(crate) force: Force,
    pub(crate) momenta: Vec<Expr>,
    pub(crate) events: Vec<Expr>,
    pub(crate) seams: Seams,
}

/// What a time transformation is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimeTransform<F> {
    /// ρ = dt/dτ
    pub(crate) rate: F,
    /// H before the transformation.
    pub(crate) hamiltonian: F,
}

/// The formulas of a regular system.
#[derive(Clone, Debug)]
pub(crate) struct RegularFormulas {
    pub(crate) lagrangian: Expr,
    /// Whether L is a polynomial of degree at most two in v.
    pub(crate) quadratic: bool,
    pub(crate) force: Force,
    pub(crate) constraints: Option<DeclaredConstraints>,
    pub(crate) momenta: Vec<Expr>,
    pub(crate) events: Vec<Expr>,
    pub(crate) seams: Seams,
}

/// Pairs of numbers: where two are equal, L or a force is not smooth.
pub(crate) type Seams = Vec<[Expr; 2]>;

/// A generalised force F: its components, each at the coordinate that it acts on. By the principle of
/// Lagrange and d'Alembert, d/dt ∂L/∂v = ∂L/∂q + F: it stands wherever ∂L/∂q does.
pub(crate) type Force = Vec<Contribution>;

/// A constraint as it is declared, a single one or a family.
#[derive(Clone, Debug)]
pub(crate) struct Constraint {
    /// The loops over the members of a family, from the outermost.
    pub(crate) loops: Vec<Loop>,
    pub(crate) value: Expr,
}

/// The constraints of a system in the order of declaration, and what they are of.
#[derive(Clone, Debug)]
pub(crate) struct DeclaredConstraints {
    pub(crate) of: Constrained,
    pub(crate) list: Vec<Constraint>,
}

impl Constraint {
    /// How many constraints these are; none if the number is negative.
    pub(crate) fn length(&self) -> Count {
        Count::of_passes(&self.loops)
    }

    /// The number of a member, counted from 0.
    pub(crate) fn member(&self) -> Count {
        Count::of_passes_before(&self.loops)
    }
}

/// The entries of Dα: ∂αᵢ/∂qʲ = ∂²(α·v)/∂vⁱ∂qʲ, as (i, j, entry).
pub(crate) fn dalpha<'a>(
    graph: &Graph,
    entries: &'a [SecondContribution],
) -> Vec<(Coordinate, Coordinate, &'a SecondContribution)> {
    let pair =
        |entry: &'a SecondContribution| match (graph.variable(entry.row), graph.variable(entry.column)) {
            ((Variable::Velocity, i), (Variable::Position, j))
            | ((Variable::Position, j), (Variable::Velocity, i)) => Some((i.clone(), j.clone(), entry)),
            // α·v is linear in v, and the position part of its second derivative is not in Dα.
            ((Variable::Position, _), (Variable::Position, _))
            | ((Variable::Velocity, _), (Variable::Velocity, _)) => None,
        };
    entries.iter().filter_map(pair).collect()
}
