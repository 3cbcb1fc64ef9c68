//! A run in the hands of its step control.

use core::fmt;

use crate::error::{StartError, StepFailure};
use crate::method::{Carries, VariableStep};
use crate::norm::reported;
use crate::run::Run;
use crate::{Lagrangian, Real, Vector};

/// A run as its [`StepControl`](super::StepControl) sees it: a point that can be moved on and, if the control
/// [rejects](super::StepControl::REJECTS) steps, back.
pub struct ControlledRun<'a, S: Lagrangian, M: Carries<S, T>, T: Real> {
    pub(super) run: Run<'a, S, M, T>,
    /// What can be gone back to.
    checkpoint: Option<(M::Memory, Vector<S, T>)>,
}

impl<'a, S: Lagrangian, M: VariableStep<S, T>, T: Real> ControlledRun<'a, S, M, T> {
    pub(super) fn new(
        system: &'a S,
        method: M,
        q: Vector<S, T>,
        v: &[T],
        [t, h]: [T; 2],
        rejects: bool,
    ) -> Result<Self, StartError> {
        let begin = || method.begin(system, &q, v, t, h);
        let memory = begin()?;
        let checkpoint = rejects.then(begin).transpose()?.map(|memory| (memory, q.clone()));
        Ok(Self { run: Run::new(system, method, memory, q), checkpoint })
    }

    /// The system.
    pub fn system(&self) -> &'a S {
        self.run.system
    }

    /// The current coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.run.q
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`; degenerate systems have
    /// none, and `v` stays as it is.
    ///
    /// # Errors
    /// As [`Method::velocity`](crate::Method::velocity).
    #[inline]
    pub fn velocity(&self, t: T, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.run.velocity(t, v)
    }

    /// Takes a step from time `t` to `t + h`, without allocation.
    ///
    /// # Errors
    /// [`StepFailure::StepLength`] if `h` is not finite or `t + h` is `t`; else as
    /// [`Method::step`](crate::Method::step). Nothing has moved then.
    #[inline]
    pub fn step(&mut self, t: T, h: T) -> Result<(), StepFailure> {
        if !h.is_finite() || t + h == t {
            return Err(StepFailure::StepLength { h: reported(h) });
        }
        let Run { system, method, memory, q, statistics, .. } = &mut self.run;
        method.step(system, memory, q, t, h, statistics)
    }

    /// Keeps the present point, to [go back](Self::go_back) to it. Nothing happens if the control does not
    /// reject steps.
    pub fn keep(&mut self) {
        if let Some((memory, q)) = &mut self.checkpoint {
            self.run.method.restore(&self.run.memory, memory);
            q.copy_from_slice(&self.run.q);
        }
    }

    /// Goes back to the point that was kept, without allocation.
    pub fn go_back(&mut self) {
        if let Some((memory, q)) = &self.checkpoint {
            self.run.method.restore(memory, &mut self.run.memory);
            self.run.q.copy_from_slice(q);
        }
    }
}

impl<S: Lagrangian, M: VariableStep<S, T> + fmt::Debug, T: Real> fmt::Debug for ControlledRun<'_, S, M, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ControlledRun")
            .field("system", &S::REPORT.system)
            .field("method", &self.run.method)
            .field("q", &self.run.q)
            .finish_non_exhaustive()
    }
}
