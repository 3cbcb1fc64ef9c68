//! Systems that are written twice: as an attribute, which schemes integrate, and as plain Rust, of which
//! the equations are made.

use dvi_core::prelude::*;
pub use dvi_examples::models::{
    RadialFriction as Damped, RadialFrictionState as DampedState, RadialFrictionStateOf as DampedStateOf,
};
use nalgebra::{RealField, convert};

use super::formula::Formula;
use super::fuse;

/// A number of any kind.
pub fn real<T: RealField + Copy>(value: f64) -> T {
    convert(value)
}

/// A constant Dα, and a component of α that depends on time alone.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * d(y) - y * d(x)) / 2.0 + t.sin() * d(x) + t * t * d(y),
    hamiltonian = 2.0 * x + (1.0 + 0.3 * t.cos()) * y * y + x * x * y / 3.0,
)]
#[derive(Clone, Debug)]
pub struct Driven {}

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
pub struct Breathing {
    /// Depth of the modulation.
    pub depth: f64,
}

impl Formula for Breathing {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let form =
            (real::<T>(1.0) + real::<T>(self.depth) * t.sin()) * (q[0] * v[1] - q[1] * v[0]) * real(0.5);
        form - ((q[0] * q[0] + q[1] * q[1]) * real(0.5) + real::<T>(0.2) * q[0] * q[1] * q[1] * t)
    }
}

/// A guiding centre in a field that varies in space and time: α is not linear, and couples all
/// coordinates.
#[degenerate_lagrangian(
    coordinates(x[2], y[2]),
    lagrangian = sum(0..2, |j| (x[j] + kappa * x[j].powi(3) / 3.0) * dot(y[j]) - 0.1 * t * y[j] * dot(x[j]))
        + 0.2 * x[0] * y[1] * dot(x[1])
        - sum_pairs(0..2, |j, k| ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + 0.5).ln())
        - sum(0..2, |j| x[j] * (t.cos() + y[j])),
)]
#[derive(Clone, Debug)]
pub struct Guiding {
    /// How nonlinear α is.
    pub kappa: f64,
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
pub struct Shaken {
    /// Depth of the modulation.
    pub depth: f64,
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
pub struct Coupled {
    /// Masses.
    pub mass: Vec<f64>,
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
pub struct Magnetic {
    /// Magnetic field.
    pub b: f64,
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
pub struct Fast {
    /// Magnetic field.
    pub field: f64,
}

impl Formula for Fast {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let root = (real::<T>(1.0) - v[0] * v[0] - v[1] * v[1]).sqrt();
        let magnetic = real::<T>(self.field) * t.tanh() * (q[0] * v[1] - q[1] * v[0]);
        magnetic - root - q[0] * q[0] * q[1] * q[1] + t * q[1]
    }
}

/// In class: no component of α is affine, nothing is separable, the halves stand mixed, and one of them
/// begins in the middle of an array.
#[degenerate_lagrangian(
    coordinates(z[3], u),
    one_form = (z[0] + z[0].powi(3) / 3.0 + 0.2 * (z[1] + u).sin() * z[2]) * d(u)
        + ((z[2] / 2.0).sinh() + z[0] * z[1].cos() / 4.0) * d(z[1]),
    hamiltonian = z[0].powi(2) / 2.0 + z[2].powi(2) / 2.0 + (1.0 - u.cos()) + z[1].powi(4) / 4.0
        + 0.3 * z[0] * z[2] * (u - z[1]).cos(),
)]
#[derive(Clone, Debug)]
pub struct Mixed;

impl Formula for Mixed {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let ([a, b, c, u], half) = ([q[0], q[1], q[2], q[3]], real::<T>(0.5));
        let along_u = a + a * a * a / real(3.0) + real::<T>(0.2) * (b + u).sin() * c;
        let along_b = (c * half).sinh() + a * b.cos() * real(0.25);
        let energy = (a * a + c * c) * half + real(1.0) - u.cos()
            + b * b * b * b * real(0.25)
            + real::<T>(0.3) * a * c * (u - b).cos();
        along_u * v[3] + along_b * v[1] - energy
    }
}

