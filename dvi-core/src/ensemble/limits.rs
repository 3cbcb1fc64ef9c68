//! Limits at which members end, watched in each step.

use std::boxed::Box;
use std::vec::Vec;

use super::settings::Settings;
use crate::error::{CheckpointError, StartError, StepError};
use crate::methods::Method;
use crate::run::{Dense, Direction, Event, Integrator, Run, Watch};
use crate::{Lagrangian, System};

type RunOf<'a, S, M> = Integrator<&'a S, M>;
pub(super) type AnyWatched<'s, 'a, S, M> = Box<dyn Watched<'a, S, M> + 's>;

/// An event at which a member ends, and why.
pub(super) type Exit<S> = (Event<<S as System>::State<f64>, f64>, &'static str);

/// Functions g(system, state, t), each with the reason why a member ends where it comes to zero.
pub(super) struct Given<G, const N: usize> {
    pub(super) reasons: [&'static str; N],
    pub(super) g: G,
}

/// The limits of an ensemble, all evaluated at once. It hides how many there are.
pub(super) trait Limits<'a, S: Lagrangian, M: Method<S, f64>>: Send + Sync {
    fn reasons(&self) -> &[&'static str];

    /// The values of g where a run is.
    fn values(&self, run: &RunOf<'a, S, M>) -> Vec<f64>;

    /// A run of `system` that is watched from where it is on, or as one was that was interrupted there.
    ///
    /// # Errors
    /// As [`Watch::new`]; [`CheckpointError::Damaged`].
    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: RunOf<'a, S, M>,
        saved: Option<&[f64]>,
    ) -> Result<AnyWatched<'s, 'a, S, M>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's;
}

/// A run that is watched in each step.
pub(super) trait Watched<'a, S: Lagrangian, M: Method<S, f64>> {
    fn run(&self) -> &RunOf<'a, S, M>;

    /// Takes `count` steps, up to a limit.
    ///
    /// # Errors
    /// As [`Watch::search`].
    fn take_steps(&mut self, count: u64) -> Result<Option<Exit<S>>, StepError>;

    /// What is known of the limits, for a run that goes on.
    fn save(&self) -> Vec<f64>;
}

struct WatchedRun<'s, 'a, S: Lagrangian, M: Method<S, f64>, G, const N: usize> {
    run: Dense<RunOf<'a, S, M>>,
    watch: Watch<RunOf<'a, S, M>, G, N>,
    reasons: &'s [&'static str; N],
}

impl<'a, S: Lagrangian, M: Method<S, f64>, G, const N: usize> Limits<'a, S, M> for Given<G, N>
where
    G: Fn(&S, &S::State<f64>, f64) -> [f64; N] + Send + Sync,
{
    fn reasons(&self) -> &[&'static str] {
        &self.reasons
    }

    fn values(&self, run: &RunOf<'a, S, M>) -> Vec<f64> {
        (self.g)(run.system(), &run.state(), run.time()).into()
    }

    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: RunOf<'a, S, M>,
        saved: Option<&[f64]>,
    ) -> Result<AnyWatched<'s, 'a, S, M>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's,
    {
        let mut run = Dense::new(run)?;
        let g = move |t: f64, state: &S::State<f64>| (self.g)(system, state, t);
        let mut watch = Watch::new(&mut run, [Direction::Rising; N], g)?;
        if let Some(saved) = saved {
            watch.load(saved).ok_or(CheckpointError::Damaged)?;
        }
        Ok(Box::new(WatchedRun { run, watch, reasons: &self.reasons }))
    }
}

impl<'a, S: Lagrangian, M: Method<S, f64>, G, const N: usize> Watched<'a, S, M>
    for WatchedRun<'_, 'a, S, M, G, N>
where
    G: FnMut(f64, &S::State<f64>) -> [f64; N],
{
    fn run(&self) -> &RunOf<'a, S, M> {
        &self.run
    }

    fn take_steps(&mut self, count: u64) -> Result<Option<Exit<S>>, StepError> {
        let Self { run, watch, reasons } = self;
        for _ in 0..count {
            run.advance()?;
            watch.search(run)?;
            let end = run.time();
            if let Some(event) = watch.next_until(run, end)? {
                let reason = reasons[event.index];
                return Ok(Some((event, reason)));
            }
        }
        Ok(None)
    }

    fn save(&self) -> Vec<f64> {
        self.watch.save()
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
        let Some(limits) = &self.limits else { return Ok(None) };
        let mut values = limits.values(run);
        if values.contains(&0.0) {
            let (method, h) = (self.method(number), SOON * self.h);
            let mut soon = Integrator::new_at(system, method, run.time(), h, run.state())?;
            soon.advance().map_err(|error| StartError::Starter(error.failure))?;
            let later = values.iter_mut().zip(limits.values(&soon)).filter(|(g, _)| **g == 0.0);
            later.for_each(|(g, soon)| *g = soon);
        }
        let index = values.iter().position(|&g| g > 0.0);
        Ok(index
            .map(|index| (Event { index, time: run.time(), state: run.state() }, limits.reasons()[index])))
    }
}
