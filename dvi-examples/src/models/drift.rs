//! A charged particle without mass in the plane: its drift is B x' = −∂φ/∂y and B y' = ∂φ/∂x.
//!
//! L = A(x, y)·(x', y') − φ(x, y), in the field B = ∂A_y/∂x − ∂A_x/∂y = 1 + 2(x² + y²) and the potential φ =
//! cos x + sin y.

use dvi_core::prelude::*;

/// In the symmetric gauge A = ½(1 + x² + y²)(−y, x), which has components along both coordinates.
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