/// In class: a form that depends on time, and arrays of run-time size.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| ((1.0 + t / 4.0) * y[j] + y[j].powi(3) / 6.0 + x[j] * y[(j + 1) % n] / 8.0) * d(x[j])),
    hamiltonian = sum(0..n, |j| (x[j].powi(2) + y[j].powi(2)) / 2.0 + (x[(j + 1) % n] - x[j]).powi(4) / 4.0)
        + x[0] * t.sin(),
)]
#[derive(Clone, Debug)]
pub struct Belt {
    /// How many there are.
    pub n: usize,
}

impl Formula for Belt {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let (n, half) = (self.n, real::<T>(0.5));
        let mut sum = -q[0] * t.sin();
        for j in 0..n {
            let (x, y, next) = (q[j], q[n + j], (j + 1) % n);
            let form = (real::<T>(1.0) + t * real(0.25)) * y
                + y * y * y / real(6.0)
                + x * q[n + next] * real(0.125);
            let square = (q[next] - x) * (q[next] - x);
            sum += form * v[j] - (x * x + y * y) * half - square * square * real(0.25);
        }
        sum
    }
}

/// A form that depends on time, of two bodies whose number is known at run time only, in no class.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| ((1.0 + t / 4.0) * y[j] + y[j].powi(3) / 6.0 + x[j] * y[(j + 1) % n] / 8.0) * d(x[j])
        + 0.2 * x[j].sin() * y[(j + 1) % n] * d(y[j])),
    hamiltonian = sum(0..n, |j| (x[j].powi(2) + y[j].powi(2)) / 2.0 + (x[(j + 1) % n] - x[j]).powi(4) / 4.0)
        + x[0] * t.sin(),
)]
#[derive(Clone, Debug)]
pub struct Loose {
    /// How many there are.
    pub n: usize,
}

impl Formula for Loose {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let n = self.n;
        let across = |j: usize| real::<T>(0.2) * q[j].sin() * q[n + (j + 1) % n] * v[n + j];
        (0..n).fold(Formula::lagrangian(&Belt { n }, q, v, t), |sum, j| sum + across(j))
    }
}

/// α = p·dq, with a force, and a size that the run knows.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |j| p[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| p[j] * p[j] / 2.0 + k * (x[j] - 0.3 * x[(j + 1) % n].powi(2)).powi(2) / 2.0),
    force(x) = |j| -gamma * p[j] + 0.5 * (2.0 * t).cos(),
)]
#[derive(Clone, Debug)]
pub struct Canonical {
    /// How many there are.
    pub n: usize,
    /// Stiffness.
    pub k: f64,
    /// Friction.
    pub gamma: f64,
}

impl Formula for Canonical {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let (real, n) = (convert::<f64, T>, self.n);
        (0..n).fold(real(0.0), |sum, j| {
            let off = q[j] - real(0.3) * q[(j + 1) % n] * q[(j + 1) % n];
            sum + q[n + j] * v[j] - q[n + j] * q[n + j] * real(0.5) - real(self.k / 2.0) * off * off
        })
    }
    fn force(&self, q: &[f64], _v: &[f64], t: f64) -> Vec<f64> {
        q[self.n..].iter().map(|p| -self.gamma * p + 0.5 * (2.0 * t).cos()).collect()
    }
}

/// α depends on time and on the coordinates, of which it is no linear function, and H is stiff.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (y + y.powi(3) / 3.0 + 0.2 * t * x * y) * d(x),
    hamiltonian = k * (x * x / 2.0 + y * y / 2.0 + x.powi(4) / 4.0),
)]
#[derive(Clone, Debug)]
pub struct Bent {
    /// Stiffness.
    pub k: f64,
}

impl Formula for Bent {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let (real, [x, y]) = (convert::<f64, T>, [q[0], q[1]]);
        let form = y + y * y * y / real(3.0) + real(0.2) * t * x * y;
        form * v[0] - real(self.k) * ((x * x + y * y) * real(0.5) + x * x * x * x * real(0.25))
    }
}

/// Predators y and prey x, of which some are taken away, in a form that is not affine.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y.ln() / x * d(x),
    hamiltonian = x - x.ln() + y - 2.0 * y.ln(),
    force = [-harvest * x / (1.0 + x * y), harvest * (x - 0.3 * y * y)],
)]
#[derive(Clone, Copy, Debug)]
pub struct Harvested {
    /// How many are taken.
    pub harvest: f64,
}

