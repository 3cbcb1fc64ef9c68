//! Limits at which members end: events of their runs.

use std::boxed::Box;
use std::vec::Vec;

use super::settings::AnyGrowth;
use crate::error::{CheckpointError, StartError, StepError};
use crate::methods::Method;
use crate::run::{Dense, Direction, Event, Events, Integrator, Run};
use crate::{Lagrangian, System};

/// Conditions g(system, state, t) under which a member goes on as long as they are negative, each with the
/// reason to end.
pub(super) struct Given<G, const N: usize> {
    pub(super) reasons: [&'static str; N],
    pub(super) g: G,
}

/// An event at which a member ends, and why.
pub(super) type Exit<S> = (Event<<S as System>::State<f64>, f64>, &'static str);

/// The limits of an ensemble. It hides how many there are.
pub(super) trait Limits<'a, S: Lagrangian, M: Method<S, f64>>: Send + Sync {
    fn reasons(&self) -> &[&'static str];

    /// The limit beyond which a run begins, if there is one.
    fn beyond(&self, run: &Integrator<&'a S, M>) -> Option<Exit<S>>;

    /// Watches a run of `system` from where it is on, or as one was watched that was interrupted there.
    ///
    /// # Errors
    /// As [`Events::new`]; [`CheckpointError::Damaged`].
    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: Integrator<&'a S, M>,
        saved: Option<&[f64]>,
    ) -> Result<Box<dyn Watch<'a, S, M> + 's>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's;
}

/// A run whose limits are looked for in each step.
pub(super) trait Watch<'a, S: Lagrangian, M: Method<S, f64>> {
    fn run(&self) -> &Integrator<&'a S, M>;

    /// Takes `count` steps, up to a limit.
    ///
    /// # Errors
    /// As [`Events::advance`], and those of the growth.
    fn take_steps(
        &mut self,
        growth: &mut Option<AnyGrowth<'a, S, M>>,
        count: u64,
    ) -> Result<Option<Exit<S>>, StepError>;

    /// What is known of the conditions.
    fn save(&self) -> Vec<f64>;
}

impl<'a, S, M, G, const N: usize> Limits<'a, S, M> for Given<G, N>
where
    S: Lagrangian,
    M: Method<S, f64>,
    G: Fn(&S, &S::State<f64>, f64) -> [f64; N] + Send + Sync,
{
    fn reasons(&self) -> &[&'static str] {
        &self.reasons
    }

    fn beyond(&self, run: &Integrator<&'a S, M>) -> Option<Exit<S>> {
        let (time, state) = (run.time(), run.state());
        let index = (self.g)(run.system(), &state, time).iter().position(|&g| g > 0.0)?;
        Some((Event { index, time, state }, self.reasons[index]))
    }

    fn watch<'s>(
        &'s self,
        system: &'a S,
        run: Integrator<&'a S, M>,
        saved: Option<&[f64]>,
    ) -> Result<Box<dyn Watch<'a, S, M> + 's>, StartError>
    where
        'a: 's,
        S: 's,
        M: 's,
    {
        let g = move |t: f64, state: &S::State<f64>| (self.g)(system, state, t);
        let mut events = Events::new(Dense::new(run)?, [Direction::Rising; N], g)?;
        if let Some(saved) = saved {
            events.load(saved).ok_or(CheckpointError::Damaged)?;
        }
        Ok(Box::new(Watched { events, reasons: &self.reasons }))
    }
}

struct Watched<'s, R: Run, G, const N: usize> {
    events: Events<R, G, N>,
    reasons: &'s [&'static str; N],
}

impl<'a, S, M, G, const N: usize> Watch<'a, S, M> for Watched<'_, Integrator<&'a S, M>, G, N>
where
    S: Lagrangian,
    M: Method<S, f64>,
    G: FnMut(f64, &S::State<f64>) -> [f64; N],
{
    fn run(&self) -> &Integrator<&'a S, M> {
        self.events.run()
    }

    fn take_steps(
        &mut self,
        growth: &mut Option<AnyGrowth<'a, S, M>>,
        count: u64,
    ) -> Result<Option<Exit<S>>, StepError> {
        for _ in 0..count {
            let event = self.events.advance_by(|run| match growth {
                Some(growth) => growth.take_steps(run, 1),
                None => run.advance(),
            })?;
            if let Some(event) = event {
                let reason = self.reasons[event.index];
                return Ok(Some((event, reason)));
            }
        }
        Ok(None)
    }

    fn save(&self) -> Vec<f64> {
        self.events.save()
    }
}
