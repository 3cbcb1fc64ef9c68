//! What a run with impacts carries from step to step.

use super::gaps::Gaps;
use crate::error::StartError;
use crate::mechanics::constraints::Multipliers;
use crate::memory::{Memory, lasting};
use crate::methods::{JUMPS, Kept};
use crate::{ConstrainedSystem, Real, Space, System, UnilateralLagrangian, Vector};

/// An impact of the last step, with vectors of type `V`.
#[derive(Clone, Debug)]
pub struct Impact<V, T> {
    /// The number of the surface, counted from 0 in the order of declaration.
    pub surface: usize,
    /// When it happened.
    pub time: T,
    /// λ, by which the momentum has jumped: p⁺ − p⁻ = λ ∂g/∂q. Positive in runs forward in time.
    pub impulse: T,
    /// The coordinates where it happened, flat, in the order of declaration.
    pub q: V,
    /// The velocity before it, flat, in the order of declaration.
    pub v_before: V,
    /// The velocity after it, flat, in the order of declaration.
    pub v: V,
    /// The part of the step before it.
    pub(super) part: T,
}

/// A run with impacts: the memory of its method, the impacts of its last step, and work space.
#[derive(Debug)]
pub struct ImpactsMemory<S: ConstrainedSystem, I, T: Real> {
    /// At the present point, or at the end of the flight at hand.
    pub(super) inner: I,
    /// Where the step at hand began, if it has been divided.
    pub(super) before: Kept<Vector<S, T>, I>,
    /// Where the flight at hand begins, before the jump of the momentum there.
    pub(super) start: Kept<Vector<S, T>, I>,
    /// Gaps at the beginning and at the end of the flight at hand; behind the jump, where there is one.
    pub(super) here: Gaps<S, T>,
    pub(super) there: Gaps<S, T>,
    /// Storage for gaps that are not asked for.
    pub(super) row: Multipliers<S, T>,
    pub(super) wall: Wall<S, T>,
    pub(super) events: [Impact<Vector<S, T>, T>; JUMPS],
    /// Those of the step before, while one is taken.
    pub(super) earlier: [Impact<Vector<S, T>, T>; JUMPS],
    /// Whether the step at hand has been divided.
    pub(super) is_divided: bool,
    /// How many of the events are those of the last step.
    pub(super) count: usize,
    /// How many impacts the run has had.
    pub(super) total: u64,
    /// How many of these were reflected because no impulse keeps the discrete energy.
    pub(super) grazing: u64,
    pub(super) v: Vector<S, T>,
    pub(super) impulse: Vector<S, T>,
    pub(super) delta: Vector<S, T>,
    pub(super) work: [Vector<S, T>; 2],
}

/// The surface that the flight at hand begins at, and what is known of the jump there.
#[derive(Debug)]
pub(super) struct Wall<S: System, T: Real> {
    /// ∂g/∂q
    pub(super) gradient: Vector<S, T>,
    /// ∂g/∂t
    pub(super) speed: T,
    /// M⁻¹∂g/∂q, and the velocity before the jump.
    pub(super) direction: Vector<S, T>,
    pub(super) v: Vector<S, T>,
    /// The impulse of a reflection, and the rate of change of the gap behind it.
    pub(super) reflection: T,
    pub(super) rate: T,
    /// The energy of the flight before.
    pub(super) energy: T,
    /// Σ|p v| and Σ|p q|, which say how the energy is rounded.
    pub(super) terms: [T; 2],
    /// The impulse that was found last.
    pub(super) impulse: T,
    /// Whether it is that of a reflection because no other keeps the discrete energy.
    pub(super) is_grazing: bool,
}

impl<S: UnilateralLagrangian<T>, T: Real> Wall<S, T> {
    fn new(system: &S) -> Self {
        let ([gradient, direction, v], zero) = (system.space().vectors(), T::lift(0.0));
        Self {
            gradient,
            speed: zero,
            direction,
            v,
            reflection: zero,
            rate: zero,
            energy: zero,
            terms: [zero; 2],
            impulse: zero,
            is_grazing: false,
        }
    }
}

impl<S: UnilateralLagrangian<T>, I, T: Real> ImpactsMemory<S, I, T> {
    pub(super) fn new(
        system: &S,
        q: &Vector<S, T>,
        mut inner: impl FnMut() -> Result<I, StartError>,
    ) -> Result<Self, StartError> {
        let event = || {
            let ([q, v_before, v], zero) = (system.space().vectors(), T::lift(0.0));
            Impact { surface: 0, time: zero, impulse: zero, q, v_before, v, part: zero }
        };
        let mut point = || inner().map(|inner| Kept { q: q.clone(), memory: inner });
        let [v, impulse, delta, l_q, l_v] = system.space().vectors();
        Ok(Self {
            before: point()?,
            start: point()?,
            inner: inner()?,
            here: Gaps::new(system),
            there: Gaps::new(system),
            row: system.multipliers().vector(),
            wall: Wall::new(system),
            events: core::array::from_fn(|_| event()),
            earlier: core::array::from_fn(|_| event()),
            is_divided: false,
            count: 0,
            total: 0,
            grazing: 0,
            v,
            impulse,
            delta,
            work: [l_q, l_v],
        })
    }
}

impl<S: ConstrainedSystem, I, T: Real> ImpactsMemory<S, I, T> {
    /// The memory of the method.
    pub fn inner(&self) -> &I {
        &self.inner
    }

    /// The impacts of the last good step, in the order of the run. None behind a checkpoint.
    pub fn impacts(&self) -> &[Impact<Vector<S, T>, T>] {
        &self.events[..self.count]
    }

    /// How many impacts the run has had.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// How many impacts were so grazing that no impulse keeps the discrete energy, and the energy at the
    /// point of impact was kept instead. Always zero with
    /// [`Collision::Reflection`](super::Collision::Reflection).
    pub fn grazing(&self) -> u64 {
        self.grazing
    }
}

lasting!([S: ConstrainedSystem, I: Memory<T>, T: Real] ImpactsMemory<S, I, T>, T;
    part inner, count total, count grazing);
