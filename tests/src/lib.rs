//! Systems shared by the tests.

pub mod systems;
pub mod zoo;

/// The vortex configurations of the literature.
pub mod configurations {
    use crate::systems::{PointVortices, PointVorticesState};

    /// Two leapfrogging pairs.
    pub fn leapfrogging() -> (PointVortices<4>, PointVorticesState<4>) {
        let state = PointVorticesState { x: [-1.0, 1.0, -1.0, 1.0], y: [2.0, 2.0, -2.0, -2.0] };
        (PointVortices { gamma: [1.0, 1.0, -1.0, -1.0] }, state)
    }

    /// Four equal vortices, quasi-periodic.
    pub fn quasi_periodic() -> (PointVortices<4>, PointVorticesState<4>) {
        let state = PointVorticesState { x: [1.0, 0.866, -0.85, -0.5], y: [1.0, 0.45, -1.363_636, -0.15] };
        (PointVortices { gamma: [1.0; 4] }, state)
    }

    /// Four equal vortices, chaotic.
    pub fn chaotic() -> (PointVortices<4>, PointVorticesState<4>) {
        let state = PointVorticesState { x: [-1.85, -0.07, 0.78, 0.76], y: [0.05, -1.332, 0.167, -1.2902] };
        (PointVortices { gamma: [1.0; 4] }, state)
    }
}

/// Oracles that do not use the integrators.
pub mod oracle {
    use dvi_core::{Lagrangian, Real};

    /// L_d(q0, q1) = h L(q_σ, (q1 − q0)/h, t + σh).
    pub fn discrete_lagrangian<S: Lagrangian, T: Real>(
        system: &S,
        sigma: f64,
        t: f64,
        h: f64,
        q0: &[T],
        q1: &[T],
    ) -> T {
        let (b, b_bar, step) = (T::lift(1.0 - sigma), T::lift(sigma), T::lift(h));
        let point: Vec<T> = q0.iter().zip(q1).map(|(&q0, &q1)| b * q0 + b_bar * q1).collect();
        let velocity: Vec<T> = q0.iter().zip(q1).map(|(&q0, &q1)| (q1 - q0) / step).collect();
        step * system.lagrangian(&point, &velocity, T::lift(t + sigma * h))
    }
}

/// The README's example runs.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
