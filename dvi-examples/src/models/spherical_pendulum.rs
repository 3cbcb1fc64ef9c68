//! A mass on a sphere, by a unit vector and by a constraint.

use dvi_core::prelude::*;

use super::{Heights, OnManifold};

/// A mass of 1 on a rod of length 1, as a unit vector, in gravity along the third axis.
#[lagrangian(
    coordinates(s: S2),
    lagrangian = (dot(s[0]).powi(2) + dot(s[1]).powi(2) + dot(s[2]).powi(2)) / 2.0 - gravity * s[2],
    momenta(vertical = s[0] * dot(s[1]) - s[1] * dot(s[0])),
)]
#[derive(Clone, Copy, Debug)]
pub struct SphericalPendulum {
    /// g
    pub gravity: f64,
}

/// The same in the coordinates of space, with the rod as an equation.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - gravity * z,
    constraint = x * x + y * y + z * z - 1.0,
    momenta(vertical = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy, Debug)]
pub struct ConstrainedPendulum {
    /// g
    pub gravity: f64,
}

impl SphericalPendulum {
    /// At the angle θ from the direction downwards, with the rate of θ and that of the angle about the
    /// vertical.
    pub fn hanging(theta: f64, [dot_theta, dot_phi]: [f64; 2]) -> SphericalPendulumState {
        let (sine, cosine) = theta.sin_cos();
        SphericalPendulumState {
            s: [sine, 0.0, -cosine],
            dot_s: [dot_theta * cosine, dot_phi * sine, dot_theta * sine],
        }
    }

    /// What the height depends on.
    pub fn heights(&self, SphericalPendulumState { s, dot_s }: &SphericalPendulumState) -> Heights {
        Heights {
            across: 1.0,
            weight: self.gravity,
            energy: squared(dot_s) / 2.0 + self.gravity * s[2],
            spin: 0.0,
            vertical: s[0] * dot_s[1] - s[1] * dot_s[0],
        }
    }

    /// g in E − h²g, which steps of length h by `Geodesic::trapezoid` keep up to terms of the order h⁴:
    /// (1/24)|a|² − (1/12) V̈ with the acceleration a along the sphere and the second derivative of V along
    /// the great circle. [`Top::shift`](super::Top::shift) says why.
    pub fn shift(&self, SphericalPendulumState { s, dot_s }: &SphericalPendulumState) -> f64 {
        let along = self.gravity * self.gravity * (1.0 - s[2] * s[2]);
        along / 24.0 + self.gravity * s[2] * squared(dot_s) / 12.0
    }
}

/// s and ṡ.
impl OnManifold<6> for SphericalPendulum {
    fn entries(SphericalPendulumState { s, dot_s }: &SphericalPendulumState) -> [f64; 6] {
        [s[0], s[1], s[2], dot_s[0], dot_s[1], dot_s[2]]
    }

    fn state(&[x, y, z, u, v, w]: &[f64; 6]) -> SphericalPendulumState {
        SphericalPendulumState { s: [x, y, z], dot_s: [u, v, w] }
    }

    /// s̈ = −g e₃ − (|ṡ|² − g s₃) s
    fn motion(&self, &[x, y, z, u, v, w]: &[f64; 6]) -> [f64; 6] {
        let tension = u * u + v * v + w * w - self.gravity * z;
        [u, v, w, -tension * x, -tension * y, -self.gravity - tension * z]
    }
}

impl ConstrainedPendulum {
    /// The state of a pendulum of unit vectors.
    pub fn state_of(state: &SphericalPendulumState) -> ConstrainedPendulumState {
        let SphericalPendulumState { s: [x, y, z], dot_s: [dot_x, dot_y, dot_z] } = *state;
        ConstrainedPendulumState { x, y, z, dot_x, dot_y, dot_z }
    }

    /// The state as that of a pendulum of unit vectors.
    pub fn on_sphere(state: &ConstrainedPendulumState) -> SphericalPendulumState {
        let ConstrainedPendulumState { x, y, z, dot_x, dot_y, dot_z } = *state;
        SphericalPendulumState { s: [x, y, z], dot_s: [dot_x, dot_y, dot_z] }
    }

    /// The same as [`SphericalPendulum::shift`] for RATTLE: the kinetic energy of a step is that of the
    /// chord, which is shorter than the arc, chord² = θ² − θ⁴/12 + …, so that L of a step is less by
    /// h³|ṡ|⁴/24.
    pub fn shift(&self, state: &SphericalPendulumState) -> f64 {
        SphericalPendulum { gravity: self.gravity }.shift(state) - squared(&state.dot_s).powi(2) / 24.0
    }
}

fn squared(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}
