//! The frequency at one end of a step, and its gradient.

use super::{Frequency, defined};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::scalar::norm;
use crate::{NondegenerateLagrangian, Real, Space, System, Vector, Weights};

/// ω and its gradient at one end of a step.
#[derive(Debug)]
pub(crate) struct Local<S: System, T: Real> {
    pub(crate) omega: T,
    /// ∂ω/∂q, acceleration included.
    pub(crate) dq: Vector<S, T>,
    /// ∂ω/∂v.
    pub(crate) dv: Vector<S, T>,
    acceleration: Vector<S, T>,
    da: Vector<S, T>,
    l: [Vector<S, T>; 2],
}

impl<S: NondegenerateLagrangian<T>, T: Real> Local<S, T> {
    pub(crate) fn new(system: &S) -> Self {
        let space = system.space();
        let [dq, dv, acceleration, da] = space.vectors();
        Self { omega: T::lift(0.0), dq, dv, acceleration, da, l: space.vectors() }
    }

    /// ω at (`q`, `v`), where the force is `force`. Whether that is a number the coefficients for it say.
    #[inline]
    pub(crate) fn evaluate<F: Frequency>(
        &mut self,
        frequency: &F,
        mass: &Mass<S, T>,
        q: &[T],
        v: &[T],
        force: &[T],
    ) {
        mass.solve(force, &mut self.acceleration);
        self.omega = frequency.at(q, v, &self.acceleration);
    }

    /// ω and its gradient at (`q`, `v`): da = M⁻¹∂²L/∂q∂q dq.
    pub(crate) fn differentiate<F: Frequency>(
        &mut self,
        frequency: &F,
        mass: &Mass<S, T>,
        system: &S,
        q: &[T],
        v: &[T],
        t: T,
    ) -> Result<(), StepFailure> {
        let Self { acceleration, dq, dv, da, l: [l_q, l_v], .. } = self;
        system.gradient(q, v, t, l_q, l_v);
        mass.solve(l_q, acceleration);
        // Refused at the start if there are none.
        let Some(omega) = frequency.derivatives([q, v, acceleration], [dq, dv, da]) else {
            return Err(StepFailure::Frequency { omega: f64::NAN });
        };
        self.omega = omega;
        mass.solve(da, acceleration);
        let mut product = |i: usize, j: usize, entry: T| dq[j] += entry * acceleration[i];
        let weights = Weights { qq: T::lift(1.0), ..Weights::none() };
        system.linearize(q, v, t, weights, l_q, l_v, &mut product);
        defined(self.omega)?;
        norm::finite(&self.dq)
    }
}
