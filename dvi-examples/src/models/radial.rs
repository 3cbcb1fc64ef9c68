//! A particle in the plane in a potential that depends on the radius: on a spring, and with friction.

use dvi_core::prelude::*;

/// A particle of unit mass in the plane in V(r) = r²/2 + r⁴/4.
#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let r2 = x * x + y * y;
        (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - r2 / 2.0 - r2.powi(2) / 4.0
    },
    momenta(angular = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy, Debug)]
pub struct StiffeningSpring {}

/// A particle of unit mass in the plane in V(r) = r²(r² − 1)², with linear friction.
#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let r2 = x * x + y * y;
        (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - r2 * (r2 - 1.0).powi(2)
    },
    force = [-gamma * dot(x), -gamma * dot(y)],
    momenta(angular = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Debug)]
pub struct RadialFriction {
    /// Friction over mass.
    pub gamma: f64,
}

impl RadialFriction {
    /// V'(r)/r, so that ∇V is this times the place.
    pub fn slope(&self, &[x, y]: &[f64; 2]) -> f64 {
        let r2 = x * x + y * y;
        2.0 * (r2 - 1.0) * (3.0 * r2 - 1.0)
    }
}
