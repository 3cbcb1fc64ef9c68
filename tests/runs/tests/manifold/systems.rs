//! The systems, by declaration.

use dvi_core::prelude::*;

/// A rigid body with principal moments of inertia, in a field along the third axis of space that pulls at a point of the body.
#[lagrangian(
    coordinates(R: SO3),
    lagrangian = (inertia[0] * omega(R)[0].powi(2) + inertia[1] * omega(R)[1].powi(2) + inertia[2] * omega(R)[2].powi(2)) / 2.0
        - weight * (R[2][0] * tip[0] + R[2][1] * tip[1] + R[2][2] * tip[2]),
    momenta(
        x = R[0][0] * inertia[0] * omega(R)[0] + R[0][1] * inertia[1] * omega(R)[1] + R[0][2] * inertia[2] * omega(R)[2],
        y = R[1][0] * inertia[0] * omega(R)[0] + R[1][1] * inertia[1] * omega(R)[1] + R[1][2] * inertia[2] * omega(R)[2],
        z = R[2][0] * inertia[0] * omega(R)[0] + R[2][1] * inertia[1] * omega(R)[1] + R[2][2] * inertia[2] * omega(R)[2],
        spin = inertia[2] * omega(R)[2],
    ),
)]
#[derive(Clone, Copy)]
pub(crate) struct Body {
    pub(crate) inertia: [f64; 3],
    pub(crate) tip: [f64; 3],
    pub(crate) weight: f64,
}

pub(crate) const FREE: Body = Body { inertia: [1.0, 2.0, 3.5], tip: [0.0; 3], weight: 0.0 };
pub(crate) const TOP: Body = Body { inertia: [1.0, 1.0, 0.6], tip: [0.0, 0.0, 1.0], weight: 1.2 };
pub(crate) const UNEVEN: Body = Body { inertia: [1.0, 2.0, 2.4], tip: [0.3, -0.2, 0.5], weight: 1.5 };

/// A mass on a sphere, in gravity.
#[lagrangian(
    coordinates(s: S2),
    lagrangian = (dot(s[0]).powi(2) + dot(s[1]).powi(2) + dot(s[2]).powi(2)) / 2.0 - gravity * s[2],
    momenta(vertical = s[0] * dot(s[1]) - s[1] * dot(s[0])),
)]
#[derive(Clone, Copy)]
pub(crate) struct Pendulum {
    pub(crate) gravity: f64,
}

/// A body with a mass at its point a, on a spring at its centre x, from which a rod leads to another mass at x + ℓ s. A spring
/// between the rod and the first axis of the body turns both.
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
#[derive(Clone, Copy)]
pub(crate) struct Coupled {
    pub(crate) a: [f64; 3],
    pub(crate) length: f64,
    pub(crate) gravity: f64,
}

pub(crate) const COUPLED: Coupled = Coupled { a: [0.3, 0.5, -0.2], length: 0.7, gravity: 0.4 };

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
#[derive(Clone, Copy)]
pub(crate) struct ByConstraints {
    pub(crate) a: [f64; 3],
    pub(crate) length: f64,
    pub(crate) gravity: f64,
}

/// A body and a mass on a sphere beside a number, as L = ½ v·M v − V(q, t) if `mixed` stands in front of nothing else.
macro_rules! beside {
    ($name:ident, $mixed:expr) => {
        #[lagrangian(
            coordinates(R: SO3, s: S2, x),
            lagrangian = (omega(R)[0].powi(2) + 2.0 * omega(R)[1].powi(2) + 2.4 * omega(R)[2].powi(2)) / 2.0
                + 0.3 * omega(R)[0] * omega(R)[2] + sum(0..3, |i| dot(s[i]).powi(2)) + dot(x).powi(2) + 0.4 * dot(x) * omega(R)[1]
                - s[0] * R[0][2] - s[1] * R[1][2] - 0.7 * s[2] - x * x * (1.0 + R[2][0]) - t.cos() * R[1][1] + $mixed,
        )]
        #[derive(Clone, Copy)]
        pub(crate) struct $name {
            pub(crate) zero: f64,
        }
    };
}

beside!(Separable, zero * x);
beside!(NotSeparable, zero * omega(R)[0] * R[0][0]);
