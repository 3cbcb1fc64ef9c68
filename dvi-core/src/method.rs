//! What an integrator is to a run.

use crate::error::{StartError, StepFailure};
use crate::statistics::Statistics;
use crate::{Lagrangian, Real, Vector};

/// The geometric structure that every step of a method preserves, up to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PreservedForm {
    /// None.
    Nothing,
    /// Ω = −dα on Q, if α is affine.
    OmegaIfAffine,
    /// The discrete two-form ∂²L_d/∂q0∂q1 dq0 ∧ dq1 on Q×Q (Rowley & Marsden 2002, eq. 17).
    Discrete,
}

/// What is known of a method before it meets a system.
pub trait Scheme {
    /// The order of convergence on general smooth systems.
    fn order(&self) -> usize;
    /// Whether a step with −h undoes a step with h.
    fn is_symmetric(&self) -> bool;
    /// What is preserved.
    fn preserved_form(&self) -> PreservedForm;
}

/// A method that can step a system `S` in the arithmetic of `T`.
pub trait Method<S: Lagrangian, T: Real>: Scheme {
    /// What a run carries from step to step besides the coordinates: momenta, guesses, work space.
    type Memory;

    /// Prepares a run with step `h` from (`q`, `t`). Everything that needs memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Parameter`] if an option is out of range; [`StartError::Starter`] if the starting
    /// values cannot be computed, or a matrix that is the same for all steps is singular.
    fn begin(&self, system: &S, q: &Vector<S, T>, t: T, h: T) -> Result<Self::Memory, StartError>;

    /// Advances `q` from `t` to `t + h`, without allocation.
    ///
    /// # Errors
    /// Any [`StepFailure`]; `q` and the dynamical part of `memory` are then as they were before.
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;
}

/// A method whose run is determined by two consecutive points.
pub trait TwoPoint<S: Lagrangian, T: Real>: Method<S, T> {
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
