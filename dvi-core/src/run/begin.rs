//! How runs begin: with steps of one length, or of those that a control chooses.

use super::begun::{Begun, BegunOf, begun, carried, point};
use super::{Integrator, Obeys, StepControl, Stepper};
use crate::error::StartError;
#[cfg(doc)]
use crate::methods::Sigma;
use crate::methods::{BeginsBetween, Carries, Suits, SuitsAnyStep};
use crate::system::StateOf;
use crate::system::start::{evaluate, flatten};
use crate::{Held, Lagrangian, Real};

impl<H: Held<System: Lagrangian<T>>, M: Carries<H::System, T>, T: Real> Integrator<H, M, T> {
    /// A run from `start` at time 0 with step `h`, which may be negative.
    ///
    /// # Errors
    /// [`StartError`] if a parameter array of the system or an array of the state has the wrong length,
    /// `h` is zero or not finite, a coordinate is not finite, an option of the method is out of range,
    /// the energy or a first derivative of L is not finite at the start ([`StartError::Undefined`]), or the
    /// starting values cannot be computed.
    pub fn new<X>(system: H, method: X, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        Self::new_at(system, method, T::lift(0.0), h, start)
    }

    /// A run from `start` at time `t`; else as [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`StartError::Parameter`] if `t` is not finite.
    pub fn new_at<X>(system: H, method: X, t: T, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let method = method.suited();
        let begun = begun(system.held(), X::steps(&method), &h, t, &start)?;
        Ok(Self::of(system, method, h, begun))
    }

    /// A run of [`Sigma`] that starts at `first`, time 0, and whose first step leads to `second`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_two_points<X>(
        system: H,
        method: X,
        h: T,
        first: StateOf<H, T>,
        second: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: BeginsBetween<H::System, T, M>,
    {
        let (held, t) = (system.held(), T::lift(0.0));
        let (at, [q1, rest]) = (point(held, t, &first)?, flatten(held, &second)?);
        evaluate(held, &q1, &rest, t + h)?;
        let begin = |q0: &_, _: &_, h| method.begin_between(held, q0, &q1, t, h);
        let begun = carried::<_, T, _, _>(held, at, t, |q, v| h.begin(held, q, v, t), begin)?;
        Ok(Self::of(system, method.suited(), h, begun))
    }
}

impl<H, M, T: Real, C> Integrator<H, M, T, C>
where
    H: Held<System: Lagrangian<T>>,
    M: Carries<H::System, T>,
    C: Carries<H::System, T>,
{
    /// A run from `start` at time 0 with steps that `control` chooses.
    ///
    /// # Errors
    /// As [`new`](Integrator::new), and [`StartError`] if an option of the control is out of range, or it
    /// does not go with the system or with the method.
    pub fn controlled<X, Y>(
        system: H,
        method: X,
        control: Y,
        start: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        Self::controlled_at(system, method, control, T::lift(0.0), start)
    }

    /// A run from `start` at time `t`; else as [`controlled`](Self::controlled).
    ///
    /// # Errors
    /// As [`controlled`](Self::controlled), and [`StartError::Parameter`] if `t` is not finite.
    pub fn controlled_at<X, Y>(
        system: H,
        method: X,
        control: Y,
        t: T,
        start: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (method, control) = (method.suited(), M::suited(control));
        let begun = begun(system.held(), X::steps(&method), M::lengths(&control), t, &start)?;
        Ok(Self::of(system, method, control, begun))
    }

    pub(super) fn of(system: H, method: M, control: C, begun: BegunOf<H::System, M::Memory, C, T>) -> Self {
        let Begun { q, memory, kept, control_memory, time, statistics } = begun;
        let stepper = Stepper { method, memory, q, statistics, failed: false, kept, points: None };
        Self { system, stepper, control, control_memory, time }
    }
}
