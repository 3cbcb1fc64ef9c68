//! Rotations and unit vectors as coordinates.

// Rotations are called R.
#![allow(non_snake_case)]

use dvi_core::prelude::*;
use dvi_core::rotations;

/// A rigid body with principal moments of inertia, in a field along the third axis of space that pulls at a
/// point of the body.
#[lagrangian(
    coordinates(R: SO3),
    lagrangian = (inertia[0] * omega(R)[0].powi(2) + inertia[1] * omega(R)[1].powi(2) + inertia[2] * omega(R)[2].powi(2)) / 2.0
        - weight * (R[2][0] * tip[0] + R[2][1] * tip[1] + R[2][2] * tip[2]),
)]
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Principal moments of inertia.
    pub inertia: [f64; 3],
    /// The point that the field pulls at.
    pub tip: [f64; 3],
    /// Strength of the field.
    pub weight: f64,
}

/// A body that nothing pulls at.
pub const FREE: Body = Body { inertia: [1.0, 2.0, 3.5], tip: [0.0; 3], weight: 0.0 };
/// A body without symmetry in a field.
pub const UNEVEN: Body = Body { inertia: [1.0, 2.0, 2.4], tip: [0.3, -0.2, 0.5], weight: 1.5 };

/// A body with a mass at its point a, on a spring at its centre x, from which a rod leads to another mass at
/// x + ℓ s. A spring between the rod and the first axis of the body turns both.
#[lagrangian(
    coordinates(R: SO3, s: S2, x[3]),
    lagrangian = {
        let inside = (1.0 * omega(R)[0].powi(2) + 1.4 * omega(R)[1].powi(2) + 1.8 * omega(R)[2].powi(2)) / 2.0;
        let a0 = omega(R)[1] * a[2] - omega(R)[2] * a[1];
        let a1 = omega(R)[2] * a[0] - omega(R)[0] * a[2];
        let a2 = omega(R)[0] * a[1] - omega(R)[1] * a[0];
        let v0 = dot(x[0]) + R[0][0] * a0 + R[0][1] * a1 + R[0][2] * a2;
        let v1 = dot(x[1]) + R[1][0] * a0 + R[1][1] * a1 + R[1][2] * a2;
        let v2 = dot(x[2]) + R[2][0] * a0 + R[2][1] * a1 + R[2][2] * a2;
        let rod = sum(0..3, |i| (dot(x[i]) + length * dot(s[i])).powi(2)) / 2.0;
        let spring = sum(0..3, |i| x[i].powi(2));
        let coupling = s[0] * R[0][0] + s[1] * R[1][0] + s[2] * R[2][0];
        inside + (v0 * v0 + v1 * v1 + v2 * v2) / 2.0 + rod - spring - 0.8 * coupling - gravity * x[2]
    },
)]
#[derive(Clone, Copy, Debug)]
pub struct Coupled {
    /// Where the mass on the body is.
    pub a: [f64; 3],
    /// Length of the rod.
    pub length: f64,
    /// Acceleration of gravity.
    pub gravity: f64,
}

/// A coupled system with numbers.
pub const COUPLED: Coupled = Coupled { a: [0.3, 0.5, -0.2], length: 0.7, gravity: 0.4 };

/// The same in numbers and constraints: the kinetic energy of the body is ½ tr(Ṙ J Ṙᵀ), Jₖ = ½ tr 𝕀 − Iₖ.
#[lagrangian(
    coordinates(r[9], s[3], x[3]),
    lagrangian = {
        let inside = sum(0..3, |i| 1.1 * dot(r[3 * i]).powi(2) + 0.7 * dot(r[3 * i + 1]).powi(2) + 0.3 * dot(r[3 * i + 2]).powi(2)) / 2.0;
        let mass = sum(0..3, |i| (dot(x[i]) + dot(r[3 * i]) * a[0] + dot(r[3 * i + 1]) * a[1] + dot(r[3 * i + 2]) * a[2]).powi(2)) / 2.0;
        let rod = sum(0..3, |i| (dot(x[i]) + length * dot(s[i])).powi(2)) / 2.0;
        let spring = sum(0..3, |i| x[i].powi(2));
        let coupling = s[0] * r[0] + s[1] * r[3] + s[2] * r[6];
        inside + mass + rod - spring - 0.8 * coupling - gravity * x[2]
    },
    constraint(j in 0..3) = sum(0..3, |i| r[3 * i + j].powi(2)) - 1.0,
    constraint = [
        sum(0..3, |i| r[3 * i] * r[3 * i + 1]),
        sum(0..3, |i| r[3 * i] * r[3 * i + 2]),
        sum(0..3, |i| r[3 * i + 1] * r[3 * i + 2]),
        sum(0..3, |i| s[i].powi(2)) - 1.0,
    ],
)]
#[derive(Clone, Copy, Debug)]
pub struct ByConstraints {
    /// Where the mass on the body is.
    pub a: [f64; 3],
    /// Length of the rod.
    pub length: f64,
    /// Acceleration of gravity.
    pub gravity: f64,
}

/// A body and a mass on a sphere beside a number, as L = ½ v·M v − V(q, t) if `mixed` stands in front of
/// nothing else.
macro_rules! beside {
    ($name:ident, $mixed:expr) => {
        #[lagrangian(
            coordinates(R: SO3, s: S2, x),
            lagrangian = (inertia[0] * omega(R)[0].powi(2) + inertia[1] * omega(R)[1].powi(2)
                    + inertia[2] * omega(R)[2].powi(2)) / 2.0 + sum(0..3, |i| dot(s[i]).powi(2))
                + dot(x).powi(2) + coupling * (0.3 * omega(R)[0] * omega(R)[2] + 0.4 * dot(x) * omega(R)[1])
                - s[0] * R[0][2] - s[1] * R[1][2] - 0.7 * s[2] - x * x * (1.0 + R[2][0]) - t.cos() * R[1][1]
                + $mixed,
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            /// Moments of inertia.
            pub inertia: [f64; 3],
            /// How much the mass matrix couples.
            pub coupling: f64,
            /// Zero.
            pub zero: f64,
        }
    };
}

beside!(Separable, zero * x);
beside!(NotSeparable, zero * omega(R)[0] * R[0][0]);

/// A state of the coupled system in which everything moves.
pub fn coupled() -> CoupledState {
    CoupledState {
        R: rotations::exp([0.4, -0.3, 0.2]),
        s: [0.48, -0.6, 0.64],
        x: [0.1, 0.2, -0.1],
        omega_R: [0.5, -0.8, 0.9],
        dot_s: [0.8, 0.64, 0.0],
        dot_x: [0.3, -0.2, 0.1],
    }
}

/// a × b
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a·b
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
