//! Systems with constraints, each with its constraints written a second time.

use dvi_core::field::{Axis, Spline};
use dvi_core::prelude::*;
use dvi_core::{HolonomicLagrangian, NondegenerateLagrangian, Scalar};
use dvi_tests::Outcome;
use dvi_tests::zoo::constrained::Pendulum;
use num_dual::HyperDual64;

pub(super) use crate::derivatives::oracle::Number;

/// A system and its g, written a second time.
pub(crate) trait ByHand: HolonomicLagrangian + NondegenerateLagrangian<HyperDual64> {
    fn by_hand<D: Number>(&self, q: &[D], t: D) -> Vec<D>;
}

impl ByHand for Pendulum {
    fn by_hand<D: Number>(&self, q: &[D], _: D) -> Vec<D> {
        vec![q[0] * q[0] + q[1] * q[1] - self.length * self.length]
    }
}

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

impl ByHand for Driven {
    fn by_hand<D: Number>(&self, q: &[D], t: D) -> Vec<D> {
        let pivot = (t * 3.0).sin() * self.amplitude;
        let (dx, dy) = (q[0] - pivot, q[1] - t * t);
        vec![(dx * dx + dy * dy).sqrt() - 1.5]
    }
}

/// The squared distances of neighbours, less those of the rods between them.
fn chain<D: Number>(q: &[D], n: usize, length: impl Fn(usize) -> f64) -> Vec<D> {
    let rod = |i: usize| {
        let (dx, dy) = (q[i + 1] - q[i], q[n + i + 1] - q[n + i]);
        dx * dx + dy * dy - length(i) * length(i)
    };
    (0..n.saturating_sub(1)).map(rod).collect()
}

/// A chain of three.
#[lagrangian(
    coordinates(x[3], y[3]),
    lagrangian = sum(0..3, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]),
    constraint(i in 0..3 - 1) = (x[i + 1] - x[i]).powi(2) + (y[i + 1] - y[i]).powi(2) - 1.0,
)]
#[derive(Clone, Debug)]
pub(crate) struct Three;

impl ByHand for Three {
    fn by_hand<D: Number>(&self, q: &[D], _: D) -> Vec<D> {
        chain(q, 3, |_| 1.0)
    }
}

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

impl<const N: usize> ByHand for Chain<N> {
    fn by_hand<D: Number>(&self, q: &[D], _: D) -> Vec<D> {
        chain(q, N, |i| self.rods[i])
    }
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

impl ByHand for Hung {
    fn by_hand<D: Number>(&self, q: &[D], t: D) -> Vec<D> {
        let n = self.rods.len() + 1;
        let mut g = vec![q[0] - t * 0.1];
        g.extend(chain(q, n, |i| self.rods[i]));
        g.push(q[n]);
        g.push((0..n).map(|j| q[j] * q[n + j] * j as f64).sum::<D>() - 1.0);
        g.extend((0..self.rods.len().saturating_sub(2)).map(|k| q[k] * q[k + 2] * t));
        g.push(q[n - 1] * q[2 * n - 1]);
        g
    }
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

impl<const N: usize> ByHand for Linked<N> {
    fn by_hand<D: Number>(&self, q: &[D], _: D) -> Vec<D> {
        let w = q[2 * N];
        let mut g = vec![w - q[..N].iter().copied().sum::<D>(), w * w * (q[0] + q[N])];
        g.extend((0..N).map(|i| q[i] * q[i] + q[N + (i + 1) % N].cos() - w));
        g
    }
}

fn track<T: Scalar>(x: T) -> T {
    (x * T::lift(2.0)).sin()
}
fn track_slope<T: Scalar>(x: T) -> T {
    (x * T::lift(2.0)).cos() * T::lift(2.0)
}
fn track_curvature<T: Scalar>(x: T) -> T {
    -(x * T::lift(2.0)).sin() * T::lift(4.0)
}

/// A bead on a track that is given by a function, and one on a surface that is given by a table.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - z,
    functions(track = [track, track_slope, track_curvature]),
    constraint = y - track(x) - 0.2 * track(t * x),
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
