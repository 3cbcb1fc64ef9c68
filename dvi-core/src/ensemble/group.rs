//! Members that one thread takes from look to look, until they end or are interrupted.

use std::boxed::Box;
use std::string::ToString;
use std::vec::Vec;

use serde::{Deserialize, Serialize};

use super::error::EnsembleError;
use super::growth::Growth;
use super::member::{Member, Outcome, Seen};
use super::settings::Settings;
use crate::Lagrangian;
use crate::error::{CheckpointError, StartError, StepError};
use crate::methods::Method;
use crate::run::{Checkpoint, Integrator, Run};

/// How far a member has got.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Place {
    Waiting,
    UnderWay(Box<UnderWay>),
    Ended(Member),
}

/// A run that is interrupted.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct UnderWay {
    checkpoint: Checkpoint,
    seen: Seen,
    growth: Option<Vec<f64>>,
}

/// A member with its place.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Slot {
    pub(super) number: u64,
    pub(super) place: Place,
}

/// A member that runs.
struct Runner<'s, 'a, S: Lagrangian, M: Method<S, f64>> {
    slot: &'s mut Slot,
    run: Integrator<&'a S, M>,
    seen: Seen,
    growth: Option<Box<dyn Growth<'a, S, M> + 'a>>,
}

impl Slot {
    pub(super) fn waiting(number: u64) -> Self {
        Self { number, place: Place::Waiting }
    }

    pub(super) fn has_ended(&self) -> bool {
        matches!(self.place, Place::Ended(_))
    }

    /// The steps that the member has completed.
    pub(super) fn steps(&self) -> u64 {
        match &self.place {
            Place::Waiting => 0,
            Place::UnderWay(under_way) => under_way.checkpoint.statistics().steps,
            Place::Ended(member) => member.steps,
        }
    }
}

impl<'a, S: Lagrangian, M: Method<S, f64> + Clone> Settings<'a, S, M> {
    /// Takes the members of a group on, to step `count` or until `is_interrupted` at one of their looks.
    ///
    /// # Errors
    /// [`EnsembleError::Resume`].
    pub(super) fn advance(
        &self,
        group: &mut [Slot],
        count: u64,
        is_interrupted: &dyn Fn() -> bool,
    ) -> Result<(), EnsembleError> {
        let mut runners = Vec::with_capacity(group.len());
        for slot in group {
            runners.extend(self.begin(slot, count)?);
        }
        let Some(first) = runners.first() else { return Ok(()) };
        let mut packs = self.packs.filter(|_| self.growth.is_none()).map(|(_, new)| new(&first.run));
        // Members of a group may have been interrupted at different steps: those that are behind catch up.
        while let Some(at) = runners.iter().map(|runner| runner.run.steps()).min() {
            let steps = self.stride.min(count.saturating_sub(at));
            let (behind, mut others): (Vec<_>, Vec<_>) =
                runners.into_iter().partition(|runner| runner.run.steps() == at);
            let mut behind: Vec<Runner<'_, 'a, S, M>> = behind;
            let results = match &mut packs {
                Some(packs) => {
                    packs.take_steps(behind.iter_mut().map(|runner| &mut runner.run).collect(), steps)
                }
                None => behind.iter_mut().map(|runner| runner.take_steps(steps)).collect(),
            };
            others.extend(
                behind
                    .into_iter()
                    .zip(results)
                    .filter_map(|(runner, result)| runner.looked_at(self, result, count)),
            );
            runners = others;
            if is_interrupted() {
                runners.retain_mut(|runner| !runner.is_left(self));
            }
        }
        Ok(())
    }

    /// Begins the run of a member, or goes on with it; there is none if the member has ended, or ends at
    /// once.
    fn begin<'s>(
        &self,
        slot: &'s mut Slot,
        count: u64,
    ) -> Result<Option<Runner<'s, 'a, S, M>>, EnsembleError> {
        let number = slot.number;
        let (system, state) = (self.system(number as usize), &self.states[number as usize]);
        match &slot.place {
            Place::Ended(_) => Ok(None),
            Place::UnderWay(under_way) => {
                let resumed = self.resume(system, number, under_way);
                let (run, growth) =
                    resumed.map_err(|error| EnsembleError::Resume { member: number, error })?;
                let seen = under_way.seen.clone();
                Ok(Some(Runner { slot, run, seen, growth }))
            }
            Place::Waiting => match Integrator::new(system, self.method(number), self.h, state.clone()) {
                Ok(run) => {
                    let growth = self.growth.map(|new| new(&run));
                    let seen = Seen::first(&run);
                    Ok(Runner { slot, run, seen, growth }.looked_at(self, Ok(()), count))
                }
                Err(error) => {
                    slot.place = Place::Ended(Member::without_run(number, system, state, error.to_string()));
                    Ok(None)
                }
            },
        }
    }

    #[allow(clippy::type_complexity)]
    fn resume(
        &self,
        system: &'a S,
        number: u64,
        UnderWay { checkpoint, growth: saved, .. }: &UnderWay,
    ) -> Result<(Integrator<&'a S, M>, Option<Box<dyn Growth<'a, S, M> + 'a>>), StartError> {
        let run = Integrator::resume(system, self.method(number), checkpoint)?;
        let mut growth = self.growth.map(|new| new(&run));
        match (&mut growth, saved) {
            (Some(growth), Some(saved)) => growth.load(saved).ok_or(CheckpointError::Damaged)?,
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => return Err(CheckpointError::Damaged.into()),
        }
        Ok((run, growth))
    }
}

impl<'s, 'a, S: Lagrangian, M: Method<S, f64>> Runner<'s, 'a, S, M> {
    fn take_steps(&mut self, count: u64) -> Result<(), StepError> {
        match &mut self.growth {
            Some(growth) => growth.take_steps(&mut self.run, count),
            None => self.run.take_steps(count),
        }
    }

    /// The runner, unless this look shows that the member has ended.
    fn looked_at(
        mut self,
        settings: &Settings<'_, S, M>,
        result: Result<(), StepError>,
        count: u64,
    ) -> Option<Self> {
        let outcome = match result {
            Err(error) => Outcome::Failed { error: error.to_string() },
            Ok(()) => match self.seen.look(settings, &self.run) {
                Some(reason) => Outcome::Exited { reason: reason.into() },
                None if self.run.steps() >= count => Outcome::Finished,
                None => return Some(self),
            },
        };
        let Self { slot, run, seen, growth } = self;
        let exponent = growth.and_then(|growth| growth.exponent());
        slot.place = Place::Ended(seen.member(slot.number, &run, exponent, outcome));
        None
    }

    /// Leaves the member to be gone on with, if it can be: a run that has just overflown takes a step more,
    /// which fails.
    fn is_left(&mut self, settings: &Settings<'_, S, M>) -> bool
    where
        M: Clone,
    {
        let Self { slot, run, seen, growth } = self;
        let growth = growth.as_ref().map(|growth| growth.save());
        let under_way = UnderWay { checkpoint: run.checkpoint(), seen: seen.clone(), growth };
        let can_go_on =
            settings.resume(settings.system(slot.number as usize), slot.number, &under_way).is_ok();
        if can_go_on {
            slot.place = Place::UnderWay(Box::new(under_way));
        }
        can_go_on
    }
}
