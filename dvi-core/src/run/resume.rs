//! How runs go on from checkpoints.

#[cfg(feature = "ensembles")]
use super::Run;
use super::begun::{Begun, BegunOf, carried};
use super::clock::Time;
use super::{Checkpoint, Integrator, Obeys, StepControl};
use crate::error::{CheckpointError, StartError};
use crate::memory::Memory;
use crate::methods::{Carries, Method, Suits, SuitsAnyStep};
use crate::system::start::validate;
use crate::{Held, Lagrangian, Real};

impl<H: Held<System: Lagrangian<T>>, M: Carries<H::System, T>, T: Real> Integrator<H, M, T> {
    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped; with another
    /// [step](Checkpoint::with_step_size) from the same momenta.
    ///
    /// # Errors
    /// As [`new_at`](Self::new_at), and [`StartError::Checkpoint`] if it has more or less than this method
    /// carries on this system, or numbers that no run has.
    pub fn resume<X>(system: H, method: X, checkpoint: &Checkpoint<T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let (method, h) = (method.suited(), checkpoint.step_size());
        let begun = resumed(system.held(), X::steps(&method), &h, checkpoint)?;
        Ok(Self::of(system, method, h, begun))
    }
}

impl<H, M, T: Real, C> Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>>,
    M: Carries<H::System, T>,
    C: Carries<H::System, T>,
{
    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped. What a control
    /// carries from step to step, the length and the direction of the next step among it, is that of the
    /// checkpoint.
    ///
    /// # Errors
    /// As [`controlled_at`](Self::controlled_at), and [`StartError::Checkpoint`] if it has more or less than
    /// method and control carry on this system, or numbers that no run has.
    pub fn resume_controlled<X, Y>(
        system: H,
        method: X,
        control: Y,
        checkpoint: &Checkpoint<T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (method, control) = (method.suited(), M::suited(control));
        let begun = resumed(system.held(), X::steps(&method), M::lengths(&control), checkpoint)?;
        Ok(Self::of(system, method, control, begun))
    }

    /// Another run that goes on from `checkpoint`, one of this run or of one like it.
    ///
    /// # Errors
    /// As [`resume`](Integrator::resume) and [`resume_controlled`](Self::resume_controlled).
    #[cfg(feature = "ensembles")]
    pub(crate) fn going_on_from(&self, checkpoint: &Checkpoint<T>) -> Result<Self, StartError>
    where
        H: Clone,
        M: Method<H::System, T> + Clone,
        C: StepControl<H::System, T> + Clone,
    {
        if C::ONE_LENGTH && checkpoint.step_size() != self.step_size() {
            return Err(CheckpointError::Damaged.into());
        }
        let (method, control) = (self.method().clone(), self.control.clone());
        let begun = resumed(self.system(), &method, &control, checkpoint)?;
        Ok(Self::of(self.system.clone(), method, control, begun))
    }
}

/// From a checkpoint.
fn resumed<S: Lagrangian<T>, M: Method<S, T>, C: StepControl<S, T>, T: Real>(
    system: &S,
    method: &M,
    control: &C,
    checkpoint: &Checkpoint<T>,
) -> Result<BegunOf<S, M::Memory, C, T>, StartError> {
    let (t, h, statistics) = (checkpoint.time(), checkpoint.step_size(), checkpoint.statistics());
    validate(system, t)?;
    let at = checkpoint.point(system)?;
    control.admit(method)?;
    let lengths = |q: &_, v: &_| Ok((control.begin_again(system, q, v, t)?, h));
    let mut begun =
        carried::<S, C, _, T>(system, at, t, lengths, |q, v, h| method.begin_again(system, q, v, t, h))?;
    let Begun { memory, control_memory, time, .. } = &mut begun;
    checkpoint.load(memory, |record| {
        control_memory.load(record)?;
        time.load(record)?;
        let is_length = C::ONE_LENGTH || (time.h == h && h != T::lift(0.0));
        if time.after(statistics.steps).time() != t || !is_length {
            return Err(CheckpointError::Damaged);
        }
        if time.h != h {
            // No steps have been taken with this one.
            *time = Time::new(t, h, statistics.steps);
        }
        Ok(())
    })?;
    Ok(Begun { statistics, ..begun })
}