impl Formula for Harvested {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let [x, y] = [q[0], q[1]];
        y.ln() / x * v[0] - (x - x.ln() + y - y.ln() - y.ln())
    }
    fn force(&self, q: &[f64], _v: &[f64], _t: f64) -> Vec<f64> {
        let [x, y] = [q[0], q[1]];
        vec![-self.harvest * x / (1.0 + x * y), self.harvest * (x - 0.3 * y * y)]
    }
}

/// A hard spring that is not linear, in the plane: separable, with two masses.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + 1.5 * dot(y).powi(2) - k * (x.hypot(y) - 1.0).powi(2) / 2.0 - x * y,
)]
#[derive(Clone, Debug)]
pub struct Hard {
    /// Stiffness.
    pub k: f64,
}

impl Formula for Hard {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let real = convert::<f64, T>;
        let stretched = (q[0] * q[0] + q[1] * q[1]).sqrt() - real(1.0);
        v[0] * v[0] * real(0.5) + v[1] * v[1] * real(1.5)
            - real(self.k / 2.0) * stretched * stretched
            - q[0] * q[1]
    }
}

/// Masses that depend on the place and on time, a magnetic term, and friction.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (2.0 + x.sin()) * dot(x).powi(2) / 2.0 + (0.2 * t).exp() * dot(y).powi(2) / 2.0 + b * x * dot(y)
        - k * (x - 0.3 * y * y).powi(2) / 2.0,
    force(x) = -gamma * (dot(x) + 0.03 * dot(x).powi(3) - dot(y)),
)]
#[derive(Clone, Debug)]
pub struct Rubbing {
    /// Magnetic field.
    pub b: f64,
    /// Stiffness.
    pub k: f64,
    /// Friction.
    pub gamma: f64,
}

impl Formula for Rubbing {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
        let real = convert::<f64, T>;
        let off = q[0] - real(0.3) * q[1] * q[1];
        let masses = (real(2.0) + q[0].sin()) * v[0] * v[0] + (real(0.2) * t).exp() * v[1] * v[1];
        masses * real(0.5) + real(self.b) * q[0] * v[1] - real(self.k / 2.0) * off * off
    }
    fn force(&self, _q: &[f64], v: &[f64], _t: f64) -> Vec<f64> {
        vec![-self.gamma * (v[0] + 0.03 * v[0].powi(3) - v[1])]
    }
}

/// A mass matrix that is not diagonal, and a size that the run knows.
#[lagrangian(
    coordinates(q[n]),
    lagrangian = sum(0..n, |j| dot(q[j]).powi(2)) / 2.0 + 0.3 * sum(1..n, |j| dot(q[j]) * dot(q[j - 1]))
        - k * sum(0..n, |j| q[j].powi(2) / 2.0 + q[j].powi(4)),
)]
#[derive(Clone, Debug)]
pub struct Linked {
    /// How many there are.
    pub n: usize,
    /// Stiffness.
    pub k: f64,
}

impl Formula for Linked {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let real = convert::<f64, T>;
        (0..self.n).fold(real(0.0), |sum, j| {
            let linked = if j == 0 { real(0.0) } else { real(0.3) * v[j] * v[j - 1] };
            let square = q[j] * q[j];
            sum + v[j] * v[j] * real(0.5) + linked - real(self.k) * (square * real(0.5) + square * square)
        })
    }
}

/// Arrays, a mass that depends on the position, and forces that depend on all there is.
#[lagrangian(
    coordinates(u, z[2]),
    lagrangian = (1.0 + u * u / 2.0) * dot(u).powi(2) / 2.0 + sum(0..2, |i| dot(z[i]).powi(2) / 2.0)
        - u.powi(4) / 4.0 - sum(0..2, |i| (z[i] - u).powi(2) / 2.0),
    force(z) = |i| 0.3 * t.cos() - 0.2 * dot(z[i]) * (1.0 + dot(z[(i + 1) % 2]).powi(2)) - 0.1 * drag[i] * dot(u),
    force(u) = -0.4 * dot(u) * (1.0 + z[0] * z[1]),
)]
#[derive(Clone, Copy, Debug)]
pub struct Pulled {
    /// Of the velocity of the first.
    pub drag: [f64; 2],
}

