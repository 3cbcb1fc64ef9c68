//! The last step of a run, taken again in part, whatever its method is.

use crate::error::{StartError, StepFailure};
use crate::memory::{Aside, Memory};
use crate::methods::{Carries, Clock, Here, Method, Step, Steps};
use crate::run::Stepper;
use crate::run::kept::Kept;
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::system::start::velocities;
use crate::{Lagrangian, Real, System, Vector};

/// What a run of any method does for [`Dense`](crate::run::Dense): it keeps the point at which steps begin,
/// and a copy of it is moved within the last one.
pub trait Between<S: System, T: Real> {
    /// Makes room, and keeps the present point, which is reached at time `t`. All memory is allocated here.
    /// Returns the number of places within a step that are known when it has been taken.
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin here.
    fn begin(&mut self, system: &S, t: T, h: T) -> Result<usize, StartError>;

    /// Keeps the present point.
    fn keep(&mut self);

    /// Moves the point that is kept by `count` steps from the present time of `clock`.
    ///
    /// # Errors
    /// As [`Method::steps`].
    fn settle(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure>;

    /// Moves from the point that is kept, at time `t`, by the first of two lengths, a part of a step of the
    /// second.
    ///
    /// # Errors
    /// As [`Method::step`]; [`StepFailure::LeftDomain`].
    fn reach(&mut self, system: &S, t: T, lengths: [T; 2]) -> Result<(), StepFailure>;

    /// The coordinates that have been reached, at time `t`; their velocities are written to `v`.
    ///
    /// # Errors
    /// As [`Method::velocity`].
    fn reached(&self, system: &S, t: T, v: &mut Vector<S, T>) -> Result<&[T], StepFailure>;

    /// The coordinates at one of the places within the last step that are known, with the part of the step;
    /// their velocities are written to `v`.
    fn place(&mut self, index: usize, v: &mut Vector<S, T>) -> Option<(T, &[T])>;

    /// The same at the end of the step.
    ///
    /// # Errors
    /// As [`Method::velocity`].
    fn end(&self, system: &S, t: T, v: &mut Vector<S, T>) -> Result<&[T], StepFailure>;
}

/// Where steps at hand have begun, and where a part of the last one has led to.
pub(super) struct Points<S: System, M: Carries<S, T>, T: Real> {
    begun: Kept<S, M, T>,
    reached: Kept<S, M, T>,
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Between<S, T> for Stepper<S, M, T> {
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    fn begin(&mut self, system: &S, t: T, h: T) -> Result<usize, StartError> {
        let Self { method, memory, q, .. } = self;
        let mut v = q.clone();
        method.velocity(Here { system, q, t }, memory, &mut v).map_err(StartError::Starter)?;
        let point = || Kept::new(q, || method.begin_again(system, q, &v[..velocities(system)], t, h));
        self.points = Some(Aside::from(Points { begun: point()?, reached: point()? }));
        self.keep();
        Ok(self.method.places())
    }

    #[inline]
    fn keep(&mut self) {
        if let Some(points) = &mut self.points {
            points.begun.q.copy_from_slice(&self.q);
            points.begun.memory.restore(&self.memory);
        }
    }

    fn settle(&mut self, system: &S, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        let Self { method, points, .. } = self;
        let points = begun(points.as_mut(), clock.time())?;
        let Kept { q, memory } = &mut points.begun;
        let statistics = &mut Statistics::default();
        method.steps(Steps { system, q, clock, count, statistics }, memory)
    }

    fn reach(&mut self, system: &S, t: T, [h, whole]: [T; 2]) -> Result<(), StepFailure> {
        let Self { method, points, .. } = self;
        let points: &mut Points<S, M, T> = begun(points.as_mut(), t)?;
        let Points { begun, reached: Kept { q, memory } } = points;
        q.copy_from_slice(&begun.q);
        memory.restore(&begun.memory);
        if t + h == t {
            return Ok(());
        }
        let statistics = &mut Statistics::default();
        method.part_of_step(Step { system, q, t, h, statistics }, whole, memory)?;
        let leaves = S::HAS_DOMAIN && !reported(system.domain(q, t + h)).is_finite();
        if leaves { Err(StepFailure::LeftDomain) } else { Ok(()) }
    }

    fn reached(&self, system: &S, t: T, v: &mut Vector<S, T>) -> Result<&[T], StepFailure> {
        let points = begun(self.points.as_ref(), t)?;
        let Kept { q, memory } = &points.reached;
        self.method.velocity(Here { system, q, t }, memory, v)?;
        Ok(q)
    }

    fn place(&mut self, index: usize, v: &mut Vector<S, T>) -> Option<(T, &[T])> {
        let Self { method, memory, points, .. } = self;
        let points: &mut Points<S, M, T> = points.as_mut()?;
        let q = &mut points.reached.q;
        method.place(memory, index, q, v).map(|part| (part, &q[..]))
    }

    #[inline]
    fn end(&self, system: &S, t: T, v: &mut Vector<S, T>) -> Result<&[T], StepFailure> {
        self.velocity(system, t, v)?;
        Ok(&self.q)
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
