//! The flights between impacts, and their discrete energy.
//!
//! E_d = −∂L_d/∂h = Σⱼ wⱼ E(qʲ, Δ/h) with linear interpolation.

use super::Variational;
use crate::discrete::frequency::{Frequency, Unfitted};
use crate::discrete::quadrature::Rule;
use crate::discrete::{Ends, Span};
use crate::error::{StartError, StepFailure};
use crate::methods::{FreeFlight, Here, Step};
use crate::{NondegenerateLagrangian, Real, Vector};

impl<F: Frequency, R: Rule> Variational<F, R> {
    /// Σ wⱼ E(qʲ, Δ/h), the discrete energy with linear interpolation.
    pub(super) fn energy_of<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        Span { system, interval, ends: Ends { q0, delta } }: Span<'_, S, T>,
        [point, velocity]: &mut [Vector<S, T>; 2],
    ) -> T {
        let per_h = T::lift(1.0) / interval.h;
        for (velocity, &delta) in velocity.iter_mut().zip(delta) {
            *velocity = delta * per_h;
        }
        let nodes = self.rule.nodes().iter().zip(self.rule.weights());
        nodes.fold(T::lift(0.0), |sum, (&c, &weight)| {
            let c = T::lift(c);
            for (point, (&q0, &delta)) in point.iter_mut().zip(q0.iter().zip(delta)) {
                *point = q0 + c * delta;
            }
            sum + T::lift(weight) * system.energy(point, velocity, interval.time(c))
        })
    }
}

impl<S: NondegenerateLagrangian<T>, R: Rule, T: Real> FreeFlight<S, T> for Variational<Unfitted, R> {
    type Suited<X> = X;

    const HAS_ENERGY: bool = true;

    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.depart_from(system, (q, v, t), h)
    }
    fn fly(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        self.take(step, memory)
    }
    fn velocity_in_flight(
        &self,
        here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.carried.phase.jump(impulse, velocity);
    }
    fn energy_of_flight(&self, span: Span<'_, S, T>, work: &mut [Vector<S, T>; 2]) -> Option<T> {
        Some(self.energy_of(span, work))
    }
}
