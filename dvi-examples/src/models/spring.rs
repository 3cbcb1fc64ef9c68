//! A particle on a spring that becomes stiffer with its length.

use dvi_core::prelude::*;

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
