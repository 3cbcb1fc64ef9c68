//! The mass matrix M = ∂²L/∂v∂v of a regular system.

use syn::Expr as Syntax;

use super::singular::{is_numerically_singular, skipped};
use super::{Entry, collected, has_matching};
use crate::errors::{Errors, listed};
use crate::formulas::RegularFormulas;
use crate::model::{Block, Grid, Model};
use crate::symbolic::{Expr, Graph, Id, Node, SecondContribution, Variable};
use crate::syntax::{Constrained, Factor, Kind};

/// The structure of a regular L; see the constants of `dvi_core::NondegenerateLagrangian`.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix {
    /// L is, and no force depends on velocities.
    pub(crate) separable: bool,
    /// L is, whatever the forces.
    pub(crate) constant: bool,
    /// L is, but for terms that are linear in v.
    pub(crate) uniform: bool,
    pub(crate) diagonal: bool,
    pub(crate) quadratic: bool,
    /// What M depends on, of `q`, `v` and `t`.
    depends_on: Vec<&'static str>,
    /// Blocks that M does not involve, and whether L mentions their velocities at all.
    massless: Vec<(usize, bool)>,
    /// Those of them that L is affine in, as in the multipliers of constraints.
    multipliers: Vec<usize>,
    /// Coordinates of arrays that M does not involve.
    skipped: Vec<(usize, i64)>,
    /// Whether M is zero.
    zero: bool,
    /// Whether the places of M that are not zero leave room for an inverse.
    invertible: bool,
    /// Whether the entries are numbers times a common factor, and the numbers make a singular matrix.
    numerically_singular: bool,
}