impl Formula for Pulled {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let ([u, a, b], half) = ([q[0], q[1], q[2]], real::<T>(0.5));
        let kinetic = (real::<T>(1.0) + u * u * half) * v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        (kinetic - (a - u) * (a - u) - (b - u) * (b - u)) * half - u * u * u * u * real(0.25)
    }
    fn force(&self, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
        let ([_, a, b], [u, s, w]) = ([q[0], q[1], q[2]], [v[0], v[1], v[2]]);
        let common = 0.3 * t.cos();
        vec![
            -0.4 * u * (1.0 + a * b),
            common - 0.2 * s * (1.0 + w * w) - 0.1 * self.drag[0] * u,
            common - 0.2 * w * (1.0 + s * s) - 0.1 * self.drag[1] * u,
        ]
    }
}

/// A force that is no gradient and no function of velocities, on a system whose step is explicit.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + 2.0 * dot(y).powi(2)) / 2.0 - x.powi(2) / 2.0 - y.powi(4) / 4.0,
    force = [-swirl * y * t.cos(), swirl * x],
)]
#[derive(Clone, Copy, Debug)]
pub struct Swirl {
    /// Strength.
    pub swirl: f64,
}

impl Formula for Swirl {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let square = q[1] * q[1];
        (v[0] * v[0] - q[0] * q[0]) * real(0.5) + v[1] * v[1] - square * square * real(0.25)
    }
    fn force(&self, q: &[f64], _v: &[f64], t: f64) -> Vec<f64> {
        vec![-self.swirl * q[1] * t.cos(), self.swirl * q[0]]
    }
}

/// What [`fuse`](super::fuse) says of each of these: potentials and Hamiltonians in which it stands.
macro_rules! fused {
    ($(#[$doc:meta] $attribute:ident $name:ident($($argument:tt)*))+) => {$(
        #[$doc]
        #[$attribute($($argument)*, functions(fuse = [fuse::value, fuse::slope, fuse::curvature]))]
        #[derive(Clone, Debug)]
        pub struct $name;
    )+};
}

fused! {
    /// In class, with a form that is affine in no coordinate of its second half.
    degenerate_lagrangian FusedForm(
        coordinates(x, y),
        one_form = (y + y.powi(3) / 6.0 + x * y / 8.0) * d(x),
        hamiltonian = (x * x + y * y) / 2.0 + fuse(x).powi(4) / 4.0
    )
    /// An affine form.
    degenerate_lagrangian FusedFlow(
        coordinates(x, y),
        one_form = (x * d(y) - y * d(x)) / 2.0,
        hamiltonian = (x * x + y * y) / 2.0 + fuse(x).powi(4) / 4.0
    )
    /// L = ½ v·M v − V(q).
    lagrangian FusedSeparable(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + 2.0 * dot(y).powi(2)) / 2.0 - x * x / 2.0 - (fuse(x) - y).powi(4) / 4.0
    )
    /// A mass that depends on the place.
    lagrangian FusedMass(
        coordinates(x, y),
        lagrangian = (1.0 + 0.3 * x * x) * dot(x).powi(2) / 2.0 + dot(y).powi(2) + 0.2 * x * dot(y)
            - x * x / 2.0 - (fuse(x) - y).powi(4) / 4.0
    )
    /// A mass on a rod.
    lagrangian FusedRod(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - fuse(y) + x.powi(4) / 4.0,
        constraint = x * x + y * y - 1.0
    )
    /// A ball above the floor.
    lagrangian FusedBall(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y - fuse(x).powi(4) / 4.0,
        impact = y - 0.1 * x
    )
    /// A body in a field.
    lagrangian FusedBody(
        coordinates(R: SO3),
        lagrangian = (omega(R)[0].powi(2) + 2.0 * omega(R)[1].powi(2) + 3.0 * omega(R)[2].powi(2)) / 2.0
            - fuse(R[2][2]) - 0.4 * R[2][0]
    )
}
