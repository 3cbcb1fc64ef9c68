//! Regular Lagrangians: separable and not, quadratic in the velocities and not, with arrays and time.

use dvi_core::lagrangian;

/// A planet around a fixed sun.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Kepler {
    /// Strength of the attraction.
    pub mu: f64,
}

/// A sun of unit strength.
pub const KEPLER: Kepler = Kepler { mu: 1.0 };

/// At the pericentre of an orbit with eccentricity `e` and period 2π.
pub fn pericentre(e: f64) -> KeplerState {
    KeplerState { x: 1.0 - e, y: 0.0, dot_x: 0.0, dot_y: ((1.0 + e) / (1.0 - e)).sqrt() }
}

/// Two pendulums, the second hung from the first, in angles from the vertical.
#[lagrangian(
    coordinates(a, b),
    lagrangian = {
        let first = length[0] * dot(a);
        let second = length[1] * dot(b);
        let kinetic = mass[0] * first.powi(2) / 2.0
            + mass[1] * (first.powi(2) + second.powi(2) + 2.0 * first * second * (a - b).cos()) / 2.0;
        let height = (mass[0] + mass[1]) * length[0] * (1.0 - a.cos()) + mass[1] * length[1] * (1.0 - b.cos());
        kinetic - g * height
    },
)]
#[derive(Clone, Debug, PartialEq)]
pub struct DoublePendulum {
    /// Masses.
    pub mass: [f64; 2],
    /// Lengths of the rods.
    pub length: [f64; 2],
    /// Gravity.
    pub g: f64,
}

/// A pendulum in space, θ from the downward vertical and φ around it.
#[lagrangian(
    coordinates(theta, phi),
    lagrangian = (dot(theta).powi(2) + theta.sin().powi(2) * dot(phi).powi(2)) / 2.0 + g * theta.cos(),
    momenta(vertical = theta.sin().powi(2) * dot(phi)),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct SphericalPendulum {
    /// Gravity over length.
    pub g: f64,
}

/// A particle that slides on the surface z = cos(k x) cosh(y) / k.
#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let slope_x = -(k * x).sin() * y.cosh();
        let slope_y = (k * x).cos() * y.sinh() / k;
        let rise = slope_x * dot(x) + slope_y * dot(y);
        (dot(x).powi(2) + dot(y).powi(2) + rise * rise) / 2.0 - (k * x).cos() * y.cosh() / k
    },
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Wave number.
    pub k: f64,
}

/// A relativistic particle, c = 1, in a harmonic potential.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -m * (1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() - (x * x + y * y) / 2.0,
    momenta(p_x = m * dot(x) / (1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt()),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Relativistic {
    /// Rest mass.
    pub m: f64,
}

/// A ring of N masses with springs of Fermi, Pasta, Ulam and Tsingou.
#[lagrangian(
    coordinates(q[N]),
    lagrangian = sum(0..N, |j| {
        let stretch = q[(j + 1) % N] - q[j];
        mass[j] * dot(q[j]).powi(2) / 2.0 - stretch.powi(2) / 2.0 - alpha / 3.0 * stretch.powi(3)
    }),
    momenta(total = sum(0..N, |j| mass[j] * dot(q[j]))),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Ring<const N: usize> {
    /// Masses.
    pub mass: [f64; N],
    /// Strength of the cubic term.
    pub alpha: f64,
}

/// A chain whose length is known at run time, with an anharmonic wall, neighbours whose velocities are
/// coupled, and a single coordinate beside the array.
#[lagrangian(
    coordinates(q[mass.len()], wall),
    lagrangian = sum(0..mass.len(), |j| mass[j] * dot(q[j]).powi(2)) / 2.0
        + coupling * sum(1..mass.len(), |j| dot(q[j]) * dot(q[j - 1]))
        + dot(wall).powi(2)
        - sum(1..mass.len(), |j| (q[j] - q[j - 1]).cosh())
        - (q[0] - wall).powi(4) / 4.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct RunTimeChain {
    /// Masses.
    pub mass: Vec<f64>,
    /// Coupling of the velocities.
    pub coupling: f64,
}

/// A pendulum whose support is driven.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - (1.0 + depth * (omega * t).cos()) * (1.0 - x.cos()) + t * x,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenOscillator {
    /// Depth of the modulation.
    pub depth: f64,
    /// Frequency.
    pub omega: f64,
}