impl MassMatrix {
    /// From the formulas and the second derivative of L.
    pub(crate) fn new(
        graph: &mut Graph,
        model: &Model,
        formulas: &RegularFormulas,
        entries: &[SecondContribution],
    ) -> Self {
        let mass = mass_entries(graph, entries);
        let places: Vec<[usize; 2]> = mass.iter().map(Entry::blocks).collect();
        let depends_on = depends_on(graph, &mass);
        let diagonal = mass.iter().all(|entry| entry.row == entry.column);
        let uniform = formulas.quadratic && depends_on.is_empty();
        let constant = uniform
            && !mixes_position_and_velocity(graph, entries)
            && is_still_at_rest(graph, formulas.lagrangian);
        let separable = constant && !formulas.force.iter().any(|part| graph.has_velocity(part.value.node));
        let mentioned = mentioned(graph, formulas.lagrangian);
        let involved = |block: usize| places.iter().any(|place| place.contains(&block));
        let massless = (0..model.blocks.len())
            .filter(|&block| !involved(block) && !model.blocks[block].is_without_velocity())
            .map(|block| (block, mentioned.contains(&block)));
        let massless: Vec<(usize, bool)> = massless.collect();
        let multipliers = multipliers(graph, entries, &massless);
        Self {
            separable,
            constant,
            uniform,
            diagonal,
            quadratic: formulas.quadratic,
            depends_on,
            massless,
            multipliers,
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
            let at = &model.blocks[*block].name;
            let velocity = match model.blocks[*block].axis {
                Some(_) => velocity(&model.blocks[*block], None),
                None => format!("the velocity of `{at}`"),
            };
            let relation = match (mentioned, self.quadratic) {
                (false, _) => "does not mention",
                (true, true) => "is linear in",
                (true, false) => "is piecewise linear in",
            };
            let or_else = if self.multipliers.contains(block) {
                ", or write `constraint = g` for what it multiplies"
            } else {
                ""
            };
            let message = format!(
                "L {relation} {velocity}, so the mass matrix ∂²L/∂v∂v is singular; add a kinetic energy \
                 such as `{}`{or_else}",
                kinetic_energy(model, *block)
            );
            // What has no components has none for each of them.
            errors.push_once(&format!("mass of {at}"), at, message);
        }
        for (block, index) in &self.skipped {
            let name = &model.blocks[*block].name;
            let velocity = velocity(&model.blocks[*block], Some(*index));
            let message = format!(
                "{velocity} has no kinetic energy, so the mass matrix ∂²L/∂v∂v is singular; \
                 all entries have one with `{}`",
                kinetic_energy(model, *block)
            );
            errors.push_once(&format!("mass of {name}"), name, message);
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
            let blocks = model.coordinates();
            let terms = listed(blocks.iter().map(|blocks| kinetic_energy(model, blocks.start)));
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

    /// What is said of the structure in reports, of a system with constraints or without.
    pub(crate) fn sentences(&self, constrained: Option<Constrained>, model: &Model) -> Vec<String> {
        let mass = if self.diagonal { "diagonal" } else { "full" };
        let form = match (self.constant, self.depends_on.as_slice()) {
            (true, _) => format!("L = ½ v·M v − V(q, t) with a constant {mass} mass matrix M."),
            (false, []) => format!("The {mass} mass matrix is constant, but L is not ½ v·M v − V(q, t)."),
            (false, variables) => format!("The {mass} mass matrix depends on {}.", variables.join(", ")),
        };
        if model.is_on_manifold() {
            let block = |block: &Block| {
                let name = block.label().replace("r#", "");
                match block.factor {
                    Factor::Line => None,
                    Factor::Rotation => {
                        Some(format!("`{name}` is in SO(3), and its velocity is that in the body."))
                    }
                    Factor::Sphere => Some(format!("`{name}` is in S².")),
                }
            };
            let firsts = model.coordinates().into_iter().map(|blocks| &model.blocks[blocks.start]);
            let step = "A step moves along a geodesic, and solves for its velocity.".to_string();
            let begin = "Begin with `Geodesic::trapezoid()`.".to_string();
            return firsts.filter_map(block).chain([step, begin]).collect();
        }
        let step = match (self.separable, self.diagonal) {
            _ if matches!(constrained, Some(Constrained::Positions | Constrained::Velocities)) => {
                "A step solves for the Lagrange multipliers λ, one for each constraint."
            }
            (true, true) => {
                "The trapezoidal (Störmer–Verlet) step is explicit: one gradient of V a step, no iteration, no \
                 factorisation."
            }
            (true, false) => {
                "The trapezoidal (Störmer–Verlet) step is explicit up to one factorisation for the whole run."
            }
            (false, _) if self.constant => {
                "A force depends on velocities: the trapezoidal step is implicit, and linear in the velocity if the force is."
            }
            (false, _) => "The trapezoidal step is implicit in general.",
        };
        let degree = match self.quadratic {
            true => "L is a polynomial of degree two in v: p = ∂L/∂v is affine in v.",
            false => "L is no polynomial of degree two in v: v is found from p = ∂L/∂v by iteration.",
        };
        let begin = match (constrained, self.separable) {
            (None, true) => "Begin with `Variational::trapezoid()`.",
            (None, false) => "Begin with `Variational::midpoint()`.",
            (Some(Constrained::Gaps), true) => "Begin with `Impacts` around `Variational::trapezoid()`.",
            (Some(Constrained::Gaps), false) => "Begin with `Impacts` around `Variational::midpoint()`.",
            (Some(Constrained::Positions), true) => "Begin with `Rattle`.",
            (Some(Constrained::Positions), false) | (Some(Constrained::Velocities), _) => {
                "Begin with `Constrained::new(Midpoint)`."
            }
        };
        [form, step.to_string(), degree.to_string(), begin.to_string()].into()
    }
}

/// The velocity at a place in an array, or at any.
fn velocity(block: &Block, place: Option<i64>) -> String {
    let Block { name, factor, axis, .. } = block;
    let index = place.map_or_else(|| "i".to_string(), |place| place.to_string());
    match (factor, axis) {
        (Factor::Line | Factor::Sphere, _) => {
            let entry = place.map_or_else(|| block.entry(&index), |place| block.at(place));
            format!("the velocity of `{entry}`")
        }
        (Factor::Rotation, Some(axis)) => {
            format!("the angular velocity `omega({name}[{index}])[{}]`", axis.number)
        }
        (Factor::Rotation, None) => format!("the angular velocity `omega({name})[{index}]`"),
    }
}

/// `dot(x).powi(2) / 2.0`
fn kinetic_energy(model: &Model, block: usize) -> String {
    let Block { name, array, grid, factor, axis } = &model.blocks[block];
    if let Some(Grid { texts: [n, m], .. }) = grid {
        return format!("sum(0..{n}, |i| sum(0..{m}, |j| dot({name}[i][j]).powi(2) / 2.0))");
    }
    match array {
        Some((_, size)) if *factor == Factor::Rotation && axis.is_some() => {
            format!("sum(0..{size}, |j| omega({name}[j]).norm_squared() / 2.0)")
        }
        Some(_) if *factor == Factor::Rotation => {
            format!("(omega({name})[0].powi(2) + omega({name})[1].powi(2) + omega({name})[2].powi(2)) / 2.0")
        }
        Some((_, size)) if axis.is_some() => {
            format!("sum(0..{size}, |j| dot({name}[j]).norm_squared() / 2.0)")
        }
        Some((_, size)) => format!("sum(0..{size}, |j| dot({name}[j]).powi(2) / 2.0)"),
        None => format!("dot({name}).powi(2) / 2.0"),
    }
}

/// M entry by entry, on one side of its diagonal.
fn mass_entries(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Entry> {
    let entry = |entry: &SecondContribution| match (graph.variable(entry.row), graph.variable(entry.column))
    {
        ((Variable::Velocity, i), (Variable::Velocity, j)) => {
            let (row, column) = if j < i { (j, i) } else { (i, j) };
            let (row, column) = (row.clone(), column.clone());
            Some(Entry { loops: entry.loops.clone(), row, column, value: entry.value })
        }
        _ => None,
    };
    let entries: Vec<Entry> = entries.iter().filter_map(entry).collect();
    collected(graph, entries)
}

fn depends_on(graph: &Graph, mass: &[Entry]) -> Vec<&'static str> {
    let reachable = graph.reachable(mass.iter().map(|entry| entry.value.node));
    let any = |property: fn(&Node) -> bool| reachable.iter().any(|id| property(graph.node(*id)));
    let found = [("q", any(Node::is_position)), ("v", any(Node::is_velocity)), ("t", any(Node::is_time))];
    found.into_iter().filter(|(_, found)| *found).map(|(name, _)| name).collect()
}

fn mixes_position_and_velocity(graph: &Graph, entries: &[SecondContribution]) -> bool {
    let kind = |id: Id| graph.variable(id).0;
    entries.iter().any(|entry| kind(entry.row) != kind(entry.column))
}

/// Those of the blocks without mass that L is affine in, with functions of other coordinates as factors.
fn multipliers(graph: &Graph, entries: &[SecondContribution], massless: &[(usize, bool)]) -> Vec<usize> {
    let blocks = |entry: &SecondContribution| {
        let variables = [entry.row, entry.column].map(|id| graph.variable(id));
        let positions = variables.iter().all(|(kind, _)| *kind == Variable::Position);
        positions.then(|| variables.map(|(_, at)| at.block as usize))
    };
    let pairs: Vec<[usize; 2]> = entries.iter().filter_map(blocks).collect();
    let multiplies = |block: usize| {
        let mut with = pairs.iter().filter(|pair| pair.contains(&block)).peekable();
        with.peek().is_some() && with.all(|pair| *pair != [block, block])
    };
    let unmentioned = massless.iter().filter(|(_, mentioned)| !mentioned);
    unmentioned.map(|(block, _)| *block).filter(|block| multiplies(*block)).collect()
}

/// Whether ∂L/∂q is written without velocities, and ∂L/∂v = 0 where v = 0.
fn is_still_at_rest(graph: &mut Graph, lagrangian: Expr) -> bool {
    let first = graph.gradient(lagrangian, &[]);
    let (forces, momenta): (Vec<_>, Vec<_>) =
        first.into_iter().partition(|first| graph.node(first.target).is_position());
    forces.iter().all(|force| !graph.has_velocity(force.value.node))
        && momenta.into_iter().all(|momentum| graph.at_rest(momentum.value).is_zero())
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
