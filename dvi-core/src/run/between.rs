//! The last step of a run, taken again in part, whatever its method is.

use crate::error::{StartError, StepFailure};
use crate::methods::{Clock, Here, Kept, Method, Step, Steps};
use crate::run::Stepper;
use crate::run::stepper::PointOf;
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::system::start::velocities;
use crate::{Lagrangian, Real, Scalar, State, System, Vector};

/// What a run of any method does for [`Dense`](crate::run::Dense): it keeps the point at which steps begin,
/// and a copy of it is moved within the last one.
pub trait Between<S: System, T: Real> {
    /// Makes room, unless it is there already, and keeps the present point, which is reached at time `t`.
    /// All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin here.
    fn begin(&mut self, system: &S, t: T, h: T) -> Result<(), StartError>;

    /// Keeps the present point, where the next step may begin, beside that where the last one has begun.
    fn keep_next(&mut self);

    /// Says that the last step has begun at the point that was kept last.
    fn begin_there(&mut self);

    /// Moves the point that is kept by `count` steps from the present time of `clock`.
    ///
    /// # Errors
    /// As [`Method::steps`].
    fn settle(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure>;

    /// Moves from the point that is kept, at time `t`, by the first of two lengths, a part of a step of the
    /// second, to the coordinates that are returned; their velocities are written to `v`.
    ///
    /// # Errors
    /// As [`Method::step`] and [`Method::velocity`]; [`StepFailure::LeftDomain`].
    fn reach(&mut self, system: &S, t: T, lengths: [T; 2], v: &mut [T]) -> Result<&[T], StepFailure>;

    /// The coordinates at one of the places within the last step that are known, jumps of the velocity or
    /// others, with the part of the step; the velocities there are written to `v` as by [`Method::place`].
    fn place(&mut self, is_jump: bool, index: usize, v: [&mut Vector<S, T>; 2]) -> Option<(T, &[T])>;

    /// The coordinates, and their velocities in `v`, at the end of the step.
    ///
    /// # Errors
    /// As [`Method::velocity`].
    fn end(&self, system: &S, t: T, v: &mut [T]) -> Result<&[T], StepFailure>;
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Between<S, T> for Stepper<S, M, T> {
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    fn begin(&mut self, system: &S, t: T, h: T) -> Result<(), StartError> {
        let Self { method, memory, q, points, .. } = self;
        let mut v = q.clone();
        method.velocity(Here { system, q, t }, memory, &mut v).map_err(StartError::Starter)?;
        if points.is_none() {
            let point = || {
                let memory = method.begin_again(system, q, &v[..velocities(system)], t, h)?;
                Ok::<_, StartError>(Kept { q: q.clone(), memory }.into())
            };
            *points = Some([point()?, point()?, point()?]);
        }
        self.keep_next();
        self.begin_there();
        Ok(())
    }

    #[inline]
    fn keep_next(&mut self) {
        if let Some([_, next, _]) = &mut self.points {
            next.take(&self.q, &self.memory);
        }
    }

    #[inline]
    fn begin_there(&mut self) {
        if let Some(points) = &mut self.points {
            points.swap(0, 1);
        }
    }

    fn settle(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        let Self { method, points, .. } = self;
        let [begun, ..] = begun(points.as_mut(), clock.time())?;
        let Kept { q, memory }: &mut PointOf<S, M, T> = begun;
        let statistics = &mut Statistics::default();
        method.steps(Steps { system, q, clock, count, statistics }, memory)
    }

    fn reach(&mut self, system: &S, t: T, [h, whole]: [T; 2], v: &mut [T]) -> Result<&[T], StepFailure> {
        let Self { method, memory: taken, points, .. } = self;
        let [begun, _, reached] = begun(points.as_mut(), t)?;
        let reached: &mut PointOf<S, M, T> = reached;
        reached.take(&begun.q, &begun.memory);
        let (Kept { q, memory }, end) = (reached, t + h);
        // At a late time a part may lead on that does not move the time.
        if Scalar::abs(h) > T::default_epsilon() * Scalar::abs(whole) {
            let statistics = &mut Statistics::default();
            method.part_of_step(Step { system, q, t, h, statistics }, whole, memory, taken)?;
            if S::HAS_DOMAIN && !reported(system.domain(q, end)).is_finite() {
                return Err(StepFailure::LeftDomain);
            }
        }
        method.velocity(Here { system, q, t: end }, memory, v)?;
        Ok(q)
    }

    fn place(&mut self, is_jump: bool, index: usize, v: [&mut Vector<S, T>; 2]) -> Option<(T, &[T])> {
        let Self { method, memory, points, .. } = self;
        let [.., reached] = points.as_mut().filter(|_| M::HAS_JUMPS == is_jump)?;
        let q = &mut reached.q;
        method.place(memory, index, q, v).map(|part| (part, &q[..]))
    }

    #[inline]
    fn end(&self, system: &S, t: T, v: &mut [T]) -> Result<&[T], StepFailure> {
        self.velocity(system, t, v)?;
        Ok(&self.q)
    }
}

/// A state in flat form.
#[derive(Debug)]
pub struct Flat<'a, S, T> {
    pub(super) system: &'a S,
    pub(super) q: &'a [T],
    pub(super) v: &'a [T],
}

impl<S: System, T: Real> Flat<'_, S, T> {
    /// The state.
    pub(super) fn state(self) -> S::State<T> {
        S::State::read(&|block| self.system.block_len(block), self.q, self.v)
    }

    /// Writes it into another one, without allocation.
    pub(super) fn refill(self, state: &mut S::State<T>) {
        state.refill(&|block| self.system.block_len(block), self.q, self.v);
    }
}

/// The points at `t`, if [`Between::begin`] has made them.
///
/// # Errors
/// [`StepFailure::Unreachable`].
fn begun<P, T: Real>(points: Option<P>, t: T) -> Result<P, StepFailure> {
    let t = reported(t);
    points.ok_or(StepFailure::Unreachable { now: t, target: t })
}
