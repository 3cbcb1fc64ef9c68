//! Reinitialisation: the parasitic part is taken from the state of a run, which then goes on along a smooth orbit.
//!
//! (q, c) ↦ (q − a, Φ(q − a)) at the same time, where a is what alternates in q and c = Φ(q) the smooth orbits. It is done
//! before a step, and belongs to it: if the step fails, so that the run stays, the state is what it was.

use super::leapfrog;
use super::memory::{SigmaMemory, TwoStep};
use super::smooth::Smoothing;
use super::{Sigma, Step};
use crate::error::{StartError, StepFailure};
use crate::methods::Clock;
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{DegenerateLagrangian, Real, System, Vector};

/// When the parasitic part is taken from the state of a run of [`Sigma`](super::Sigma).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Reinitialisation {
    /// The run goes on as the two-step map takes it.
    #[default]
    Never,
    /// Before each step whose number, counted from zero, is a positive multiple of this.
    Every(u64),
    /// Where the measured [relative size](super::ParasiticMode::relative) of the mode has passed this threshold, which is below
    /// [`Sigma::parasitic_limit`](super::Sigma::parasitic_limit). It is judged as the limit is, and when the limit is.
    Above(f64),
}

impl Reinitialisation {
    pub(super) fn threshold(self) -> Option<f64> {
        match self {
            Self::Above(threshold) => Some(threshold),
            Self::Never | Self::Every(_) => None,
        }
    }

    pub(super) fn validate(self, limit: Option<f64>) -> Result<(), StartError> {
        let (value, range) = match self {
            Self::Every(0) => (0.0, "at least 1 step"),
            Self::Above(value) if !(value > 0.0 && value < limit.unwrap_or(f64::INFINITY)) => {
                (value, "positive, and below parasitic_limit")
            }
            Self::Never | Self::Every(_) | Self::Above(_) => return Ok(()),
        };
        Err(StartError::Parameter { name: "reinitialisation", value, range })
    }

    /// Whether it is time before the step with this number.
    fn is_due(self, step: u64) -> bool {
        matches!(self, Self::Every(period) if step > 0 && step.is_multiple_of(period))
    }

    /// How many of `count` steps from this one on, at least one, can be taken until it is time.
    fn until_due(self, step: u64, count: u64) -> u64 {
        match self {
            Self::Every(period) => count.min(period - step % period),
            Self::Never | Self::Above(_) => count,
        }
    }
}

/// Where something is kept that is twice as large as the memory of a run, and that most runs do not have.
#[cfg(feature = "alloc")]
pub(super) type Aside<R> = alloc::boxed::Box<R>;
#[cfg(not(feature = "alloc"))]
pub(super) type Aside<R> = R;

/// What reinitialises a run, and how often it has.
#[derive(Debug)]
pub(super) struct Renewal<S: System, T: Real> {
    smoothing: Smoothing<S, T>,
    pub(super) count: u64,
}

impl<S: System, T: Real> Memory<T> for Renewal<S, T> {
    lasting!(T; count count);
}

impl<S: DegenerateLagrangian<T>, T: Real> Renewal<S, T> {
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn new(smoothing: Smoothing<S, T>) -> Aside<Self> {
        Self { smoothing, count: 0 }.into()
    }

    /// Moves the state to a smooth orbit; it stays as it was if there is an error.
    fn renew(
        &mut self,
        step: &Step<'_, S, T>,
        run: &mut TwoStep<S, T>,
        q: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { smoothing, count } = self;
        smoothing.smooth(step.system, [q, &run.defect], step.t, statistics)?;
        smoothing.keep(run, q);
        q.copy_from_slice(&smoothing.q);
        run.set_out(step, [&smoothing.q, &smoothing.defect, &smoothing.velocity]);
        run.monitor.restart();
        *count += 1;
        Ok(())
    }

    /// Undoes the last.
    fn undo(&mut self, run: &mut TwoStep<S, T>, q: &mut Vector<S, T>) {
        self.smoothing.take_back(run, q);
        self.count -= 1;
    }
}

/// Takes `count` steps, or as many as succeed, and returns how many; with reinitialisations where it is time.
#[cold]
#[inline(never)]
pub(super) fn steps<S: DegenerateLagrangian<T>, T: Real>(
    method: &Sigma<T>,
    system: &S,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
    statistics: &mut Statistics,
) -> (u64, Result<(), StepFailure>) {
    let SigmaMemory { run, renewal: Some(renewal) } = memory else { return (0, Ok(())) };
    let (schedule, mut taken) = (method.reinitialisation, 0);
    // Whether the monitor asks for it, and whether it has been done at the present point.
    let (mut is_asked, mut is_done) = (false, false);
    while taken < count {
        let (clock, number) = (clock.after(taken), run.monitor.steps);
        let step = Step { system, method, t: clock.time(), h: clock.step_size() };
        if !is_done && !run.defect_vanishes && (is_asked || schedule.is_due(number)) {
            if let Err(failure) = renewal.renew(&step, run, q, statistics) {
                return (taken, Err(failure));
            }
            is_done = true;
        }
        is_asked = false;
        let wanted = schedule.until_due(number, count - taken);
        let (walked, result) = some_steps(&step, run, q, clock, wanted, statistics);
        taken += walked;
        is_done &= walked == 0;
        match result {
            Ok(()) => {}
            Err(StepFailure::ParasiticMode { limit, .. })
                if !is_done && schedule.threshold() == Some(limit) =>
            {
                is_asked = true;
            }
            Err(failure) => {
                if is_done {
                    renewal.undo(run, q);
                }
                return (taken, Err(failure));
            }
        }
    }
    (taken, Ok(()))
}

/// Takes at least one and at most `count` steps, and returns how many.
fn some_steps<S: DegenerateLagrangian<T>, T: Real>(
    step: &Step<'_, S, T>,
    run: &mut TwoStep<S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
    statistics: &mut Statistics,
) -> (u64, Result<(), StepFailure>) {
    if S::AFFINE && step.method.sigma == T::lift(0.0) {
        let (taken, result) = leapfrog::steps(step.system, run, q, clock, count);
        statistics.gradients += taken;
        return (taken, result);
    }
    match run.step(step, q, statistics) {
        Ok(()) => (1, Ok(())),
        Err(failure) => (0, Err(failure)),
    }
}
