//! Ways to declare a system: run-time sizes, borrowed parameters, generics.

use dvi_core::degenerate_lagrangian;

/// A chain of n pendula, n known at run time.
#[degenerate_lagrangian(
    coordinates(angle[n], p[n]),
    one_form    = [|j| p[j], |j| 0.0],
    hamiltonian = sum(0..n, |j| p[j] * p[j] / (2.0 * mass) - angle[j].cos())
                      + sum(0..n - 1, |j| k[j] * (1.0 - (angle[j + 1] - angle[j]).cos())),
    momenta(total = sum(0..n, |j| p[j])),
)]
#[derive(Clone, Debug)]
pub struct Chain {
    /// Number of pendula.
    pub n: usize,
    /// Stiffness of each spring, n − 1 of them.
    pub k: Vec<f64>,
    /// Mass, in single precision.
    pub mass: f32,
}

/// Borrowed parameters.
#[degenerate_lagrangian(
    coordinates(x[weights.len()], y[weights.len()]),
    one_form    = sum(0..weights.len(), |j| weights[j] * x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..weights.len(), |j, k| coupling[j][k] * (x[j] - y[k]).exp()) * scale,
)]
#[derive(Clone, Debug)]
pub struct Borrowing<'a, const N: usize> {
    /// Weights.
    pub weights: &'a [f64],
    /// Couplings.
    pub coupling: &'a [[f64; N]; N],
    /// Overall factor.
    pub scale: &'a f64,
}
