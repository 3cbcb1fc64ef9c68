//! Systems that laws are asked of, beside those of the [zoo](crate::zoo).

use dvi_core::prelude::*;
pub use dvi_examples::models::{
    RadialFriction as Damped, RadialFrictionState as DampedState, RadialFrictionStateOf as DampedStateOf,
};
use nalgebra::{RealField, convert};

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
