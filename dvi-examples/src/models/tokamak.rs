//! The guiding centre of a charged particle in an axisymmetric tokamak field, in two sets of coordinates.
//!
//! In units of the major radius, of the field on the magnetic axis, and of the gyration there, the vector
//! potential is A = ½r²(1 − ⅔ r cos θ) dθ − r²/(2q) dφ. The field has circular flux surfaces, the strength 1
//! − r cos θ along φ and r/(qR) along θ with R = 1 + r cos θ, and q is constant. With b the direction of the
//! field and u the velocity along it, the one-form of the guiding centre is (A + u b)·dx (Littlejohn 1983),
//! and the magnetic moment μ is a parameter.

use core::f64::consts::TAU;

use anyhow::Result;
use dvi_core::field::{Axis, ScalarField};
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

/// The guiding centre of [`TokamakInClass`] in a field that is known from a table only, in class too.
///
/// A computed equilibrium comes as numbers on a grid. The five functions of the section (r, θ) that the
/// Lagrangian needs, A_θ, A_φ, b_θ, b_φ and |B|, become splines, periodic in θ. They need not be consistent
/// with one another for a scheme to be variational: the splines are the Lagrangian.
#[degenerate_lagrangian(
    coordinates(r, theta, phi, u),
    one_form    = (a_theta(r, theta) + u * b_theta(r, theta)) * d(theta)
        + (a_phi(r, theta) + u * b_phi(r, theta)) * d(phi),
    hamiltonian = u * u / 2.0 + mu * strength(r, theta),
)]
#[derive(Clone, Debug)]
pub struct TabulatedTokamak<F> {
    pub a_theta: F,
    pub a_phi: F,
    pub b_theta: F,
    pub b_phi: F,
    pub strength: F,
    pub mu: f64,
}

/// The part of the section that the table covers, from r = 0.06 to 0.3.
const SECTION: [f64; 2] = [0.06, 0.3];

pub type Sampled<'a> = &'a dyn Fn([f64; 2]) -> f64;

impl<F: ScalarField<2>> TabulatedTokamak<F> {
    /// The field with the safety factor `q` on a grid of `n` intervals across the section and 4 `n` around
    /// it, which `spline` makes functions of.
    ///
    /// # Errors
    /// Those of `spline`, and grids that are too small.
    pub fn sampled(
        q: f64,
        mu: f64,
        n: usize,
        spline: impl Fn([Axis; 2], Sampled<'_>) -> Result<F>,
    ) -> Result<Self> {
        let around: Vec<f64> = (0..4 * n).map(|i| i as f64 * TAU / (4 * n) as f64).collect();
        let axes = [Axis::uniform(SECTION, n + 1)?, Axis::periodic(&around, TAU)?];
        let major = |[r, theta]: [f64; 2]| 1.0 + r * theta.cos();
        let toroidal = |at| 2.0 - major(at);
        let poloidal = |at: [f64; 2]| at[0] / (q * major(at));
        let strength = |at| toroidal(at).hypot(poloidal(at));
        let sampled = |function: Sampled<'_>| spline(axes.clone(), function);
        Ok(Self {
            a_theta: sampled(&|at| at[0].powi(2) / 2.0 * (5.0 - 2.0 * major(at)) / 3.0)?,
            a_phi: sampled(&|[r, _]| -r * r / (2.0 * q))?,
            b_theta: sampled(&|at| at[0] * poloidal(at) / strength(at))?,
            b_phi: sampled(&|at| major(at) * toroidal(at) / strength(at))?,
            strength: sampled(&strength)?,
            mu,
        })
    }
}

/// A charged particle without mass in the plane, whose drift is B x' = −∂φ/∂y and B y' = ∂φ/∂x:
/// L = A(x, y)·(x', y') − φ(x, y), in the field B = ∂A_y/∂x − ∂A_x/∂y = 1 + 2(x² + y²) and the potential φ =
/// cos x + sin y. In the symmetric gauge A = ½(1 + x² + y²)(−y, x), with components along both coordinates.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + x * x + y * y) / 2.0 * (x * d(y) - y * d(x)),
    hamiltonian = x.cos() + y.sin(),
)]
#[derive(Clone, Debug)]
pub struct MasslessSymmetric {}

/// In a gauge with a component along x only, A = (−y(1 + 2x²) − ⅔y³, 0): in the class of one-step schemes.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + x * x + y * y) / 2.0 * (x * d(y) - y * d(x)),
    hamiltonian = x.cos() + y.sin(),
    gauge       = auto,
)]
#[derive(Clone, Debug)]
pub struct MasslessAlongX {}
