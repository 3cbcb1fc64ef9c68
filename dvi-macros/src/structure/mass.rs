//! The mass matrix M = ∂²L/∂v∂v of a regular system.

use syn::Expr as Syntax;

use super::has_matching;
use crate::errors::{Errors, listed};
use crate::model::Model;
use crate::program::{RegularFormulas, Variable, variable};
use crate::symbolic::{Atom, Binder, Coordinate, Expr, Graph, Id, Index, Node, SecondContribution};
use crate::syntax::Kind;

/// The structure of a regular L; see the constants of `dvi_core::RegularLagrangian`.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix {
    pub(crate) separable: bool,
    pub(crate) diagonal: bool,
    pub(crate) quadratic: bool,
    /// What M depends on, of `q`, `v` and `t`.
    depends_on: Vec<&'static str>,
    /// Blocks that M does not involve, and whether L mentions their velocities at all.
    massless: Vec<(usize, bool)>,
    /// Coordinates of arrays that M does not involve.
    skipped: Vec<(usize, i64)>,
    /// Whether M is zero.
    zero: bool,
    /// Whether the places of M that are not zero leave room for an inverse.
    invertible: bool,
    /// Whether the entries are numbers times a common factor, and the numbers make a singular matrix.
    numerically_singular: bool,
}

/// An entry of M.
struct Entry {
    loops: Vec<Binder>,
    row: Coordinate,
    column: Coordinate,
    value: Expr,
}

impl MassMatrix {
    /// From L, its second derivative, and its first derivatives as they are declared.
    pub(crate) fn new(
        graph: &mut Graph,
        model: &Model,
        formulas: &RegularFormulas,
        entries: &[SecondContribution],
    ) -> Self {
        let mass = mass_entries(graph, entries);
        let block_of = |coordinate: &Coordinate| coordinate.block as usize;
        let depends_on = depends_on(graph, &mass);
        let diagonal = mass.iter().all(|entry| entry.row == entry.column);
        let separable = formulas.quadratic
            && depends_on.is_empty()
            && !mixes_position_and_velocity(graph, entries)
            && force_is_at_rest(graph, formulas.lagrangian)
            && momentum_vanishes_at_rest(graph, formulas.lagrangian);
        let mentioned = mentioned(graph, formulas.lagrangian);
        let involved = |block: usize| {
            mass.iter().any(|entry| [&entry.row, &entry.column].map(block_of).contains(&block))
        };
        let massless = (0..model.blocks.len())
            .filter(|block| !involved(*block))
            .map(|block| (block, mentioned.contains(&block)));
        let massless = massless.collect();
        let places: Vec<[usize; 2]> =
            mass.iter().map(|entry| [block_of(&entry.row), block_of(&entry.column)]).collect();
        Self {
            separable,
            diagonal,
            quadratic: formulas.quadratic,
            depends_on,
            massless,
            skipped: skipped(model, &mass),
            zero: mass.is_empty(),
            invertible: has_matching(model, &places),
            numerically_singular: is_numerically_singular(model, &mass),
        }
    }

    /// Reports what makes M singular for certain; `at` is the formula of L.
    pub(crate) fn check(&self, model: &Model, at: Option<&Syntax>, errors: &mut Errors) {
        let Some(at) = at else { return };
        if self.zero {
            errors.push(at, self.without_mass(model));
            return;
        }
        for (block, mentioned) in &self.massless {
            let name = &model.blocks[*block].name;
            let relation = match (mentioned, self.quadratic) {
                (false, _) => "does not mention",
                (true, true) => "is linear in",
                (true, false) => "is piecewise linear in",
            };
            let message = format!(
                "L {relation} the velocity of `{name}`, so the mass matrix ∂²L/∂v∂v is singular; add a kinetic energy \
                 such as `{}`",
                kinetic_energy(model, *block)
            );
            errors.push(name, message);
        }
        for (block, index) in &self.skipped {
            let name = &model.blocks[*block].name;
            let message = format!(
                "the velocity of `{name}[{index}]` has no kinetic energy, so the mass matrix ∂²L/∂v∂v is singular; \
                 all entries have one with `{}`",
                kinetic_energy(model, *block)
            );
            errors.push(name, message);
        }
        if self.massless.is_empty() && self.skipped.is_empty() {
            self.check_rank(at, errors);
        }
    }

    fn check_rank(&self, at: &Syntax, errors: &mut Errors) {
        if !self.invertible {
            let message = "the mass matrix ∂²L/∂v∂v is singular for all parameters: its nonzero entries \
                           couple several velocities to fewer others; L needs more terms such as `dot(x).powi(2)`";
            errors.push(at, message);
        } else if self.numerically_singular {
            let message = "the mass matrix ∂²L/∂v∂v is singular: some combination of the velocities has no kinetic \
                           energy; L needs more terms such as `dot(x).powi(2)`";
            errors.push(at, message);
        }
    }

