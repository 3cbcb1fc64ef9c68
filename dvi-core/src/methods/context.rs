//! What a run gives to its method: a step to take, steps to take and their times, a point to be asked about.

use crate::error::StepFailure;
use crate::methods::Method;
use crate::state::Statistics;
use crate::{Lagrangian, Real, System, Vector};

/// The times at which the steps of a run begin: start + k h, which does not accumulate rounding errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock<T> {
    pub(crate) start: T,
    pub(crate) h: T,
    pub(crate) step: u64,
}

impl<T: Real> Clock<T> {
    /// A clock that begins at time `start` and whose steps have the length `h`.
    pub fn new(start: T, h: T) -> Self {
        Self { start, h, step: 0 }
    }

    /// The clock after `steps` steps.
    #[must_use]
    pub fn after(self, steps: u64) -> Self {
        Self { step: self.step.wrapping_add(steps), ..self }
    }

    /// The present time.
    pub fn time(self) -> T {
        // Signed integers convert in one instruction; no run takes 2⁶³ steps.
        self.start + T::lift(self.step as i64 as f64) * self.h
    }

    /// The step h.
    pub fn step_size(self) -> T {
        self.h
    }
}

/// A step to take.
#[derive(Debug)]
pub struct Step<'a, S: System, T: Real> {
    /// The system.
    pub system: &'a S,
    /// Where the step begins; after it, where it ends.
    pub q: &'a mut Vector<S, T>,
    /// When it begins.
    pub t: T,
    /// Its length.
    pub h: T,
    /// What evaluations and iterations are counted in.
    pub statistics: &'a mut Statistics,
}

/// Steps to take, one after the other.
#[derive(Debug)]
pub struct Steps<'a, S: System, T: Real> {
    /// The system.
    pub system: &'a S,
    /// Where the first step begins; after them, where the last good one ends.
    pub q: &'a mut Vector<S, T>,
    /// When the first begins, and how long each is.
    pub clock: Clock<T>,
    /// How many there are.
    pub count: u64,
    /// What steps, evaluations and iterations are counted in.
    pub statistics: &'a mut Statistics,
}

/// A point that a run has come to.
#[derive(Clone, Copy, Debug)]
pub struct Here<'a, S: System, T: Real> {
    /// The system.
    pub system: &'a S,
    /// The coordinates.
    pub q: &'a Vector<S, T>,
    /// The time.
    pub t: T,
}

impl<S: Lagrangian<T>, T: Real> Steps<'_, S, T> {
    /// Takes each by [`Method::step`], up to the first failure, and counts them.
    ///
    /// # Errors
    /// That of the step that fails.
    #[inline]
    pub fn one_by_one<M: Method<S, T> + ?Sized>(
        self,
        method: &M,
        memory: &mut M::Memory,
    ) -> Result<(), StepFailure> {
        let Self { system, q, clock, count, statistics } = self;
        for taken in 0..count {
            let (t, h) = (clock.after(taken).time(), clock.step_size());
            method.step(Step { system, q, t, h, statistics }, memory)?;
            statistics.steps += 1;
        }
        Ok(())
    }
}
