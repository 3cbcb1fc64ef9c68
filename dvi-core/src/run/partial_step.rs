//! The state between two points of a run: the step from one to the other, taken again in part, by the run's
//! own method.
//!
//! So a state in between has the error of the run at the point before it and that of one step more, whatever
//! the length of that step. The run does not notice: what is moved is a copy.

use crate::error::{StartError, StepFailure};
use crate::memory::Memory;
use crate::methods::{Carries, Method};
use crate::run::Run;
use crate::state::Statistics;
use crate::system::start::velocities;
use crate::{Lagrangian, Real, Space, State, System, Vector};

/// A step of a run, from where it began to any time within it.
pub(crate) struct PartialStep<S: System, M: Carries<S, T>, T: Real> {
    begun: Point<S, M, T>,
    /// Where a part of the step leads.
    reached: Point<S, M, T>,
    v: Vector<S, T>,
}

struct Point<S: System, M: Carries<S, T>, T: Real> {
    t: T,
    q: Vector<S, T>,
    memory: M::Memory,
}

/// A step of a run `R`, in part.
pub(crate) type PartialStepOf<R> = PartialStep<<R as Run>::System, <R as Run>::Method, <R as Run>::Scalar>;

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> PartialStep<S, M, T> {
    /// For the next step of `run`. All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin where this one is.
    pub(crate) fn new<R: Run<System = S, Method = M, Scalar = T>>(run: &R) -> Result<Self, StartError> {
        let (stepper, t, h) = (run.stepper(), run.time(), run.step_size());
        let (system, q) = (run.system(), &stepper.q);
        let mut v = system.space().vector();
        stepper.velocity(system, t, &mut v).map_err(StartError::Starter)?;
        let point = || {
            let mut memory = stepper.method.begin_again(system, q, &v[..velocities(system)], t, h)?;
            memory.restore(&stepper.memory);
            Ok::<_, StartError>(Point { t, q: q.clone(), memory })
        };
        Ok(Self { begun: point()?, reached: point()?, v })
    }

    /// Says that the next step of `run` begins.
    pub(crate) fn begin<R: Run<System = S, Method = M, Scalar = T>>(&mut self, run: &R) {
        let Point { t, q, memory } = &mut self.begun;
        *t = run.time();
        q.copy_from_slice(run.q());
        memory.restore(run.memory());
    }

    /// Parts of a step that are nearer to one another are the same but for rounding.
    pub(crate) fn resolution() -> T {
        T::lift(4.0) * T::default_epsilon()
    }

    /// Moves to a `part`, from 0 to 1, of the step that `run` has taken since.
    ///
    /// # Errors
    /// As [`Method::step`].
    pub(crate) fn reach<R>(&mut self, run: &R, part: T) -> Result<(), StepFailure>
    where
        R: Run<System = S, Method = M, Scalar = T>,
    {
        let Self { begun, reached: Point { t, q, memory }, .. } = self;
        let whole = run.step_size();
        let h = part * whole;
        *t = begun.t + h;
        q.copy_from_slice(&begun.q);
        memory.restore(&begun.memory);
        if part <= Self::resolution() {
            return Ok(());
        }
        let unused = &mut Statistics::default();
        run.method().part_of_step(run.system(), memory, q, begun.t, [h, whole], unused)
    }

    /// Goes on from the `part` that has been reached to the end of the step. That it is not where `run` is
    /// tells the error of both.
    ///
    /// # Errors
    /// As [`Method::step`].
    pub(crate) fn go_on<R>(&mut self, run: &R, part: T) -> Result<(), StepFailure>
    where
        R: Run<System = S, Method = M, Scalar = T>,
    {
        let Point { t, q, memory } = &mut self.reached;
        let (whole, unused) = (run.step_size(), &mut Statistics::default());
        let [before, rest] = [part * whole, (T::lift(1.0) - part) * whole];
        run.method().part_of_step(run.system(), memory, q, *t, [rest, before], unused)?;
        *t += rest;
        Ok(())
    }

    /// The coordinates that have been reached.
    pub(crate) fn q(&self) -> &[T] {
        &self.reached.q
    }

    /// The time when the step began.
    pub(crate) fn begun(&self) -> T {
        self.begun.t
    }

    /// The time and the state that have been reached.
    ///
    /// # Errors
    /// As [`Method::velocity`].
    pub(crate) fn state<R>(&mut self, run: &R) -> Result<(T, S::State<T>), StepFailure>
    where
        R: Run<System = S, Method = M, Scalar = T>,
    {
        let (system, Point { t, q, memory }) = (run.system(), &self.reached);
        run.method().velocity(system, memory, q, *t, &mut self.v)?;
        Ok((*t, State::read(|block| system.block_len(block), q, &self.v)))
    }
}
