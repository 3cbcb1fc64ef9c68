//! The Lagrangians: each as an attribute and as plain Rust.

use dvi_core::prelude::*;
use nalgebra::{RealField, convert};

use super::equations::Formula;

fn real<T: RealField + Copy>(value: f64) -> T {
    convert(value)
}

/// A constant Dα, and a component of α that depends on time alone.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * d(y) - y * d(x)) / 2.0 + t.sin() * d(x) + t * t * d(y),
    hamiltonian = 2.0 * x + (1.0 + 0.3 * t.cos()) * y * y + x * x * y / 3.0,
)]
#[derive(Clone, Debug)]
pub(crate) struct Driven {}

impl Formula for Driven {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let ([x, y], [vx, vy]) = ([q[0], q[1]], [v[0], v[1]]);
        let form = (x * vy - y * vx) * real(0.5) + t.sin() * vx + t * t * vy;
        form - (real::<T>(2.0) * x
            + (real::<T>(1.0) + real::<T>(0.3) * t.cos()) * y * y
            + x * x * y / real(3.0))
    }
}

/// Dα depends on time, and α is linear in q.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (1.0 + depth * t.sin()) * (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = (x * x + y * y) / 2.0 + 0.2 * x * y * y * t,
)]
#[derive(Clone, Debug)]
pub(crate) struct Breathing {
    pub(crate) depth: f64,
}

impl Formula for Breathing {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let form =
            (real::<T>(1.0) + real::<T>(self.depth) * t.sin()) * (q[0] * v[1] - q[1] * v[0]) * real(0.5);
        form - ((q[0] * q[0] + q[1] * q[1]) * real(0.5) + real::<T>(0.2) * q[0] * q[1] * q[1] * t)
    }
}

/// A guiding centre in a field that varies in space and time: α is not linear, and couples all coordinates.
#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    lagrangian = sum(0..2, |j| (x[j] + kappa * x[j].powi(3) / 3.0) * dot(y[j]) - 0.1 * t * y[j] * dot(x[j]))
        + 0.2 * x[0] * y[1] * dot(x[1])
        - sum_pairs(0..2, |j, k| ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + 0.5).ln())
        - sum(0..2, |j| x[j] * (t.cos() + y[j])),
)]
#[derive(Clone, Debug)]
pub(crate) struct Guiding {
    pub(crate) kappa: f64,
}

impl Formula for Guiding {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let ([x, y], [vx, vy]) = ([[q[0], q[1]], [q[2], q[3]]], [[v[0], v[1]], [v[2], v[3]]]);
        let mut sum = real::<T>(0.2) * x[0] * y[1] * vx[1];
        for j in 0..2 {
            sum += (x[j] + real::<T>(self.kappa / 3.0) * x[j] * x[j] * x[j]) * vy[j];
            sum -= real::<T>(0.1) * t * y[j] * vx[j] + x[j] * (t.cos() + y[j]);
        }
        let (dx, dy) = (x[0] - x[1], y[0] - y[1]);
        sum - (dx * dx + dy * dy + real(0.5)).ln()
    }
}

/// Separable, with time in the potential.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + 1.5 * dot(y).powi(2)
        - (1.0 + depth * (2.0 * t).cos()) * (1.0 - (x - y).cos()) + t * x,
)]
#[derive(Clone, Debug)]
pub(crate) struct Shaken {
    pub(crate) depth: f64,
}

impl Formula for Shaken {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let kinetic = v[0] * v[0] * real(0.5) + real::<T>(1.5) * v[1] * v[1];
        let strength = real::<T>(1.0) + real::<T>(self.depth) * (t + t).cos();
        kinetic - strength * (real::<T>(1.0) - (q[0] - q[1]).cos()) + t * q[0]
    }
}

/// Separable, with a mass matrix that is not diagonal, and a size that the run knows.
#[lagrangian(
    coordinates(q[mass.len()]),
    lagrangian = sum(0..mass.len(), |j| mass[j] * dot(q[j]).powi(2)) / 2.0
        + 0.3 * sum(1..mass.len(), |j| dot(q[j]) * dot(q[j - 1]))
        - sum(1..mass.len(), |j| (q[j] - q[j - 1]).cosh()) - q[0].powi(4) / 4.0 * (1.0 + t * t / 4.0),
)]
#[derive(Clone, Debug)]
pub(crate) struct Coupled {
    pub(crate) mass: Vec<f64>,
}

impl Formula for Coupled {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let mut sum = -q[0] * q[0] * q[0] * q[0] * real(0.25) * (real::<T>(1.0) + t * t * real(0.25));
        for j in 0..q.len() {
            sum += real::<T>(self.mass[j] / 2.0) * v[j] * v[j];
            if j > 0 {
                sum += real::<T>(0.3) * v[j] * v[j - 1] - (q[j] - q[j - 1]).cosh();
            }
        }
        sum
    }
}

/// A mass that depends on q and t, velocities that are coupled, and a magnetic term that grows.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (1.0 + 0.3 * x * x) * dot(x).powi(2) / 2.0 + (0.2 * t).exp() * dot(y).powi(2) / 2.0
        + 0.3 * y.sin() * dot(x) * dot(y) + b * (1.0 + t) * x * x * dot(y) - (x * x + y.powi(4)) / 2.0 * t.cos(),
)]
#[derive(Clone, Debug)]
pub(crate) struct Magnetic {
    pub(crate) b: f64,
}

impl Formula for Magnetic {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let ([x, y], [vx, vy]) = ([q[0], q[1]], [v[0], v[1]]);
        let one = real::<T>(1.0);
        let kinetic = (one + real::<T>(0.3) * x * x) * vx * vx * real(0.5)
            + (real::<T>(0.2) * t).exp() * vy * vy * real(0.5)
            + real::<T>(0.3) * y.sin() * vx * vy;
        let potential = (x * x + y * y * y * y) * real(0.5) * t.cos();
        kinetic + real::<T>(self.b) * (one + t) * x * x * vy - potential
    }
}

/// No polynomial in v: relativistic, in a field that is switched on.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -(1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() - x * x * y * y
        + field * t.tanh() * (x * dot(y) - y * dot(x)) + t * y,
)]
#[derive(Clone, Debug)]
pub(crate) struct Fast {
    pub(crate) field: f64,
}

impl Formula for Fast {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let root = (real::<T>(1.0) - v[0] * v[0] - v[1] * v[1]).sqrt();
        let magnetic = real::<T>(self.field) * t.tanh() * (q[0] * v[1] - q[1] * v[0]);
        magnetic - root - q[0] * q[0] * q[1] * q[1] + t * q[1]
    }
}
