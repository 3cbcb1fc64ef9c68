//! How much of the second derivatives of L is added to a matrix.

use crate::Real;

/// The weights of the four blocks of the second derivative of L(q, v, t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<T> {
    /// Weight of ∂²L/∂qⁱ∂qʲ.
    pub qq: T,
    /// Weight of ∂²L/∂qⁱ∂vʲ.
    pub qv: T,
    /// Weight of ∂²L/∂vⁱ∂qʲ.
    pub vq: T,
    /// Weight of ∂²L/∂vⁱ∂vʲ.
    pub vv: T,
}

impl<T: Real> Weights<T> {
    /// Those that leave nothing.
    #[inline]
    pub(crate) fn none() -> Self {
        let zero = T::lift(0.0);
        Self { qq: zero, qv: zero, vq: zero, vv: zero }
    }

    /// Those that leave the mass matrix, ∂²L/∂v∂v.
    pub(crate) fn mass() -> Self {
        Self { vv: T::lift(1.0), ..Self::none() }
    }
}