    fn without_mass(&self, model: &Model) -> String {
        if self.massless.iter().all(|(_, mentioned)| !mentioned) {
            let terms: Vec<String> =
                (0..model.blocks.len()).map(|block| kinetic_energy(model, block)).collect();
            let terms = listed(terms.iter().map(String::as_str));
            return format!("this Lagrangian mentions no velocity: add a kinetic energy such as {terms}");
        }
        if !self.quadratic {
            return "the mass matrix ∂²L/∂v∂v of this Lagrangian is zero: it needs a kinetic energy such as \
                    `dot(x).powi(2) / 2.0`"
                .to_string();
        }
        format!(
            "this Lagrangian is affine in the velocities, so its mass matrix ∂²L/∂v∂v is zero: it belongs to `{}`",
            Kind::Degenerate.attribute()
        )
    }

    /// What is said of the structure in reports.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let mass = if self.diagonal { "diagonal" } else { "full" };
        let mut sentences = Vec::new();
        match (self.separable, self.depends_on.as_slice()) {
            (true, _) => {
                sentences.push(format!("L = ½ v·M v − V(q, t) with a constant {mass} mass matrix M."));
                sentences.push(
                    match self.diagonal {
                        true => {
                            "The trapezoidal (Störmer–Verlet) step is explicit: one gradient of V a step, no iteration, no \
                             factorisation."
                        }
                        false => {
                            "The trapezoidal (Störmer–Verlet) step is explicit up to one factorisation for the whole run."
                        }
                    }
                    .to_string(),
                );
            }
            (false, []) => {
                sentences
                    .push(format!("The {mass} mass matrix is constant, but L is not ½ v·M v − V(q, t)."));
            }
            (false, variables) => {
                sentences.push(format!("The {mass} mass matrix depends on {}.", variables.join(", ")));
            }
        }
        if !self.separable {
            sentences.push("The trapezoidal step is implicit in general.".to_string());
        }
        sentences.push(
            match self.quadratic {
                true => "L is a polynomial of degree two in v: p = ∂L/∂v is affine in v.",
                false => "L is no polynomial of degree two in v: v is found from p = ∂L/∂v by iteration.",
            }
            .to_string(),
        );
        sentences
    }
}

/// `dot(x).powi(2) / 2.0`
fn kinetic_energy(model: &Model, block: usize) -> String {
    let name = &model.blocks[block].name;
    match &model.blocks[block].array {
        Some((_, size)) => format!("sum(0..{size}, |j| dot({name}[j]).powi(2) / 2.0)"),
        None => format!("dot({name}).powi(2) / 2.0"),
    }
}

/// M entry by entry, on one side of its diagonal, without those that cancel.
fn mass_entries(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Entry> {
    let mut mass: Vec<Entry> = Vec::new();
    for entry in entries {
        let (Some((Variable::Velocity, i)), Some((Variable::Velocity, j))) =
            (variable(graph, entry.row), variable(graph, entry.column))
        else {
            continue;
        };
        let (row, column) = if j < i { (j, i) } else { (i, j) };
        let same =
            |known: &&mut Entry| known.row == row && known.column == column && known.loops == entry.loops;
        match mass.iter_mut().find(same) {
            Some(known) => known.value = graph.add(known.value, entry.value),
            None => mass.push(Entry { loops: entry.loops.clone(), row, column, value: entry.value }),
        }
    }
    mass.retain(|entry| !entry.value.is_zero());
    mass
}

/// For each array of literal size, the first of its coordinates whose velocity M certainly does not involve
/// while it involves others of that array.
fn skipped(model: &Model, mass: &[Entry]) -> Vec<(usize, i64)> {
    let first_skipped = |block: usize| {
        let size = model.block_size(block).as_literal()?;
        let mut involved = Vec::new();
        for entry in mass {
            for coordinate in [&entry.row, &entry.column] {
                if coordinate.block as usize == block {
                    involved.push(reach(&coordinate.index, &entry.loops)?);
                }
            }
        }
        involved.sort_unstable();
        let reached = involved.iter().fold(
            0,
            |reached, (least, beyond)| {
                if *least <= reached { reached.max(*beyond) } else { reached }
            },
        );
        (!involved.is_empty() && reached < size).then_some((block, reached))
    };
    (0..model.blocks.len())
        .filter(|block| model.blocks[*block].array.is_some())
        .filter_map(first_skipped)
        .collect()
}

/// The range of an index that takes each value of a literal range.
fn reach(index: &Index, loops: &[Binder]) -> Option<(i64, i64)> {
    match index.terms.as_slice() {
        [] => Some((index.constant, index.constant + 1)),
        [(Atom::Bound(level), 1)] => {
            let binder = loops.iter().find(|binder| binder.level == *level && binder.except.is_none())?;
            let (lower, upper) = (binder.lower.as_literal()?, binder.upper.as_literal()?);
            Some((lower + index.constant, upper + index.constant))
        }
        _ => None,
    }
}

fn depends_on(graph: &Graph, mass: &[Entry]) -> Vec<&'static str> {
    let reachable = graph.reachable(mass.iter().map(|entry| entry.value.node));
    let any = |property: fn(&Node) -> bool| reachable.iter().any(|id| property(graph.node(*id)));
    let found = [
        ("q", any(|node| matches!(node, Node::Coordinate(_)))),
        ("v", any(|node| matches!(node, Node::Velocity(_)))),
        ("t", any(|node| matches!(node, Node::Time))),
    ];
    found.into_iter().filter(|(_, found)| *found).map(|(name, _)| name).collect()
}

