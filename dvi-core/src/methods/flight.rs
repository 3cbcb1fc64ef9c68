//! Methods on T*Q for regular systems of any kind, and the motion between impacts.

use crate::error::{StartError, StepFailure};
use crate::methods::step::Carried;
use crate::methods::{Carries, DiscreteEnergy, Scheme, Step};
use crate::{NondegenerateLagrangian, Real, Vector};

/// How a method steps a regular system of any kind, as if it had no constraints and no impacts.
pub trait Flight<S: NondegenerateLagrangian<T>, T: Real>: Scheme + Carries<S, T> {
    /// The point of T*Q in what a run carries.
    fn carried(memory: &Self::Memory) -> &Carried<S, T>;

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
}

/// A method that takes a system from impact to impact: its steps have any lengths, and its momentum may be
/// changed between two of them. It knows nothing of constraints and impacts;
/// [`Impacts`](crate::methods::Impacts) around it does.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be stopped at impacts",
    label = "its memory belongs to one length of the step, or it has no momentum",
    note = "methods that can are `Variational` without a frequency and `Galerkin` without a frequency"
)]
pub trait FreeFlight<S: NondegenerateLagrangian<T>, T: Real>: Flight<S, T> {
    /// Adds `impulse` to the momentum; `velocity` is about what that leads to.
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]);

    /// As [`Method::DISCRETE_ENERGY`](crate::methods::Method::DISCRETE_ENERGY), of a flight.
    const DISCRETE_ENERGY: Option<DiscreteEnergy<Self, S, T>> = None;
}
