//! The motion between impacts.

use crate::discrete::Span;
use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, Here, Scheme, Step};
use crate::{NondegenerateLagrangian, Real, Vector};

/// A method that takes a system from impact to impact: its steps have any lengths, and its momentum may be
/// changed between two of them. It knows nothing of constraints and impacts;
/// [`Impacts`](crate::methods::Impacts) around it does.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be stopped at impacts",
    label = "its memory belongs to one length of the step, or it has no momentum",
    note = "methods that can are `Variational` without a frequency and `Galerkin` without a frequency"
)]
pub trait FreeFlight<S: NondegenerateLagrangian<T>, T: Real>: Scheme + Carries<S, T> {
    /// Prepares a run from (`q`, `v`, `t`), whose longest steps have the length `h`.
    ///
    /// # Errors
    /// As [`Method::begin`](crate::methods::Method::begin).
    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError>;

    /// Takes a step, without allocation.
    ///
    /// # Errors
    /// Any [`StepFailure`]; nothing has moved then.
    fn fly(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure>;

    /// Sets `v` to the velocity at the present point.
    ///
    /// # Errors
    /// [`StepFailure`] where no velocity belongs to the momentum.
    fn velocity_in_flight(
        &self,
        here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut [T],
    ) -> Result<(), StepFailure>;

    /// Adds `impulse` to the momentum; `velocity` is about what that leads to.
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]);

    /// Whether [`energy_of_flight`](Self::energy_of_flight) is known.
    const HAS_ENERGY: bool = false;

    /// The discrete energy E_d = −∂L_d/∂h of a flight, for L that does not depend on time; `None` if it is
    /// not known. `work` is storage for a point and a velocity.
    fn energy_of_flight(&self, _span: Span<'_, S, T>, _work: &mut [Vector<S, T>; 2]) -> Option<T> {
        None
    }
}
