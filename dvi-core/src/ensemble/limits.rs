//! What is watched of a member in each step: limits, at which it ends, and a section, whose crossings are
//! counted.

use std::boxed::Box;
use std::vec::Vec;

use super::settings::{AnyGrowth, Settings};
use crate::error::{CheckpointError, StartError, StepError, StepFailure};
use crate::methods::Method;
use crate::run::{Dense, Direction, Event, Integrator, Run, Watch};
use crate::{Lagrangian, System};

type RunOf<'a, S, M> = Integrator<&'a S, M>;
type EventOf<S> = Event<<S as System>::State<f64>, f64>;
/// A condition g(system, state, t).
pub(super) type Condition<'a, S> =
    Box<dyn Fn(&S, &<S as System>::State<f64>, f64) -> f64 + Send + Sync + 'a>;
/// The same on the system of one member.
type OnSystem<'s, S> = Box<dyn FnMut(f64, &<S as System>::State<f64>) -> [f64; 1] + 's>;

/// An event at which a member ends, and why.
pub(super) type Exit<S> = (EventOf<S>, &'static str);

/// Parts of a step that differ by no more than this are one: of limits that are met at once the first
/// counts.
const TOGETHER: f64 = 16.0 * f64::EPSILON;

/// What is known of limits and section, for a run that goes on.
pub(super) type Saved = Vec<Vec<f64>>;

/// A run that is watched in each step.
pub(super) struct WatchedRun<'s, 'a, S: Lagrangian, M: Method<S, f64>> {
    run: Dense<RunOf<'a, S, M>>,
    limits: &'s [(&'static str, Condition<'a, S>)],
    /// Those of the limits, and behind them that of the section if there is one.
    watches: Vec<Watch<RunOf<'a, S, M>, OnSystem<'s, S>, 1>>,
}

impl<'s, 'a, S: Lagrangian, M: Method<S, f64>> WatchedRun<'s, 'a, S, M> {
    /// From where a run of `system` is on, or as one was watched that was interrupted there.
    ///
    /// # Errors
    /// As [`Watch::new`]; [`CheckpointError::Damaged`].
    pub(super) fn new(
        Settings { limits, section, .. }: &'s Settings<'a, S, M>,
        system: &'a S,
        run: RunOf<'a, S, M>,
        saved: Option<&Saved>,
    ) -> Result<Self, StartError> {
        let mut run = Dense::new(run)?;
        let limits = &limits[..];
        let conditions = limits.iter().map(|(_, g)| (Direction::Rising, g));
        let conditions = conditions.chain(section.iter().map(|(direction, g)| (*direction, g)));
        let watch = |(direction, g): (Direction, &'s Condition<'a, S>)| {
            let g: OnSystem<'s, S> = Box::new(move |t, state| [g(system, state, t)]);
            Watch::new(&mut run, [direction], g)
        };
        let mut watches = conditions.map(watch).collect::<Result<Vec<_>, _>>()?;
        if let Some(saved) = saved {
            let are_as_many = saved.len() == watches.len();
            let loaded = watches.iter_mut().zip(saved).try_for_each(|(watch, saved)| watch.load(saved));
            loaded.filter(|()| are_as_many).ok_or(CheckpointError::Damaged)?;
        }
        Ok(Self { run, limits, watches })
    }

    pub(super) fn run(&self) -> &RunOf<'a, S, M> {
        &self.run
    }

    /// Takes `count` steps, up to a limit, and counts the crossings of the section up to there.
    ///
    /// # Errors
    /// As [`Watch::search`], and those of the growth.
    pub(super) fn take_steps(
        &mut self,
        growth: &mut Option<AnyGrowth<'a, S, M>>,
        count: u64,
        crossings: &mut u64,
    ) -> Result<Option<Exit<S>>, StepError> {
        let Self { run, limits, watches } = self;
        let (of_limits, of_section) = watches.split_at_mut(limits.len());
        for _ in 0..count {
            run.advance_by(|run| match growth {
                Some(growth) => growth.take_steps(run, 1),
                None => run.advance(),
            })?;
            let (mut exit, mut end) = (None, run.time());
            for (number, (watch, (reason, _))) in of_limits.iter_mut().zip(*limits).enumerate() {
                watch.search(run).map_err(|error| numbered(error, number))?;
                let first = watch.next_until(run, end)?;
                let is_earlier = |event: &EventOf<S>| (end - event.time) / run.step_size() > TOGETHER;
                if let Some(event) = first.filter(|event| exit.is_none() || is_earlier(event)) {
                    (end, exit) = (event.time, Some((event, *reason)));
                }
            }
            for section in of_section.iter_mut() {
                section.search(run)?;
                while section.next_until(run, end)?.is_some() {
                    *crossings += 1;
                }
            }
            if exit.is_some() {
                return Ok(exit);
            }
        }
        Ok(None)
    }

    pub(super) fn save(&self) -> Saved {
        self.watches.iter().map(Watch::save).collect()
    }
}

/// An error that counts the condition as one of the limits.
fn numbered(mut error: StepError, number: usize) -> StepError {
    if let StepFailure::UndefinedEvent { event } = &mut error.failure {
        *event = number;
    }
    error
}

/// Of the first step, what tells where a limit leads that is zero at the start.
const SOON: f64 = 1e-5;

impl<'a, S: Lagrangian, M: Method<S, f64> + Clone> Settings<'a, S, M> {
    /// The limit beyond which a run begins, or which it leaves outwards, if there is one.
    ///
    /// # Errors
    /// Those of a run that begins, with a short step, where this one does.
    pub(super) fn beyond(
        &self,
        system: &'a S,
        number: u64,
        run: &RunOf<'a, S, M>,
    ) -> Result<Option<Exit<S>>, StartError> {
        for (index, (reason, g)) in self.limits.iter().enumerate() {
            let value = |run: &RunOf<'a, S, M>| g(system, &run.state(), run.time());
            let mut here = value(run);
            if here == 0.0 {
                let (method, h) = (self.method(number), SOON * self.h);
                let mut soon = Integrator::new_at(system, method, run.time(), h, run.state())?;
                soon.advance().map_err(|error| StartError::Starter(error.failure))?;
                here = value(&soon);
            }
            if here > 0.0 {
                return Ok(Some((Event { index, time: run.time(), state: run.state() }, reason)));
            }
        }
        Ok(None)
    }
}
