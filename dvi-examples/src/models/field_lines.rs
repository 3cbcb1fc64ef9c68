//! Magnetic field lines as a flow.
//!
//! Along a field line ∫A·dx is stationary (Cary & Littlejohn 1983). If the field has a component along z
//! everywhere, z can be the time: L = A_x x' + A_y y' + A_z, a degenerate Lagrangian with H = −A_z. Its Ω is
//! the flux of the field through the plane.

use dvi_core::prelude::*;

use super::bisected;

/// The field of Arnold, Beltrami and Childress with a uniform one along z, which is the time:
/// B = (a sin z + c cos y, b sin x + a cos z, uniform + c sin y + b cos x).
///
/// The first field is its own vector potential, as its curl is the field itself. B_z > 0 everywhere if
/// uniform > |b| + |c|.
#[degenerate_lagrangian(
    coordinates(x, y),
    lagrangian = (a * t.sin() + c * y.cos() - uniform * y) * dot(x) + (b * x.sin() + a * t.cos()) * dot(y)
        + c * y.sin() + b * x.cos(),
    gauge      = auto,
)]
#[derive(Clone, Debug)]
pub struct Abc {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub uniform: f64,
}

/// The field of a tokamak with resonant perturbations, in cylindrical coordinates, with the toroidal angle φ
/// as the time.
///
/// In units of the major radius and of the field there, A_Z = −ln R gives the toroidal field 1/R, and
/// R A_φ = ψ is the poloidal flux: (ι − ½ι' s) s with s = ½ρ² and ρ² = (R − 1)² + Z², and of each perturbation the
/// real part of ε_m (R − 1 + iZ)^m e^{−inφ}, with m/n = 2/1 and 3/2. Unperturbed surfaces are circles, and
/// R' = −R (ι − ι's) Z and Z' = R (ι − ι's)(R − 1) turn around the axis 1/q = (ι − ι's) √(1 − ρ²) times in
/// each turn around the torus.
#[degenerate_lagrangian(
    coordinates(r, z),
    lagrangian = -r.ln() * dot(z) + {
        let x = r - 1.0;
        let s = (x * x + z * z) / 2.0;
        let two = (x * x - z * z) * t.cos() + 2.0 * x * z * t.sin();
        let three = (x * x - 3.0 * z * z) * x * (2.0 * t).cos() + (3.0 * x * x - z * z) * z * (2.0 * t).sin();
        (iota - shear * s / 2.0) * s + epsilon[0] * two + epsilon[1] * three
    },
)]
#[derive(Clone, Debug)]
pub struct PerturbedTokamak {
    /// ι, the turns around the axis near it.
    pub iota: f64,
    /// ι', by how much that falls with s.
    pub shear: f64,
    /// The perturbations 2/1 and 3/2.
    pub epsilon: [f64; 2],
}

impl PerturbedTokamak {
    /// The poloidal flux of the unperturbed field at distance ρ from the axis.
    pub fn flux(&self, rho: f64) -> f64 {
        let s = rho * rho / 2.0;
        (self.iota - self.shear * s / 2.0) * s
    }

    /// 1/q of the unperturbed field at distance ρ from the axis.
    pub fn turns(&self, rho: f64) -> f64 {
        (self.iota - self.shear * rho * rho / 2.0) * (1.0 - rho * rho).sqrt()
    }

    /// The distance from the axis at which a line turns around it `turns` times; 1/q falls with the
    /// distance.
    pub fn resonance(&self, turns: f64) -> f64 {
        bisected([0.0, 0.9], |rho| self.turns(rho) > turns)
    }
}
