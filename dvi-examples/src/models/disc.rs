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
    /// R
    pub radius: f64,
    /// k, along x and along y.
    pub stiffness: [f64; 2],
    /// B at the origin.
    pub field: [f64; 2],
    /// g
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
    /// a
    pub a: f64,
}

impl RollingDisc {
    /// In the direction φ at (x, y), with the rates of θ and φ.
    pub fn rolling(&self, [x, y]: [f64; 2], phi: f64, [dot_theta, dot_phi]: [f64; 2]) -> RollingDiscState {
        let speed = self.radius * dot_theta;
        let (dot_x, dot_y) = (speed * phi.cos(), speed * phi.sin());
        RollingDiscState { x, y, theta: 0.0, phi, dot_x, dot_y, dot_theta, dot_phi }
    }

    /// The rates of (x, y, θ, φ, θ', φ') in the motion, with the constraints eliminated:
    /// (3/2)R²θ″ = −R(cos φ ∂V/∂x + sin φ ∂V/∂y) and ¼R²φ″ = −∂V/∂φ.
    pub fn reduced(&self, &[x, y, _, phi, dot_theta, dot_phi]: &[f64; 6]) -> [f64; 6] {
        let (sin, cos) = phi.sin_cos();
        let along_x = self.stiffness[0] * x - self.gradient * sin;
        let along_y = self.stiffness[1] * y - self.gradient * cos;
        let torque = (self.field[1] + self.gradient * x) * cos - (self.field[0] + self.gradient * y) * sin;
        let speed = self.radius * dot_theta;
        [
            speed * cos,
            speed * sin,
            dot_theta,
            dot_phi,
            -(cos * along_x + sin * along_y) / (1.5 * self.radius),
            4.0 * torque / self.radius.powi(2),
        ]
    }

    /// The energy of (x, y, θ, φ, θ', φ').
    pub fn energy_of(&self, &[x, y, _, phi, dot_theta, dot_phi]: &[f64; 6]) -> Result<f64, StartError> {
        self.energy_at(&self.rolling([x, y], phi, [dot_theta, dot_phi]))
    }
}

impl RollingDiscState {
    /// (x, y, θ, φ, θ', φ')
    pub fn reduced(&self) -> [f64; 6] {
        [self.x, self.y, self.theta, self.phi, self.dot_theta, self.dot_phi]
    }
}

impl ChaplyginSleigh {
    /// The rates of (x, y, θ, v, ω) in the motion, with the constraint eliminated: v' = aω² and (I + a²)ω' =
    /// −avω.
    pub fn reduced(&self, &[_, _, theta, v, omega]: &[f64; 5]) -> [f64; 5] {
        let rate = -self.a * v * omega / (self.inertia + self.a * self.a);
        [v * theta.cos(), v * theta.sin(), omega, self.a * omega * omega, rate]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISC: RollingDisc =
        RollingDisc { radius: 0.7, stiffness: [1.0, 1.7], field: [0.3, 0.1], gradient: 0.3 };

    #[test]
    fn the_equations_by_hand_are_those_of_the_constraints() {
        let state = DISC.rolling([0.4, -0.3], 1.1, [0.9, -0.6]);
        let rates = DISC.vector_field(&state).expect("rates");
        let by_hand = DISC.reduced(&state.reduced());
        for (a, b) in by_hand.into_iter().zip(rates.reduced()) {
            assert!((a - b).abs() < 1e-14, "{by_hand:?} {rates:?}");
        }
        let (sleigh, theta, v, omega) = (ChaplyginSleigh { inertia: 1.0, a: 0.5 }, 0.8_f64, -1.2, 0.7);
        let (dot_x, dot_y) = (v * theta.cos(), v * theta.sin());
        let state = ChaplyginSleighState { x: 0.0, y: 0.0, theta, dot_x, dot_y, dot_theta: omega };
        let rates = sleigh.vector_field(&state).expect("rates");
        let by_hand = sleigh.reduced(&[0.0, 0.0, theta, v, omega]);
        let along = rates.dot_x * theta.cos() + rates.dot_y * theta.sin();
        assert!((along - by_hand[3]).abs() < 1e-14 && (rates.dot_theta - by_hand[4]).abs() < 1e-14);
    }
}
