//! Bodies that turn about a point: a heavy symmetric top, and a free body.

use dvi_core::prelude::*;
use dvi_core::rotations;

use super::{Heights, OnManifold};

/// The top of Lagrange: symmetric about the third axis of the body, on which its centre of mass lies, in
/// gravity along the third axis of space. It turns about the point on which it stands.
#[lagrangian(
    coordinates(R: SO3),
    lagrangian = (across * (omega(R)[0].powi(2) + omega(R)[1].powi(2)) + along * omega(R)[2].powi(2)) / 2.0 - weight * R[2][2],
    momenta(
        spin = along * omega(R)[2],
        vertical = across * (R[2][0] * omega(R)[0] + R[2][1] * omega(R)[1]) + along * R[2][2] * omega(R)[2],
    ),
)]
#[derive(Clone, Copy, Debug)]
pub struct Top {
    /// The moment of inertia across the axis, A.
    pub across: f64,
    /// The moment of inertia along the axis, C.
    pub along: f64,
    /// The weight times the distance of the centre of mass from the point of support.
    pub weight: f64,
}

/// A body without forces, by the axes of its moments of inertia.
#[lagrangian(
    coordinates(R: SO3),
    lagrangian = inertia.dot([omega(R)[0].powi(2), omega(R)[1].powi(2), omega(R)[2].powi(2)]) / 2.0,
    momenta(
        x = R[0][0] * inertia[0] * omega(R)[0] + R[0][1] * inertia[1] * omega(R)[1] + R[0][2] * inertia[2] * omega(R)[2],
        y = R[1][0] * inertia[0] * omega(R)[0] + R[1][1] * inertia[1] * omega(R)[1] + R[1][2] * inertia[2] * omega(R)[2],
        z = R[2][0] * inertia[0] * omega(R)[0] + R[2][1] * inertia[1] * omega(R)[1] + R[2][2] * inertia[2] * omega(R)[2],
    ),
)]
#[derive(Clone, Copy, Debug)]
pub struct RigidBody {
    pub inertia: [f64; 3],
}

impl Top {
    /// With its axis at the angle θ from the vertical: the rates of θ and of the precession φ, and ω along
    /// the axis.
    pub fn leaning(theta: f64, [dot_theta, dot_phi, spinning]: [f64; 3]) -> TopState {
        TopState {
            R: rotations::exp([theta, 0.0, 0.0]),
            omega_R: [dot_theta, dot_phi * theta.sin(), spinning],
        }
    }

    /// What the height of the axis depends on.
    pub fn heights(&self, state: &TopState) -> Heights {
        let Self { across, along, weight } = *self;
        let velocities = velocities(state.omega_R);
        let [spin, vertical] = [0, 1].map(|k| self.momentum(k, &state.R, &velocities, 0.0));
        let energy = self.energy(&state.R, &velocities, 0.0) - spin * spin / (2.0 * along);
        Heights { across, weight, energy, spin, vertical }
    }

    /// g in E − h²g, which steps of length h by `Geodesic::trapezoid` keep up to terms of the order h⁴.
    ///
    /// In a step the action of L along the geodesic exceeds that of the motion by (h³/24) ω̇·𝕀ω̇, for the
    /// motion departs from the geodesic as a path of constant acceleration from a straight line, and has the
    /// least action. The trapezoidal rule adds to it −(h³/12) V̈ with the second derivative along the
    /// geodesic. What a Lagrangian gains, the energy loses.
    pub fn shift(&self, state: &TopState) -> f64 {
        let ([.., x, y, u], [a, b, c]) = (state.R, state.omega_R);
        let bent = c * (x * a + y * b + u * c) - u * (a * a + b * b + c * c);
        let inertia = [self.across, self.across, self.along];
        accelerated(inertia, self.acceleration([x, y, u], state.omega_R)) / 24.0 - self.weight * bent / 12.0
    }

    /// ω̇, with the direction of the vertical in the body.
    fn acceleration(&self, above: [f64; 3], omega: [f64; 3]) -> [f64; 3] {
        let torque = [self.weight * above[1], -self.weight * above[0], 0.0];
        euler([self.across, self.across, self.along], omega, torque)
    }
}

impl RigidBody {
    /// With the axes of space as those of its moments.
    pub fn turning(omega: [f64; 3]) -> RigidBodyState {
        RigidBodyState { R: rotations::exp([0.0; 3]), omega_R: omega }
    }

    pub fn momentum_at(&self, state: &RigidBodyState) -> [f64; 3] {
        [0, 1, 2].map(|k| self.inertia[k] * state.omega_R[k])
    }

    pub fn acceleration(&self, omega: [f64; 3]) -> [f64; 3] {
        euler(self.inertia, omega, [0.0; 3])
    }

    /// g in E − h²g, which steps of length h by `Geodesic::trapezoid` keep up to terms of the order h⁴: see
    /// [`Top::shift`].
    pub fn shift(&self, state: &RigidBodyState) -> f64 {
        accelerated(self.inertia, self.acceleration(state.omega_R)) / 24.0
    }
}

/// R row by row, and ω: Ṙ = R ω̂ and 𝕀ω̇ = 𝕀ω × ω + torque.
impl OnManifold<12> for Top {
    fn motion(&self, y: &[f64; 12]) -> [f64; 12] {
        turning(y, |above, omega| self.acceleration(above, omega))
    }
}

/// R row by row, and ω.
impl OnManifold<12> for RigidBody {
    fn motion(&self, y: &[f64; 12]) -> [f64; 12] {
        turning(y, |_, omega| self.acceleration(omega))
    }
}

/// A rotation has as many velocities as entries, of which the first three are ω.
pub fn velocities([x, y, z]: [f64; 3]) -> [f64; 9] {
    [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// ω̇ = 𝕀⁻¹(𝕀ω × ω + torque)
fn euler(inertia: [f64; 3], omega: [f64; 3], torque: [f64; 3]) -> [f64; 3] {
    let gyroscopic = cross([0, 1, 2].map(|k| inertia[k] * omega[k]), omega);
    [0, 1, 2].map(|k| (gyroscopic[k] + torque[k]) / inertia[k])
}

/// ω̇·𝕀ω̇
fn accelerated(inertia: [f64; 3], acceleration: [f64; 3]) -> f64 {
    inertia.into_iter().zip(acceleration).map(|(moment, rate)| moment * rate * rate).sum()
}

/// The rates of R, row by row, and of ω, by the direction of the vertical in the body: the rows of R ω̂ are
/// those of R times ω.
fn turning(y: &[f64; 12], acceleration: impl Fn([f64; 3], [f64; 3]) -> [f64; 3]) -> [f64; 12] {
    let [x, y, above, omega] = [0, 3, 6, 9].map(|i: usize| [y[i], y[i + 1], y[i + 2]]);
    let [a, b, c] = [x, y, above].map(|row| cross(row, omega));
    let d = acceleration(above, omega);
    [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]]
}
