//! What tops and spherical pendulums have in common, heights between which they go up and down, and states
//! on a manifold; and a mass on a sphere, by a unit vector and by a constraint.

use dvi_core::prelude::*;

use super::bisected;

/// What the height u of a top depends on: (A u̇)² = (1 − u²) 2A(E − weight u) − (vertical − spin u)², by its
/// integrals (Goldstein 1980, section 5.7). A mass of 1 on a rod of length 1 has A = 1 and no spin.
#[derive(Clone, Copy, Debug)]
pub struct Heights {
    /// A, the moment of inertia across the axis.
    pub across: f64,
    /// The weight times the distance from the point of support.
    pub weight: f64,
    /// E, without the energy of the spin.
    pub energy: f64,
    /// The angular momentum about the axis.
    pub spin: f64,
    /// The angular momentum about the vertical.
    pub vertical: f64,
}

impl Heights {
    /// The roots of the cubic between −1 and 1, the lower one first. The third root is above 1, or is 1.
    pub fn extremes(&self) -> [f64; 2] {
        // u³ + a u² + b u + … = 0 has its peak between them.
        let Self { across, weight, energy, spin, vertical } = self;
        let leading = 2.0 * across * weight;
        let a = -(2.0 * across * energy + spin * spin) / leading;
        let b = (2.0 * spin * vertical - leading) / leading;
        let peak = -(a + (a * a - 3.0 * b).max(0.0).sqrt()) / 3.0;
        [bisected([-1.0, peak], |u| self.value(u) < 0.0), bisected([peak, 1.0], |u| self.value(u) > 0.0)]
    }

    /// How much the energy changes with an extreme that is near `u`, for the same momenta.
    pub fn stiffness(&self, u: f64) -> f64 {
        // The cubic is 2A (1 − u²) (E − V(u)), and V(u) = E at its roots.
        -self.slope(u) / (2.0 * self.across * (1.0 - u * u))
    }

    fn value(&self, u: f64) -> f64 {
        let turning = self.vertical - self.spin * u;
        (1.0 - u * u) * 2.0 * self.across * (self.energy - self.weight * u) - turning * turning
    }

    fn slope(&self, u: f64) -> f64 {
        let kinetic = self.energy - self.weight * u;
        let turning = self.vertical - self.spin * u;
        2.0 * self.spin * turning - 2.0 * self.across * (2.0 * u * kinetic + (1.0 - u * u) * self.weight)
    }
}

/// A system on a manifold whose states are so many numbers, for methods that know nothing of the manifold.
pub trait OnManifold<const D: usize>: ManifoldLagrangian + Copy {
    /// The places and the velocities.
    fn entries(&self, state: &Self::State<f64>) -> [f64; D] {
        let values: Vec<f64> = self.values(state).into_iter().flatten().collect();
        std::array::from_fn(|i| values[i])
    }

    /// The rates of the entries in the motion.
    fn motion(&self, y: &[f64; D]) -> [f64; D];
}

/// A mass of 1 on a rod of length 1, as a unit vector, in gravity along the third axis.
#[lagrangian(
    coordinates(s: S2),
    lagrangian = dot(s).norm_squared() / 2.0 - gravity * s[2],
    momenta(vertical = s[0] * dot(s[1]) - s[1] * dot(s[0])),
)]
#[derive(Clone, Copy, Debug)]
pub struct SphericalPendulum {
    pub gravity: f64,
}

/// The same in the coordinates of space, with the rod as an equation.
#[lagrangian(
    coordinates(s[3]),
    lagrangian = dot(s).norm_squared() / 2.0 - gravity * s[2],
    constraint = s.norm_squared() - 1.0,
    momenta(vertical = s[0] * dot(s[1]) - s[1] * dot(s[0])),
)]
#[derive(Clone, Copy, Debug)]
pub struct ConstrainedPendulum {
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
        let (energy, vertical) = (self.energy(s, dot_s, 0.0), self.momentum(0, s, dot_s, 0.0));
        Heights { across: 1.0, weight: self.gravity, energy, spin: 0.0, vertical }
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
    /// s̈ = −g e₃ − (|ṡ|² − g s₃) s
    fn motion(&self, &[x, y, z, u, v, w]: &[f64; 6]) -> [f64; 6] {
        let tension = u * u + v * v + w * w - self.gravity * z;
        [u, v, w, -tension * x, -tension * y, -self.gravity - tension * z]
    }
}

impl ConstrainedPendulum {
    /// The same as [`SphericalPendulum::shift`] for RATTLE: the kinetic energy of a step is that of the
    /// chord, which is shorter than the arc, chord² = θ² − θ⁴/12 + …, so that L of a step is less by
    /// h³|ṡ|⁴/24.
    pub fn shift(&self, state: &SphericalPendulumState) -> f64 {
        SphericalPendulum { gravity: self.gravity }.shift(state) - squared(&state.dot_s).powi(2) / 24.0
    }
}

impl From<ConstrainedPendulumState> for SphericalPendulumState {
    fn from(ConstrainedPendulumState { s, dot_s }: ConstrainedPendulumState) -> Self {
        Self { s, dot_s }
    }
}

fn squared(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}
