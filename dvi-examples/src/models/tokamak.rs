//! The guiding centre of a charged particle in an axisymmetric tokamak field, in two sets of coordinates.
//!
//! In units of the major radius, of the field on the magnetic axis, and of the gyration there, the vector
//! potential is A = ½r²(1 − ⅔ r cos θ) dθ − r²/(2q) dφ. The field has circular flux surfaces, the strength 1
//! − r cos θ along φ and r/(qR) along θ with R = 1 + r cos θ, and q is constant. With b the direction of the
//! field and u the velocity along it, the one-form of the guiding centre is (A + u b)·dx (Littlejohn 1983),
//! and the magnetic moment μ is a parameter.

use dvi_core::prelude::*;

/// In toroidal coordinates: α has components along θ and φ only, which is in the class of one-step schemes.
#[degenerate_lagrangian(
    coordinates(r, theta, phi, u),
    one_form    = (r * r / 2.0 * (1.0 - 2.0 * x / 3.0) + u * r * poloidal / b) * d(theta) + p_phi * d(phi),
    hamiltonian = u * u / 2.0 + mu * b,
    momenta(toroidal = p_phi),
    let = {
        let x = r * theta.cos();
        let toroidal = 1.0 - x;
        let poloidal = r / (q * (1.0 + x));
        let b = toroidal.hypot(poloidal);
        let p_phi = u * (1.0 + x) * toroidal / b - r * r / (2.0 * q);
    },
)]
#[derive(Clone, Debug)]
pub struct TokamakInClass {
    /// The safety factor: turns around the torus for one around its section.
    pub q: f64,
    /// The magnetic moment.
    pub mu: f64,
}

/// In x = R − 1, z and φ: α has components along three of four coordinates, and no gauge removes those along
/// a half of them, since u stands in each.
#[degenerate_lagrangian(
    coordinates(x, z, phi, u),
    one_form    = (0.5 - x / 3.0 + u / (q * radius * b)) * (x * d(z) - z * d(x)) + p_phi * d(phi),
    hamiltonian = u * u / 2.0 + mu * b,
    momenta(toroidal = p_phi),
    let = {
        let radius = 1.0 + x;
        let b = ((1.0 - x).powi(2) + (x * x + z * z) / (q * radius).powi(2)).sqrt();
        let p_phi = u * radius * (1.0 - x) / b - (x * x + z * z) / (2.0 * q);
    },
)]
#[derive(Clone, Debug)]
pub struct TokamakOutOfClass {
    /// The safety factor: turns around the torus for one around its section.
    pub q: f64,
    /// The magnetic moment.
    pub mu: f64,
}
