//! Methods whose runs can begin with two points.

use super::Method;
use crate::error::StartError;
use crate::{Lagrangian, Real, Vector};

/// A method whose run is determined by two consecutive points.
pub trait TwoPoint<S: Lagrangian<T>, T: Real>: Method<S, T> {
    /// Prepares a run from `q0` at `t` whose first step arrives at `q1`.
    ///
    /// # Errors
    /// As [`Method::begin`].
    fn begin_between(
        &self,
        system: &S,
        q0: &Vector<S, T>,
        q1: &Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<Self::Memory, StartError>;
}
