//! How runs go on from checkpoints.

use super::begun::{Begun, BegunOf, carried};
use super::clock::Time;
use super::{Checkpoint, StepControl};
#[cfg(feature = "ensembles")]
use super::{Integrator, Run};
#[cfg(feature = "ensembles")]
use crate::Held;
use crate::error::{CheckpointError, StartError};
use crate::methods::Method;
use crate::scalar::norm::reported;
use crate::system::start::validate;
use crate::{Lagrangian, Real};

#[cfg(feature = "ensembles")]
impl<H, M, T: Real, C> Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>> + Clone,
    M: Method<H::System, T> + Clone,
    C: StepControl<H::System, T> + Clone,
{
    /// Another run that goes on from `checkpoint`, one of this run or of one like it.
    pub(crate) fn going_on_from(&self, checkpoint: &Checkpoint<T>) -> Result<Self, StartError> {
        if C::ONE_LENGTH && checkpoint.step_size() != self.step_size() {
            return Err(CheckpointError::Damaged.into());
        }
        let (method, control) = (self.method().clone(), self.control.clone());
        let begun = resumed(self.system(), &method, &control, checkpoint)?;
        Ok(Self::of(self.system.clone(), method, control, begun))
    }
}

/// From a checkpoint.
pub(super) fn resumed<S: Lagrangian<T>, M: Method<S, T>, C: StepControl<S, T>, T: Real>(
    system: &S,
    method: &M,
    control: &C,
    checkpoint: &Checkpoint<T>,
) -> Result<BegunOf<S, M::Memory, C, T>, StartError> {
    let (t, h, statistics) = (checkpoint.time(), checkpoint.step_size(), checkpoint.statistics());
    validate(system, t)?;
    let at = checkpoint.point(system)?;
    control.admit::<M>()?;
    let lengths = |q: &_, v: &_| Ok((control.begin_again(system, q, v, t)?, h));
    let mut begun =
        carried::<S, C, _, T>(system, &at, t, lengths, |q, v, h| method.begin_again(system, q, v, t, h))?;
    checkpoint.load(&mut begun)?;
    let time = &mut begun.time;
    let is_length = C::ONE_LENGTH || (time.h == h && h != T::lift(0.0));
    if time.after(statistics.steps).time() != t || !is_length {
        return Err(CheckpointError::Damaged.into());
    }
    if time.h != h {
        // No steps have been taken with this one.
        if t + h == t {
            return Err(StartError::Step { h: reported(h) });
        }
        *time = Time::new(t, h, statistics.steps);
    }
    Ok(Begun { statistics, ..begun })
}
