//! What the oracle says of a system at a point.

use super::super::evaluate::{Oracle, Outside, Point};
use super::super::jet::{Jet, Sized};
use super::super::random::Random;
use super::super::structure::same;
use super::super::system::System;

/// The number of points that a system is compared at, and of points that are drawn to find them.
const POINTS: usize = 2;
const DRAWN: usize = 40;

/// The jets of a system at one point.
pub(in super::super) struct Expected {
    pub(in super::super) point: Point,
    pub(in super::super) lagrangian: Jet,
    /// L at v = 0: −H of a degenerate system.
    pub(in super::super) at_rest: Jet,
    /// The force on each coordinate.
    pub(in super::super) forces: Vec<Jet>,
    pub(in super::super) constraints: Vec<Jet>,
    pub(in super::super) momenta: Vec<Jet>,
    /// At whose zeros L or a force is not smooth, as far as they do not stand in sums.
    pub(in super::super) seams: Vec<Jet>,
    /// Whether other velocities leave ∂²L/∂v∂v as it is.
    pub(in super::super) is_quadratic: bool,
}

impl Expected {
    /// ∂L/∂qⁱ + Fᵢ, or ∂L/∂vⁱ behind.
    pub(super) fn first(&self, i: usize) -> Sized {
        let of_lagrangian = self.lagrangian.gradient(i);
        self.forces.get(i).map_or(of_lagrangian, |force| of_lagrangian.plus(force.value))
    }

    /// The derivative of that by variable `j`.
    pub(super) fn second(&self, i: usize, j: usize) -> Sized {
        let of_lagrangian = self.lagrangian.hessian(i, j);
        self.forces.get(i).map_or(of_lagrangian, |force| of_lagrangian.plus(force.gradient(j)))
    }

    /// ∂H/∂qⁱ − Fᵢ
    pub(super) fn source(&self, i: usize) -> Sized {
        self.at_rest.gradient(i).plus(self.forces[i].value).scaled(-1.0)
    }
}

/// Points in the domain with their jets.
pub(super) fn points(system: &System, random: &mut Random) -> Result<Vec<Expected>, Outside> {
    let mut points = Vec::new();
    for _ in 0..DRAWN {
        let mut draw = || (0..system.dimension()).map(|_| random.between(-0.6, 1.8)).collect();
        let (q, v) = (draw(), draw());
        match expected(system, Point { q, v, t: random.between(-1.0, 2.0) }) {
            Ok(point) => points.push(point),
            Err(Outside::Index) => return Err(Outside::Index),
            Err(Outside::Domain) => {}
        }
        if points.len() == POINTS {
            break;
        }
    }
    if points.is_empty() { Err(Outside::Domain) } else { Ok(points) }
}

fn expected(system: &System, point: Point) -> Result<Expected, Outside> {
    let rest = Point { v: vec![0.0; point.v.len()], ..point.clone() };
    let mut oracle = Oracle::new(system, &point);
    let lagrangian = oracle.lagrangian()?;
    let forces = oracle.forces()?;
    let seams = oracle.seams;
    let momenta = system.momenta.iter().map(|formula| Oracle::new(system, &point).value(formula));
    let momenta = momenta.collect::<Result<_, _>>()?;
    let constraints = Oracle::new(system, &point).constraints()?;
    // A regular L need not exist at rest.
    let at_rest =
        if system.is_regular() { lagrangian.clone() } else { Oracle::new(system, &rest).lagrangian()? };
    let n = system.dimension();
    let other = Point { v: point.v.iter().map(|v| 0.3 - 0.7 * v).collect(), ..point.clone() };
    let is_quadratic = match Oracle::new(system, &other).lagrangian() {
        Ok(other) => (0..n)
            .all(|i| (0..n).all(|j| same(lagrangian.hessian(n + i, n + j), other.hessian(n + i, n + j)))),
        Err(_) => true,
    };
    Ok(Expected { point, lagrangian, at_rest, forces, constraints, momenta, seams, is_quadratic })
}
