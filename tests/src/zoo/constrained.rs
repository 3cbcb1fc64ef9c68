//! Systems with constraints, and the same systems in coordinates that need none.

use dvi_core::prelude::*;

/// A mass on a rod.
#[lagrangian(
    coordinates(x, y),
    lagrangian = m * (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - m * g * y,
    constraint = x * x + y * y - length * length,
)]
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    /// Mass, or masses.
    pub m: f64,
    /// Acceleration of gravity.
    pub g: f64,
    /// Length of the rod.
    pub length: f64,
}

/// Two masses, the first on a rod and the second on a rod at the first.
#[lagrangian(
    coordinates(x[2], y[2]),
    lagrangian = sum(0..2, |i| m[i] * ((dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i])),
    constraint = [
        x[0].powi(2) + y[0].powi(2) - 1.0,
        ((x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2)).sqrt() - rod,
    ],
)]
#[derive(Clone, Copy, Debug)]
pub struct Double {
    /// Mass, or masses.
    pub m: [f64; 2],
    /// Length of a rod, or of all.
    pub rod: f64,
}

/// The same in the angles of the rods.
#[lagrangian(
    coordinates(a, b),
    lagrangian = m[0] * dot(a).powi(2) / 2.0
        + m[1] * (dot(a).powi(2) + (rod * dot(b)).powi(2) + 2.0 * rod * dot(a) * dot(b) * (a - b).cos()) / 2.0
        + (m[0] + m[1]) * a.cos() + m[1] * rod * b.cos(),
)]
#[derive(Clone, Copy, Debug)]
pub struct DoubleAngles {
    /// Mass, or masses.
    pub m: [f64; 2],
    /// Length of a rod, or of all.
    pub rod: f64,
}

impl DoubleAngles {
    /// Where the masses are.
    pub fn masses(&self, state: &DoubleAnglesState) -> DoubleState {
        let DoubleAnglesState { a, b, dot_a, dot_b } = *state;
        let Self { rod, .. } = *self;
        DoubleState {
            x: [a.sin(), a.sin() + rod * b.sin()],
            y: [-a.cos(), -a.cos() - rod * b.cos()],
            dot_x: [dot_a * a.cos(), dot_a * a.cos() + rod * dot_b * b.cos()],
            dot_y: [dot_a * a.sin(), dot_a * a.sin() + rod * dot_b * b.sin()],
        }
    }
}

/// A pendulum with friction whose pivot is moved.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
    force(x) = -gamma * dot(x),
    force(y) = -gamma * dot(y),
    constraint = ((x - 0.3 * (2.0 * t).sin()).powi(2) + y * y - 1.0) * (2.0 + t.cos()),
)]
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// Friction.
    pub gamma: f64,
}

/// The same by the angle.
#[lagrangian(
    coordinates(a),
    lagrangian = ((dot(a) * a.cos() + 0.6 * (2.0 * t).cos()).powi(2) + (dot(a) * a.sin()).powi(2)) / 2.0 + a.cos(),
    force(a) = -gamma * (dot(a) + 0.6 * (2.0 * t).cos() * a.cos()),
)]
#[derive(Clone, Copy, Debug)]
pub struct SwingAngle {
    /// Friction.
    pub gamma: f64,
}

/// Where the mass of a swing is at time `t`.
pub fn swinging(state: &SwingAngleState, t: f64) -> SwingState {
    let SwingAngleState { a, dot_a } = *state;
    SwingState {
        x: 0.3 * (2.0 * t).sin() + a.sin(),
        y: -a.cos(),
        dot_x: 0.6 * (2.0 * t).cos() + dot_a * a.cos(),
        dot_y: dot_a * a.sin(),
    }
}

/// A relativistic bead on a ring, with a mass that depends on where it is: p is no affine function of v.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -(2.0 + x) * (1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() - y,
    constraint = x * x + 2.0 * y * y - 1.0,
)]
#[derive(Clone, Copy, Debug)]
pub struct Bead;

/// A charge on a sphere in a magnetic field along z: L has terms linear in v, and is symmetric about z.
#[lagrangian(
    coordinates(r[3]),
    lagrangian = sum(0..3, |i| dot(r[i]).powi(2) / 2.0) + b * (r[0] * dot(r[1]) - r[1] * dot(r[0])) / 2.0 - r[2],
    constraint = sum(0..3, |i| r[i] * r[i]) - 1.0,
    momenta(axial = r[0] * dot(r[1]) - r[1] * dot(r[0]) + b * (r[0] * r[0] + r[1] * r[1]) / 2.0),
)]
#[derive(Clone, Copy, Debug)]
pub struct Charge {
    /// Magnetic field.
    pub b: f64,
}

/// The same without the field: separable.
#[lagrangian(
    coordinates(r[3]),
    lagrangian = sum(0..3, |i| dot(r[i]).powi(2) / 2.0) - r[2],
    constraint = sum(0..3, |i| r[i] * r[i]) - 1.0,
    momenta(axial = r[0] * dot(r[1]) - r[1] * dot(r[0])),
)]
#[derive(Clone, Copy, Debug)]
pub struct Spherical;

/// Masses on rods, one below the other, and as many as there are.
#[lagrangian(
    coordinates(x[rod.len()], y[rod.len()]),
    lagrangian = sum(0..rod.len(), |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]),
    constraint = x[0] * x[0] + y[0] * y[0] - rod[0] * rod[0],
    constraint(i in 1..rod.len()) = (x[i] - x[i - 1]).powi(2) + (y[i] - y[i - 1]).powi(2) - rod[i] * rod[i],
)]
#[derive(Clone, Debug)]
pub struct Links {
    /// Length of a rod, or of all.
    pub rod: Vec<f64>,
}

impl Links {
    /// With rods of these lengths, stretched out to one side.
    pub fn stretched(rod: Vec<f64>) -> (Self, LinksState) {
        let rest = vec![0.0; rod.len()];
        let ends = rod.iter().scan(0.0, |end, rod| {
            *end += rod;
            Some(*end)
        });
        let x = ends.collect();
        (Self { rod }, LinksState { x, y: rest.clone(), dot_x: rest.clone(), dot_y: rest })
    }
}

/// Masses on rods in a plane, two below each.
#[lagrangian(
    coordinates(x[2 * half + 1], y[2 * half + 1]),
    lagrangian = sum(0..2 * half + 1, |j| (dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0 - y[j]),
    constraint = x[0] * x[0] + y[0] * y[0] - 1.0,
    constraint(j in 0..half) = (x[2 * j + 1] - x[j]).powi(2) + (y[2 * j + 1] - y[j]).powi(2) - 1.0,
    constraint(j in 0..half) = (x[2 * j + 2] - x[j]).powi(2) + (y[2 * j + 2] - y[j]).powi(2) - 1.0,
)]
#[derive(Clone, Copy, Debug)]
pub struct Mobile {
    /// How many have two below them.
    pub half: usize,
}

impl Mobile {
    /// Each at rest to one side of the one above.
    pub fn at_rest(&self) -> MobileState {
        let n = 2 * self.half + 1;
        let side = |j: usize| if j % 2 == 1 { -0.6 } else { 0.6 };
        let (mut x, mut y) = (vec![0.6; n], vec![-0.8; n]);
        for j in 1..n {
            let above = (j - 1) / 2;
            (x[j], y[j]) = (x[above] + side(j), y[above] - 0.8);
        }
        MobileState { x, y, dot_x: vec![0.0; n], dot_y: vec![0.0; n] }
    }
}
