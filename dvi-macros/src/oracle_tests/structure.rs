//! The declared structure of a system against numbers: a declaration that numbers refute is an error,
//! one that is missing where numbers would allow it is counted.

use super::compare::{Difference, Expected};
use super::jet::Sized;
use super::rust::Expansion;
use super::system::System;
use crate::syntax::Constrained;

/// Each constant as it is declared, and as the numbers allow it.
pub(super) type Claims = Vec<(&'static str, bool, bool)>;

/// Entries below this part of their size are zero.
const ZERO: f64 = 1e-9;

fn is_zero(entry: Sized) -> bool {
    entry.value.abs() <= ZERO * entry.size
}

pub(super) fn same(one: Sized, other: Sized) -> bool {
    is_zero(one.plus(other.scaled(-1.0)))
}

pub(super) fn hold(
    system: &System,
    expansion: &Expansion,
    conjugates: &[usize],
    points: &[Expected],
) -> Result<Claims, Difference> {
    let n = system.dimension();
    let numbers = if system.is_regular() { regular(n, points) } else { degenerate(n, conjugates, points) };
    let mut claims = Claims::new();
    for (name, possible) in numbers.into_iter().chain([("AUTONOMOUS", autonomous(system, n, points))]) {
        let declared = expansion.constants[name];
        if declared && !possible {
            let q: Vec<&Vec<f64>> = points.iter().map(|expected| &expected.point.q).collect();
            return Err((name.into(), format!("{name} is declared, and numbers refute it at q = {q:?}")));
        }
        claims.push((name, declared, possible));
    }
    let implied = [
        ("MATCHING", "CANONICAL"),
        ("SEPARABLE", "CONSTANT_MASS"),
        ("CONSTANT_MASS", "UNIFORM_MASS"),
        ("UNIFORM_MASS", "QUADRATIC"),
    ];
    for (one, other) in implied {
        if expansion.constants.get(one) == Some(&true) && !expansion.constants[other] {
            return Err((one.into(), format!("{one} is declared without {other}")));
        }
    }
    Ok(claims)
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)))
}

/// Whether neither L nor a force nor a constraint changes with the time, and ∂L/∂v does not; gaps may.
fn autonomous(system: &System, n: usize, points: &[Expected]) -> bool {
    let constraints = |at: &Expected| match system.constrained {
        Constrained::Gaps => Vec::new(),
        Constrained::Positions | Constrained::Velocities => at.constraints.clone(),
    };
    points.iter().all(|at| {
        is_zero(at.lagrangian.gradient(2 * n))
            && (0..2 * n).all(|i| is_zero(at.lagrangian.hessian(i, 2 * n)))
            && at.forces.iter().chain(&constraints(at)).all(|value| is_zero(value.gradient(2 * n)))
    })
}

fn degenerate(n: usize, conjugates: &[usize], points: &[Expected]) -> Vec<(&'static str, bool)> {
    let dalpha = |at: &Expected, i: usize, j: usize| at.lagrangian.hessian(n + i, j);
    let omega = |at: &Expected, i: usize, j: usize| dalpha(at, j, i).plus(dalpha(at, i, j).scaled(-1.0));
    let first = &points[0];
    let constant =
        points.iter().all(|at| pairs(n).all(|(i, j)| same(dalpha(at, i, j), dalpha(first, i, j))));
    let free_of_time = points.iter().all(|at| (0..n).all(|i| is_zero(at.lagrangian.hessian(n + i, 2 * n))));
    // Where nothing is declared, every coordinate is its own conjugate.
    let involution =
        (0..n).all(|i| conjugates[i] < n && conjugates[i] != i && conjugates[conjugates[i]] == i);
    let couples = |entry: &dyn Fn(&Expected, usize, usize) -> Sized| {
        let alone =
            |i: usize, j: usize| j == conjugates[i] || points.iter().all(|at| is_zero(entry(at, i, j)));
        involution && pairs(n).all(|(i, j)| alone(i, j))
    };
    vec![
        ("AFFINE", constant && free_of_time),
        ("MATCHING", couples(&dalpha)),
        ("CANONICAL", couples(&omega)),
    ]
}

fn regular(n: usize, points: &[Expected]) -> Vec<(&'static str, bool)> {
    let mass = |at: &Expected, i: usize, j: usize| at.lagrangian.hessian(n + i, n + j);
    let first = &points[0];
    let constant = points.iter().all(|at| pairs(n).all(|(i, j)| same(mass(at, i, j), mass(first, i, j))));
    let diagonal = points.iter().all(|at| pairs(n).all(|(i, j)| i == j || is_zero(mass(at, i, j))));
    let fixed = |at: &Expected| {
        // Neither q nor t moves ∂L/∂v, and it is M v.
        let still = (0..n).all(|i| {
            let variables = (0..n).chain([2 * n]);
            variables.into_iter().all(|j| is_zero(at.lagrangian.hessian(n + i, j)))
        });
        let momentum = |i: usize| {
            (0..n).fold(Sized::default(), |sum, j| sum.plus(mass(at, i, j).times(Sized::new(at.point.v[j]))))
        };
        still && (0..n).all(|i| same(momentum(i), at.lagrangian.gradient(n + i)))
    };
    let at_rest =
        |at: &Expected| at.forces.iter().all(|force| (n..2 * n).all(|j| is_zero(force.gradient(j))));
    vec![
        ("UNIFORM_MASS", constant),
        ("CONSTANT_MASS", constant && points.iter().all(fixed)),
        ("SEPARABLE", constant && points.iter().all(|at| fixed(at) && at_rest(at))),
        ("DIAGONAL_MASS", diagonal),
        ("QUADRATIC", points.iter().all(|at| at.is_quadratic)),
    ]
}