fn mixes_position_and_velocity(graph: &Graph, entries: &[SecondContribution]) -> bool {
    let kind = |id: Id| variable(graph, id).map(|(kind, _)| kind);
    entries.iter().any(|entry| kind(entry.row) != kind(entry.column))
}

/// Whether ∂L/∂q is written without velocities.
fn force_is_at_rest(graph: &mut Graph, lagrangian: Expr) -> bool {
    let first = graph.gradient(lagrangian, &[]);
    first
        .iter()
        .filter(|first| matches!(graph.node(first.target), Node::Coordinate(_)))
        .all(|first| !graph.depends(first.value.node, |node| matches!(node, Node::Velocity(_))))
}

/// Whether ∂L/∂v = 0 where v = 0.
fn momentum_vanishes_at_rest(graph: &mut Graph, lagrangian: Expr) -> bool {
    let at_rest = |graph: &mut Graph, id| matches!(graph.node(id), Node::Velocity(_)).then_some(Expr::ZERO);
    let first = graph.gradient(lagrangian, &[]);
    first
        .iter()
        .filter(|first| matches!(graph.node(first.target), Node::Velocity(_)))
        .map(|first| first.value.node)
        .collect::<Vec<_>>()
        .into_iter()
        .all(|value| graph.rebuild(value, at_rest, Clone::clone).is_zero())
}

/// The blocks whose velocities stand in L.
fn mentioned(graph: &Graph, lagrangian: Expr) -> Vec<usize> {
    let reachable = graph.reachable([lagrangian.node]);
    let block = |id: Id| match graph.node(id) {
        Node::Velocity(coordinate) => Some(coordinate.block as usize),
        _ => None,
    };
    reachable.into_iter().filter_map(block).collect()
}

/// Where no arrays are involved and the entries are numbers times one common factor: whether the numbers
/// make a singular matrix, by elimination with complete pivoting. What rounding may have left of a
/// difference counts as zero.
fn is_numerically_singular(model: &Model, mass: &[Entry]) -> bool {
    let dimension = model.blocks.len();
    let common = mass.first().map(|entry| entry.value.node);
    if model.blocks.iter().any(|block| block.array.is_some())
        || mass.iter().any(|entry| Some(entry.value.node) != common)
    {
        return false;
    }
    // Each entry with the size of what it was added up from.
    let mut matrix = vec![vec![(0.0_f64, 0.0_f64); dimension]; dimension];
    for entry in mass {
        let (row, column, value) = (entry.row.block as usize, entry.column.block as usize, entry.value.scale);
        matrix[row][column] = (value, value.abs());
        matrix[column][row] = (value, value.abs());
    }
    while let Some((row, column)) = pivot(&matrix) {
        let pivoted = matrix.swap_remove(row);
        for other in &mut matrix {
            let factor = other[column].0 / pivoted[column].0;
            for ((value, size), (subtracted, _)) in other.iter_mut().zip(&pivoted) {
                *value -= factor * subtracted;
                *size += (factor * subtracted).abs();
            }
            other[column] = (0.0, 0.0);
        }
    }
    !matrix.is_empty()
}

/// The largest entry that is more than rounding.
fn pivot(matrix: &[Vec<(f64, f64)>]) -> Option<(usize, usize)> {
    let columns = matrix.iter().enumerate().flat_map(|(row, entries)| {
        entries.iter().enumerate().map(move |(column, (value, size))| (row, column, value.abs(), *size))
    });
    let significant = columns.filter(|(_, _, value, size)| *value > 64.0 * f64::EPSILON * size);
    significant.max_by(|a, b| a.2.total_cmp(&b.2)).map(|(row, column, ..)| (row, column))
}
