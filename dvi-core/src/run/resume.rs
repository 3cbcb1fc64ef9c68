//! Runs that can be begun again where they have been.

use core::fmt::Debug;

use super::{Checkpoint, ControlledIntegrator, Integrator, StepControl, WithMethod};
use crate::error::StartError;
use crate::methods::{Method, VariableStep};
use crate::{Held, Lagrangian, Real};

/// A run from which others on the same system can be made, with the same method: its system and its method
/// can be cloned, as a reference and an `Arc` can.
pub trait Resume: WithMethod + Sized {
    /// A run that goes on from `checkpoint`, one of this run or of one like it.
    ///
    /// # Errors
    /// As [`Integrator::resume`] and [`ControlledIntegrator::resume`].
    fn resumed(&self, checkpoint: &Checkpoint<Self::Scalar>) -> Result<Self, StartError>;

    /// What chooses the lengths of the steps: the [`StepControl`], or nothing.
    fn chosen_by(&self) -> &dyn Debug;
}

impl<H, M, T: Real> Resume for Integrator<H, M, T>
where
    H: Held<System: Lagrangian<T>> + Clone,
    M: Method<H::System, T> + Clone,
{
    fn resumed(&self, checkpoint: &Checkpoint<T>) -> Result<Self, StartError> {
        Self::resume(self.system.clone(), self.method().clone(), checkpoint)
    }

    fn chosen_by(&self) -> &dyn Debug {
        &()
    }
}

impl<H, M, C, T: Real> Resume for ControlledIntegrator<H, M, C, T>
where
    H: Held<System: Lagrangian<T>> + Clone,
    M: VariableStep<H::System, T> + Clone,
    C: StepControl<H::System, T> + Clone,
{
    fn resumed(&self, checkpoint: &Checkpoint<T>) -> Result<Self, StartError> {
        Self::resume(self.system.clone(), self.method().clone(), self.control().clone(), checkpoint)
    }

    fn chosen_by(&self) -> &dyn Debug {
        self.control()
    }
}
