//! Parts of the language that a random system may do without: so that the oracle holds each of them, some of
//! the systems of a plain run have it, and agree.

use super::formula::{Atom, Formula};
use super::system::{Gauge, System};
use crate::syntax::Constrained;

/// What is counted, and whether a system has it.
pub(super) type Part = (&'static str, fn(&System) -> bool);

#[rustfmt::skip]
pub(super) const PARTS: [Part; 16] = [
    ("gauges with the time in them",      has_time_in_gauge),
    ("cross products",                    |system| system.has(&|part| matches!(part, Formula::Cross(..)))),
    ("norms",                             |system| system.has(&|part| matches!(part, Formula::Norm(_)))),
    ("sums over components",              |system| system.attribute().contains("|axis|")),
    ("sums over neighbours",              |system| system.has(&are_neighbours)),
    ("dissipation functions",             |system| system.dissipation.is_some()),
    ("forces on vectors",                 |system| system.forces.iter().any(|(_, force)| force.is_vector())),
    ("two indices",                       System::has_grids),
    ("unit vectors",                      System::has_spinors),
    ("rotations",                         has_rotations),
    ("functions of several variables",    |system| system.has(&has_variables)),
    ("names that formulas share",         |system| system.attribute().contains("let = {")),
    ("holonomic constraints by pairs",    |system| are_by_pairs(system, Constrained::Positions)),
    ("nonholonomic constraints by pairs", |system| are_by_pairs(system, Constrained::Velocities)),
    ("gaps by pairs",                     |system| are_by_pairs(system, Constrained::Gaps)),
    ("time transformations",              |system| system.time_transform.is_some()),
];

fn has_time_in_gauge(system: &System) -> bool {
    match &system.gauge {
        Gauge::Formula(gauge) => gauge.has(&|part| *part == Formula::Time),
        Gauge::None | Gauge::Auto => false,
    }
}

fn has_rotations(system: &System) -> bool {
    (0..system.blocks.len()).any(|block| system.is_rotation(block))
}

fn has_variables(formula: &Formula) -> bool {
    matches!(formula, Formula::ScalarField(_, at) if at.len() > 1)
}

/// Constraints of this kind, with families over two indices among them.
fn are_by_pairs(system: &System, of: Constrained) -> bool {
    system.constrained == of && system.constraints.iter().any(|constraint| constraint.ranges.len() == 2)
}

/// A sum with two entries of one array in it, at different distances from its index.
fn are_neighbours(formula: &Formula) -> bool {
    let Formula::Sum(loops, level, .., body) = formula else { return false };
    let innermost = [(Atom::Bound(level + loops.indices() - 1), 1)];
    let place = |part: &Formula| match part {
        Formula::Coordinate(block, Some(index)) if index.terms == innermost => {
            Some((*block, index.constant))
        }
        _ => None,
    };
    let has_neighbour = |(block, distance): (usize, i64)| {
        body.has(&|other| place(other).is_some_and(|(of, another)| of == block && another != distance))
    };
    body.has(&|part| place(part).is_some_and(has_neighbour))
}
