//! What is watched of a member in each step: limits, at which it ends, and a section, whose crossings are
//! counted.

use std::boxed::Box;
use std::vec::Vec;

use super::settings::{AnyGrowth, Settings};
use crate::error::{CheckpointError, StartError, StepError};
use crate::methods::Method;
use crate::run::{Dense, Direction, Event, Integrator, Run, Watch};
use crate::{Lagrangian, System};

type RunOf<'a, S, M> = Integrator<&'a S, M>;
type EventOf<S> = Event<<S as System>::State<f64>, f64>;
pub(super) type AnyWatch<'s, 'a, S, M> = Box<dyn Watched<'a, S, M> + 's>;

/// An event at which a member ends, and why.
pub(super) type Exit<S> = (EventOf<S>, &'static str);

/// Conditions g(system, state, t), each with the direction in which it is crossed.
pub(super) struct Given<G, const N: usize> {
    pub(super) directions: [Direction; N],
    pub(super) g: G,
}

/// Conditions for the members of an ensemble, all evaluated at once. It hides how many there are.
pub(super) trait Conditions<'a, S: Lagrangian, M: Method<S, f64>>: Send + Sync {
    /// Their values where a run is.
    fn values(&self, run: &RunOf<'a, S, M>) -> Vec<f64>;

    /// Watches a run of `system` from where it is on.
    ///
    /// # Errors
    /// As [`Watch::new`].
    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: &mut Dense<RunOf<'a, S, M>>,
    ) -> Result<AnyWatch<'s, 'a, S, M>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's;
}

/// A [`Watch`].
pub(super) trait Watched<'a, S: Lagrangian, M: Method<S, f64>> {
    fn search(&mut self, run: &mut Dense<RunOf<'a, S, M>>) -> Result<(), StepError>;
    fn next(&mut self, run: &mut Dense<RunOf<'a, S, M>>, t: f64) -> Result<Option<EventOf<S>>, StepError>;
    fn save(&self) -> Vec<f64>;
    fn load(&mut self, saved: &[f64]) -> Option<()>;
}

impl<'a, S: Lagrangian, M: Method<S, f64>, G, const N: usize> Conditions<'a, S, M> for Given<G, N>
where
    G: Fn(&S, &S::State<f64>, f64) -> [f64; N] + Send + Sync,
{
    fn values(&self, run: &RunOf<'a, S, M>) -> Vec<f64> {
        (self.g)(run.system(), &run.state(), run.time()).into()
    }

    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: &mut Dense<RunOf<'a, S, M>>,
    ) -> Result<AnyWatch<'s, 'a, S, M>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's,
    {
        let g = move |t: f64, state: &S::State<f64>| (self.g)(system, state, t);
        Ok(Box::new(Watch::new(run, self.directions, g)?))
    }
}

impl<'a, S: Lagrangian, M: Method<S, f64>, G, const N: usize> Watched<'a, S, M>
    for Watch<RunOf<'a, S, M>, G, N>
where
    G: FnMut(f64, &S::State<f64>) -> [f64; N],
{
    fn search(&mut self, run: &mut Dense<RunOf<'a, S, M>>) -> Result<(), StepError> {
        Watch::search(self, run)
    }
    fn next(&mut self, run: &mut Dense<RunOf<'a, S, M>>, t: f64) -> Result<Option<EventOf<S>>, StepError> {
        self.next_until(run, t)
    }
    fn save(&self) -> Vec<f64> {
        Watch::save(self)
    }
    fn load(&mut self, saved: &[f64]) -> Option<()> {
        Watch::load(self, saved)
    }
}

/// What is known of limits and section, for a run that goes on.
pub(super) type Saved = Vec<Vec<f64>>;

/// A run that is watched in each step.
pub(super) struct WatchedRun<'s, 'a, S: Lagrangian, M: Method<S, f64>> {
    run: Dense<RunOf<'a, S, M>>,
    reasons: &'s [&'static str],
    /// That of the limits and that of the section, if there are any.
    watches: [Option<AnyWatch<'s, 'a, S, M>>; 2],
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
        let of_limits = limits.as_ref().map(|(_, limits)| limits.watch(system, &mut run)).transpose()?;
        let of_section = section.as_ref().map(|(_, section)| section.watch(system, &mut run)).transpose()?;
        let mut watches = [of_limits, of_section];
        if let Some(saved) = saved {
            let are_as_many = saved.len() == watches.iter().flatten().count();
            let mut pairs = watches.iter_mut().flatten().zip(saved);
            let loaded = pairs.try_for_each(|(watch, saved)| watch.load(saved));
            loaded.filter(|()| are_as_many).ok_or(CheckpointError::Damaged)?;
        }
        let reasons = limits.as_ref().map_or(&[][..], |(reasons, _)| reasons);
        Ok(Self { run, reasons, watches })
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
        let Self { run, reasons, watches: [limits, section] } = self;
        for _ in 0..count {
            run.advance_by(|run| match growth {
                Some(growth) => growth.take_steps(run, 1),
                None => run.advance(),
            })?;
            let (mut exit, mut end) = (None, run.time());
            if let Some(limits) = limits {
                limits.search(run)?;
                if let Some(event) = limits.next(run, end)? {
                    let reason = reasons[event.index];
                    (end, exit) = (event.time, Some((event, reason)));
                }
            }
            if let Some(section) = section {
                section.search(run)?;
                while section.next(run, end)?.is_some() {
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
        self.watches.iter().flatten().map(|watch| watch.save()).collect()
    }
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
        let Some((reasons, limits)) = &self.limits else { return Ok(None) };
        let mut values = limits.values(run);
        if values.contains(&0.0) {
            let (method, h) = (self.method(number), SOON * self.h);
            let mut soon = Integrator::new_at(system, method, run.time(), h, run.state())?;
            soon.advance().map_err(|error| StartError::Starter(error.failure))?;
            let later = values.iter_mut().zip(limits.values(&soon)).filter(|(g, _)| **g == 0.0);
            later.for_each(|(g, soon)| *g = soon);
        }
        let index = values.iter().position(|&g| g > 0.0);
        Ok(index.map(|index| (Event { index, time: run.time(), state: run.state() }, reasons[index])))
    }
}
