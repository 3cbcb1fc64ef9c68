//! What a run with impacts carries from step to step.

use core::ops::Deref;

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::Multipliers;
use crate::memory::{Memory, lasting};
use crate::methods::before::Before;
use crate::scalar::norm::reported;
use crate::{ConstrainedSystem, Real, Scalar, Space, State, System, UnilateralLagrangian, Vector};

/// How many impacts a step may have.
pub(super) const MOST: usize = 16;

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
    /// The velocity after it, flat, in the order of declaration.
    pub v: V,
}

impl<V: Deref<Target = [T]>, T: Real> Impact<V, T> {
    /// The state after it.
    pub fn state<S: System>(&self, system: &S) -> S::State<T> {
        S::State::read(|block| system.block_len(block), &self.q, &self.v)
    }
}

/// A run with impacts: the memory of its method, the impacts of its last step, and work space.
#[derive(Debug)]
pub struct ImpactsMemory<S: ConstrainedSystem, I, T: Real> {
    /// At the present point, or at the end of the flight at hand.
    pub(super) inner: I,
    /// Where the step at hand began, if it has been divided.
    pub(super) before: Before<I, Vector<S, T>>,
    /// Where the flight at hand begins, before the jump of the momentum there.
    pub(super) start: Before<I, Vector<S, T>>,
    /// Gaps at the beginning and at the end of the flight at hand; behind the jump, where there is one.
    pub(super) here: Gaps<S, T>,
    pub(super) there: Gaps<S, T>,
    /// Storage for gaps that are not asked for.
    pub(super) row: Multipliers<S, T>,
    pub(super) wall: Wall<S, T>,
    pub(super) events: [Impact<Vector<S, T>, T>; MOST],
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

/// The gap functions at a point, and their rates of change there.
#[derive(Debug)]
pub(super) struct Gaps<S: ConstrainedSystem, T: Real> {
    pub(super) gap: Multipliers<S, T>,
    pub(super) rate: Multipliers<S, T>,
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

impl<S: UnilateralLagrangian<T>, T: Real> Gaps<S, T> {
    fn new(system: &S) -> Self {
        Self { gap: system.multipliers().vector(), rate: system.multipliers().vector() }
    }

    /// Evaluates them.
    ///
    /// # Errors
    /// [`StepFailure::Gap`].
    pub(super) fn look(&mut self, system: &S, q: &[T], v: &[T], t: T) -> Result<(), StepFailure> {
        system.gap(q, t, &mut self.gap);
        system.gap_rate(q, v, t, &mut self.rate);
        let values = self.gap.iter().zip(self.rate.iter()).enumerate();
        for (surface, (&gap, &rate)) in values {
            // Where a gap is closed it is not asked for the rate, which may have none behind the surface.
            if !gap.is_finite() || (gap >= T::lift(0.0) && !rate.is_finite()) {
                let value = reported(if gap.is_finite() { rate } else { gap });
                return Err(StepFailure::Gap { surface, value });
            }
        }
        Ok(())
    }
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
            let [q, v] = system.space().vectors();
            Impact { surface: 0, time: T::lift(0.0), impulse: T::lift(0.0), q, v }
        };
        let mut point = || inner().map(|inner| Before { inner, q: q.clone() });
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

    /// The impacts of the last step, in the order of the run. None behind a checkpoint.
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

impl<S: ConstrainedSystem, I: Memory<T>, T: Real> Memory<T> for ImpactsMemory<S, I, T> {
    lasting!(T; part inner, count total, count grazing);
}

/// Sets `gap` to the gaps at (`q`, `t`), and hands over the terms of |∂g/∂q|(|q| + |h v|), each with the
/// number of its surface. Rounding errors of the coordinates, and of their changes in a step of length `h`,
/// are errors of the gap of that size.
pub(super) fn terms<S: UnilateralLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    [t, h]: [T; 2],
    gap: &mut [T],
    mut add: impl FnMut(usize, T),
) {
    let mut sizes = |surface: usize, j: usize, entry: T| {
        add(surface, Scalar::abs(entry) * (Scalar::abs(q[j]) + Scalar::abs(h * v[j])));
    };
    system.gap_jacobian(q, t, gap, &mut sizes);
}

/// A start may be beyond a surface by so many rounding errors.
const ROUNDINGS: f64 = 1e4;

/// Whether a run with steps of length `h` can begin at (`q`, `v`, `t`).
///
/// # Errors
/// [`StartError::Beyond`] with the first surface that it is beyond; [`StartError::Starter`] where a gap is
/// no number.
pub(super) fn admit<S: UnilateralLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    h: T,
) -> Result<(), StartError> {
    let [mut gap, mut size]: [Multipliers<S, T>; 2] = system.multipliers().vectors();
    terms(system, [q, v], [t, h], &mut gap, |surface, term| size[surface] += term);
    let rounding = T::lift(ROUNDINGS) * T::default_epsilon();
    for (surface, (&gap, &size)) in gap.iter().zip(size.iter()).enumerate() {
        if !gap.is_finite() {
            return Err(StartError::Starter(StepFailure::Gap { surface, value: reported(gap) }));
        }
        if gap < -rounding * size {
            return Err(StartError::Beyond { surface, gap: reported(gap) });
        }
    }
    Ok(())
}
