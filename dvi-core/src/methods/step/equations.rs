//! What a scheme says of its step: r, its derivative, and s, and of a separable L the kinetic part of both
//! apart.

use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::PhasePoint;
use crate::scalar::simd::apart_if;
use crate::space::Sink;
use crate::state::Statistics;
use crate::{Lagrangian, NondegenerateLagrangian, Real, Space, System};

/// Where a step begins.
#[derive(Debug)]
pub struct Begin<'a, S: System, T: Real> {
    pub(in crate::methods) system: &'a S,
    pub(in crate::methods) interval: Interval<T>,
    pub(in crate::methods) q: &'a [T],
    pub(in crate::methods) phase: &'a PhasePoint<S, T>,
    pub(in crate::methods) mass: &'a Mass<S, T>,
}

/// Which ends of a step something belongs to.
#[derive(Clone, Copy)]
pub(in crate::methods) enum Share<'a, T> {
    /// The left one: r.
    Left,
    /// Both: s. If L is separable, F(q1) comes along.
    Both { force: &'a [T] },
}

/// The kinetic part of r and s, of a separable L.
#[derive(Clone, Copy, Debug)]
pub(in crate::methods) struct Kinetic<T> {
    /// K
    pub(in crate::methods) mixed: T,
    /// A − K
    pub(in crate::methods) left: T,
    /// C − K
    pub(in crate::methods) right: T,
    /// 1/κ, where −(κ/h)M is about ∂r/∂Δ.
    pub(in crate::methods) per_stiffness: T,
}

impl<T: Real> Kinetic<T> {
    /// That of the mean velocity Δ/h.
    #[inline]
    pub(in crate::methods) fn of_mean_velocity() -> Self {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        Self { mixed: one, left: zero, right: zero, per_stiffness: one }
    }
}

/// What a scheme says of its step. A node is storage.
pub(in crate::methods) trait Equations<S: Lagrangian<T>, T: Real> {
    /// Whether the kinetic part is another than that of the mean velocity.
    const FITTED: bool = false;
    /// Whether it depends on the direction of Δ, so that Δ = 0 is no guess.
    const READS_VELOCITY: bool = false;
    /// What evaluations may change. It is a value of the step, which no other function sees.
    type Coefficients;

    /// The coefficients, as far as the start of the step decides them.
    ///
    /// # Errors
    /// Those of a frequency.
    fn begin(
        &mut self,
        begin: &Begin<'_, S, T>,
        node: &mut NodeWork<S, T>,
    ) -> Result<Self::Coefficients, StepFailure>;

    /// Adds r or s to `to`, but for the [kinetic](Self::kinetic) part if L is separable.
    ///
    /// # Errors
    /// Those of a frequency that is read.
    fn evaluate(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        share: Share<'_, T>,
        work: (&mut Self::Coefficients, &mut NodeWork<S, T>),
        to: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;

    /// Adds all of r to `r`, and ∂r/∂Δ to `sink`.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate).
    fn linearize<K: Sink<T>>(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        work: (&mut Self::Coefficients, &mut NodeWork<S, T>),
        r: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;

    /// The kinetic part.
    #[inline]
    fn kinetic(&self, _coefficients: &Self::Coefficients) -> Kinetic<T> {
        Kinetic::of_mean_velocity()
    }

    /// Whether r is linear in Δ, with −(κ/h)M as its derivative, if L is separable.
    #[inline]
    fn is_explicit(&self) -> bool {
        false
    }

    /// Whether the force at an end of a step is asked for, if L is separable.
    #[inline]
    fn asks_ends(&self) -> bool {
        true
    }
}

/// Sets `force` to that at a point at time `t`.
#[inline]
pub(in crate::methods) fn set_force<S: NondegenerateLagrangian<T>, T: Real>(
    system: &S,
    point: &[T],
    t: T,
    force: &mut [T],
) {
    apart_if(!<S::Space as Space>::ON_STACK, || system.force(point, &[], t, force));
}
