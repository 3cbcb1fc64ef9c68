//! Runs that can be begun again where they have been.

use alloc::format;
use alloc::string::String;
use core::any::type_name;
use core::fmt::Debug;

use super::begun::resumed;
use super::{Checkpoint, Integrator, Run, StepControl};
use crate::error::{CheckpointError, StartError};
use crate::methods::Method;
use crate::{Held, Lagrangian, Real};

/// A run from which others on the same system can be made, with the same method and step control: these and
/// its system can be cloned, as a reference and an `Arc` can.
pub trait Resume: Run + Sized {
    /// A run that goes on from `checkpoint`, one of this run or of one like it.
    ///
    /// # Errors
    /// As [`Integrator::resume`] and [`Integrator::resume_controlled`].
    fn resumed(&self, checkpoint: &Checkpoint<Self::Scalar>) -> Result<Self, StartError>;

    /// The method, and the [`StepControl`] if it is no number, with their options.
    fn taken_by(&self) -> [String; 2];
}

impl<H, M, T: Real, C> Resume for Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>> + Clone,
    M: Method<H::System, T> + Clone + Debug,
    C: StepControl<H::System, T> + Clone,
{
    fn resumed(&self, checkpoint: &Checkpoint<T>) -> Result<Self, StartError> {
        if C::ONE_LENGTH && checkpoint.step_size() != self.step_size() {
            return Err(CheckpointError::Damaged.into());
        }
        let (method, control) = (self.method().clone(), self.control.clone());
        let begun = resumed(self.system(), &method, &control, checkpoint)?;
        Ok(Self::of(self.system.clone(), method, control, begun))
    }

    fn taken_by(&self) -> [String; 2] {
        let control: &dyn Debug = if C::ONE_LENGTH { &() } else { &self.control };
        [format!("{} {:?}", type_name::<M>(), self.method()), format!("{control:?}")]
    }
}
