//! Systems with constraints.

use dvi_core::field::{Axis, Spline};
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// A pendulum whose pivot moves, with a force and a mass that depends on the position.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (1.0 + x * x) * (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
    force(x) = -0.1 * dot(x),
    constraint = {
        let pivot = amplitude * (3.0 * t).sin();
        (x - pivot).hypot(y - t * t) - 1.5
    },
)]
#[derive(Clone, Debug)]
pub(crate) struct Driven {
    pub(crate) amplitude: f64,
}

/// A chain of three.
#[lagrangian(
    coordinates(x[3], y[3]),
    lagrangian = sum(0..3, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]),
    constraint(i in 0..3 - 1) = (x[i + 1] - x[i]).powi(2) + (y[i + 1] - y[i]).powi(2) - 1.0,
)]
#[derive(Clone, Debug)]
pub(crate) struct Three;

/// A chain of const length.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]),
    constraint(i in 0..N - 1) = (x[i + 1] - x[i]).powi(2) + (y[i + 1] - y[i]).powi(2) - rods[i] * rods[i],
)]
#[derive(Clone, Debug)]
pub(crate) struct Chain<const N: usize> {
    pub(crate) rods: Vec<f64>,
}

/// A chain of run-time length between two walls, its constraints before, between and behind those of the
/// walls.
#[lagrangian(
    coordinates(x[rods.len() + 1], y[rods.len() + 1]),
    lagrangian = sum(0..=rods.len(), |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]),
    constraint = x[0] - 0.1 * t,
    constraint(k in 1..rods.len() + 1) =
        (x[k] - x[k - 1]).powi(2) + (y[k] - y[k - 1]).powi(2) - rods[k - 1] * rods[k - 1],
    constraint = [y[0], sum(0..=rods.len(), |j| (j as f64) * x[j] * y[j]) - 1.0],
    constraint(k in 0..rods.len() - 2) = x[k] * x[k + 2] * t,
    constraint = x[rods.len()] * y[rods.len()],
)]
#[derive(Clone, Debug)]
pub(crate) struct Hung {
    pub(crate) rods: Vec<f64>,
}

/// As many constraints as particles, and two more.
#[lagrangian(
    coordinates(x[N], y[N], w),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 + dot(w).powi(2) / 2.0,
    constraint = [w - sum(0..N, |i| x[i]), w * w * (x[0] + y[0])],
    constraint(i in 0..N) = x[i] * x[i] + y[(i + 1) % N].cos() - w,
)]
#[derive(Clone, Debug)]
pub(crate) struct Linked<const N: usize>;

/// A disc that rolls upright on a plane, with a force and a parameter of any type of numbers.
#[lagrangian(
    coordinates(x, y, theta, phi),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + dot(theta).powi(2) / 4.0 + dot(phi).powi(2) / 8.0,
    force(theta) = -0.1 * dot(theta),
    nonholonomic = [dot(x) - radius * dot(theta) * phi.cos(), dot(y) - radius * dot(theta) * phi.sin()],
)]
#[derive(Clone, Debug)]
pub(crate) struct Disc<P> {
    pub(crate) radius: P,
}

/// A train of sledges on ice that turns under them: families before and behind single constraints, whose
/// sums stand in both, and the time.
#[lagrangian(
    coordinates(x[headings.len()], y[headings.len()], w),
    lagrangian = sum(0..headings.len(), |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0
        + (1.0 + w * w) * dot(w).powi(2),
    nonholonomic(i in 0..headings.len()) =
        dot(x[i]) * (headings[i] + t * w).sin() - dot(y[i]) * (headings[i] + t * w).cos(),
    nonholonomic = dot(w) - sum(0..headings.len(), |j| x[j] * dot(y[j]) - (j as f64) * t.powi(2)),
    nonholonomic(k in 1..headings.len() - 1) =
        (x[k] - x[k - 1]) * (dot(x[k]) - dot(x[k - 1])) + t * dot(w) * y[k + 1].exp(),
)]
#[derive(Clone, Debug)]
pub(crate) struct Train {
    pub(crate) headings: Vec<f64>,
}

/// As many constraints as particles, of const number.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
    nonholonomic(i in 0..N) =
        if x[i] > 0.0 { dot(y[i]) - x[i] * dot(x[(i + 1) % N]) } else { dot(x[i]) + t },
)]
#[derive(Clone, Debug)]
pub(crate) struct Ring<const N: usize>;

/// A bead on a surface that is given by a table.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - z,
    constraint = z - surface(x, y),
)]
#[derive(Clone, Debug)]
pub(crate) struct Beads<S> {
    pub(crate) surface: S,
}

/// z = x y (1 + x) in the table of a spline.
pub(crate) fn surface() -> Outcome<Spline<2>> {
    let axis = || Axis::uniform([-1.0, 1.0], 9);
    let at = |k: usize| -1.0 + 0.25 * k as f64;
    let values: Vec<f64> = (0..81).map(|k| at(k / 9) * at(k % 9) * (1.0 + at(k / 9))).collect();
    Ok(Spline::new([axis()?, axis()?], &values)?)
}
