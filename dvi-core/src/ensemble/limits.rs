//! Limits at which members end: events of their runs, sought anew from look to look.

use std::boxed::Box;
use std::vec::Vec;

use super::settings::Settings;
use crate::error::StartError;
use crate::methods::Method;
use crate::run::{Direction, Event, Integrator, Run};
use crate::{Lagrangian, System};

type RunOf<'a, S, M> = Integrator<&'a S, M>;

/// An event at which a member ends, and why.
pub(super) type Exit<S> = (Event<<S as System>::State<f64>, f64>, &'static str);

/// What steps have led to: a limit, or the last of them; or why they could not be taken.
pub(super) type Taken<S> = Result<Option<Exit<S>>, Box<dyn core::error::Error>>;

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

    /// Takes `count` steps of a run of `system`, up to a limit. What has been known of g before has no part
    /// in it, so that nothing of that is written down when a member is interrupted.
    ///
    /// # Errors
    /// As [`Run::events`] and [`Events::advance`](crate::run::Events::advance).
    fn take_steps(&self, system: &S, run: &mut RunOf<'a, S, M>, count: u64) -> Taken<S>;
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

    fn take_steps(&self, system: &S, run: &mut RunOf<'a, S, M>, count: u64) -> Taken<S> {
        let mut events =
            run.events([Direction::Rising; N], |t: f64, state: &S::State<f64>| (self.g)(system, state, t))?;
        for _ in 0..count {
            if let Some(event) = events.advance()? {
                let reason = self.reasons[event.index];
                return Ok(Some((event, reason)));
            }
        }
        Ok(None)
    }
}

/// Of the first step, what tells where a limit leads that is zero at the start.
const SOON: f64 = 1e-5;

impl<'a, S: Lagrangian, M: Method<S, f64> + Clone> Settings<'a, S, M> {
    /// The limit beyond which a run begins, or which it leaves outwards, if there is one.
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