/// A particle whose mass grows in time.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (t / 4.0).exp() * (dot(x).powi(2) + dot(x) * dot(y) + dot(y).powi(2) - x * x * y * y),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct GrowingMass {}

/// A charged particle in the magnetic field b (1 + x² + y² / 2) along z.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = m / 2.0 * (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2))
        + b * (-(y / 2.0 + y.powi(3) / 6.0) * dot(x) + (x / 2.0 + x.powi(3) / 3.0) * dot(y))
        - (x * x + y * y - z).powi(2) / 4.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct MagneticParticle {
    /// Mass.
    pub m: f64,
    /// Field at the origin.
    pub b: f64,
}

/// A small body in the plane of two that go round each other, in the frame that turns with them: L has terms
/// linear in v.
#[lagrangian(
    coordinates(x, y),
    lagrangian = ((dot(x) - y).powi(2) + (dot(y) + x).powi(2)) / 2.0
        + (1.0 - mu) / (x + mu).hypot(y) + mu / (x - 1.0 + mu).hypot(y),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct RestrictedThreeBody {
    /// The share of the smaller one in the mass of both.
    pub mu: f64,
}

/// N bodies in the plane that attract each other.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |j| mass[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2))) / 2.0
        + sum_pairs(0..N, |j, k| mass[j] * mass[k] / (x[j] - x[k]).hypot(y[j] - y[k])),
    momenta(
        p_x = sum(0..N, |j| mass[j] * dot(x[j])),
        angular = sum(0..N, |j| mass[j] * (x[j] * dot(y[j]) - y[j] * dot(x[j]))),
    ),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Gravity<const N: usize> {
    /// Masses.
    pub mass: [f64; N],
}

/// Two oscillators in coordinates that mix their velocities: a constant full mass matrix.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + dot(x) * dot(y) / 3.0 + (dot(y) - dot(x)).powi(2) - (x * x + x * y + y.powi(4)),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct MixedVelocities {}

/// Nothing about it is simple: a velocity in a function of a sum, in a power, in a choice, and alone.
#[lagrangian(
    coordinates(x[3], u),
    lagrangian = (1.0 + sum(0..3, |j| dot(x[j]).powi(2))).sqrt() * (2.0 + x[0].sin())
        + if u > 0.0 { dot(u).powi(4) + dot(u).powi(2) } else { 2.0 * dot(u).cosh() }
        + g * (dot(u).exp() + (dot(x[1]) * u).sin() - x[2] * dot(x[2]) + dot(u) * t),
    momenta(speed = sum(0..3, |j| dot(x[j]).abs()).ln_1p()),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Tangled {
    /// Strength of what is least simple.
    pub g: f64,
}

/// A particle on a spring.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - stiffness * x * x / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The square of the frequency.
    pub stiffness: f64,
}

/// One that swings once in 2π.
pub const SPRING: Spring = Spring { stiffness: 1.0 };

/// A particle that nothing pulls at.
pub const FREE: Spring = Spring { stiffness: 0.0 };

/// A particle in the plane on a spring.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - stiffness * (x * x + y * y) / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Planar {
    /// The square of the frequency.
    pub stiffness: f64,
}

/// One that turns once in 2π.
pub const PLANE: Planar = Planar { stiffness: 1.0 };

/// Springs side by side, as many as there are.
#[lagrangian(
    coordinates(x[k.len()]),
    lagrangian = sum(0..k.len(), |j| dot(x[j]).powi(2) - k[j] * x[j] * x[j]) / 2.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Springs {
    /// The squares of their frequencies.
    pub k: Vec<f64>,
}

/// Hénon & Heiles 1964: explicit steps, and motions that leave.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
        - (x * x + y * y) / 2.0 - x * x * y + y.powi(3) / 3.0,
)]
#[derive(Clone, Debug, PartialEq)]
pub struct HenonHeiles;

/// A body that comes to rest: dry friction pushes it back from either side.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0,
    force(x) = if dot(x) > 0.0 { -0.3 } else { 0.1 },
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Sliding;
