//! Oscillators and pendulums: with one degree of freedom, in the plane in a potential that depends on the
//! radius, on a spring and with friction, and two pendulums of which the second hangs from the first.

use dvi_core::prelude::*;

/// z' = iωz with z = x + iy: the test equation of stability.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = omega / 2.0 * (x * x + y * y),
)]
#[derive(Clone, Debug)]
pub struct Rotation {
    pub omega: f64,
}

/// z' = λz for any complex λ, by L = w·(z' − λz) with a second variable w' = −λᵀw that stays zero if it
/// begins so.
#[degenerate_lagrangian(
    coordinates(z[2], w[2]),
    one_form = (w[0] * d(z[0]) + w[1] * d(z[1]) - z[0] * d(w[0]) - z[1] * d(w[1])) / 2.0,
    hamiltonian = w[0] * (real * z[0] - imaginary * z[1]) + w[1] * (imaginary * z[0] + real * z[1]),
)]
#[derive(Clone, Debug)]
pub struct Linear {
    pub real: f64,
    pub imaginary: f64,
}

/// x'' = −kx: an oscillator of frequency √k, or, with negative k, what runs away from its origin.
#[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - k * x * x) / 2.0)]
#[derive(Clone, Debug)]
pub struct Spring {
    pub k: f64,
}

/// x'' = −sin x, x in radians from the lowest point.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 + x.cos())]
#[derive(Clone, Debug)]
pub struct Pendulum {}

/// The same pendulum in phase space, with p = x' and a one-form along x only.
#[degenerate_lagrangian(coordinates(x, p), one_form = p * d(x), hamiltonian = p * p / 2.0 - x.cos())]
#[derive(Clone, Debug)]
pub struct PhasePendulum {}

/// The same with the symmetric one-form.
#[degenerate_lagrangian(
    coordinates(x, p),
    one_form    = (p * d(x) - x * d(p)) / 2.0,
    hamiltonian = p * p / 2.0 - x.cos(),
)]
#[derive(Clone, Debug)]
pub struct SymmetricPendulum {}

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
#[derive(Clone, Copy, Debug)]
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

/// Two pendulums of unit mass, the second hung from the first, in angles from the vertical.
#[lagrangian(
    coordinates(a, b),
    lagrangian = {
        let first = length * dot(a);
        let second = length * dot(b);
        let kinetic = first.powi(2) + second.powi(2) / 2.0 + first * second * (a - b).cos();
        kinetic + g * length * (2.0 * a.cos() + b.cos())
    },
)]
#[derive(Clone, Debug)]
pub struct DoublePendulum {
    /// The length of either rod.
    pub length: f64,
    pub g: f64,
}
