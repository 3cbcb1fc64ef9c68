//! Rolling without slipping: a disc that stands upright on a plane, and a sleigh on a blade.

use dvi_core::prelude::*;

/// A uniform disc of mass 1 that rolls upright on a plane (Bloch 2015, section 1.4). It touches the plane at
/// (x, y), has rolled by the angle θ, and rolls in the direction φ. It is in the potential ½(k₀x² + k₁y²) −
/// (B₀ + gy) cos φ − (B₁ + gx) sin φ: that of springs to the origin, and that of a magnet of moment 1 along
/// the direction of rolling, in a field with the gradient g.
#[lagrangian(
    coordinates(x, y, theta, phi),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
        + radius.powi(2) * (dot(theta).powi(2) / 4.0 + dot(phi).powi(2) / 8.0)
        - (stiffness[0] * x * x + stiffness[1] * y * y) / 2.0
        + (field[0] + gradient * y) * phi.cos() + (field[1] + gradient * x) * phi.sin(),
    nonholonomic = [dot(x) - radius * phi.cos() * dot(theta), dot(y) - radius * phi.sin() * dot(theta)],
    momenta(
        rolling = radius * (phi.cos() * dot(x) + phi.sin() * dot(y)) + radius.powi(2) / 2.0 * dot(theta),
        turning = radius.powi(2) / 4.0 * dot(phi),
    ),
)]
#[derive(Clone, Debug)]
pub struct RollingDisc {
    pub radius: f64,
    /// k, along x and along y.
    pub stiffness: [f64; 2],
    /// B at the origin.
    pub field: [f64; 2],
    pub gradient: f64,
}

/// A body of mass 1 on a blade at (x, y), which does not slip to the side, and on points that slide. It
/// points in the direction θ, and its centre of mass is at the distance a in front of the blade (Chaplygin
/// 1911; Bloch 2015, section 1.7).
#[lagrangian(
    coordinates(x, y, theta),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + (inertia + a * a) * dot(theta).powi(2)) / 2.0
        + a * dot(theta) * (dot(y) * theta.cos() - dot(x) * theta.sin()),
    nonholonomic = dot(x) * theta.sin() - dot(y) * theta.cos(),
)]
#[derive(Clone, Debug)]
pub struct ChaplyginSleigh {
    /// The moment of inertia about the centre of mass.
    pub inertia: f64,
    pub a: f64,
}

impl RollingDisc {
    /// In the direction φ at (x, y), with the rates of θ and φ.
    pub fn rolling(&self, [x, y]: [f64; 2], phi: f64, [dot_theta, dot_phi]: [f64; 2]) -> RollingDiscState {
        let speed = self.radius * dot_theta;
        let (dot_x, dot_y) = (speed * phi.cos(), speed * phi.sin());
        RollingDiscState { x, y, theta: 0.0, phi, dot_x, dot_y, dot_theta, dot_phi }
    }
}
