//! Members that one thread takes from look to look, until they end or are interrupted.

use std::boxed::Box;
use std::string::ToString;
use std::vec::Vec;

use serde::{Deserialize, Serialize};

use super::error::EnsembleError;
use super::limits::Taken;
use super::member::{At, Member, Outcome, Seen};
use super::settings::Settings;
use crate::Lagrangian;
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
}

impl Slot {
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
        let mut packs = self.packs().map(|(_, new)| new(&first.run));
        // Members of a group may have been interrupted at different steps: those that are behind catch up.
        while let Some(at) = runners.iter().map(Runner::steps).min() {
            let steps = self.stride.min(count.saturating_sub(at));
            let (behind, mut others): (Vec<_>, Vec<_>) =
                runners.into_iter().partition(|runner| runner.steps() == at);
            let mut behind: Vec<Runner<'_, 'a, S, M>> = behind;
            let results = match &mut packs {
                Some(packs) => {
                    let runs = behind.iter_mut().map(|runner| &mut runner.run).collect();
                    packs(runs, steps).into_iter().map(|taken| Ok(taken.map(|()| None)?)).collect()
                }
                None => behind.iter_mut().map(|runner| runner.take_steps(self, steps)).collect::<Vec<_>>(),
            };
            let looked_at = behind.into_iter().zip(results);
            others.extend(looked_at.filter_map(|(runner, result)| runner.looked_at(result, count)));
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
        &'s self,
        slot: &'s mut Slot,
        count: u64,
    ) -> Result<Option<Runner<'s, 'a, S, M>>, EnsembleError> {
        let number = slot.number;
        let (system, state) = (self.system(number as usize), &self.states[number as usize]);
        match &slot.place {
            Place::Ended(_) => Ok(None),
            Place::UnderWay(under_way) => {
                let resumed = Integrator::resume(system, self.method(number), &under_way.checkpoint);
                let run = resumed.map_err(|error| EnsembleError::Resume { member: number, error })?;
                let seen = under_way.seen.clone();
                Ok(Some(Runner { slot, run, seen }))
            }
            Place::Waiting => {
                let begun = Integrator::new(system, self.method(number), self.h, state.clone())
                    .and_then(|run| Ok((self.beyond(system, number, &run)?, run)));
                match begun {
                    Ok((exit, run)) => {
                        let seen = Seen::first(&At::end_of(&run));
                        Ok(Runner { slot, run, seen }.looked_at(Ok(exit), count))
                    }
                    Err(error) => {
                        slot.place =
                            Place::Ended(Member::without_run(number, system, state, error.to_string()));
                        Ok(None)
                    }
                }
            }
        }
    }
}

impl<'a, S: Lagrangian, M: Method<S, f64>> Runner<'_, 'a, S, M> {
    fn steps(&self) -> u64 {
        self.run.steps()
    }

    /// Takes `count` steps, up to a limit.
    fn take_steps(&mut self, settings: &Settings<'a, S, M>, count: u64) -> Taken<S> {
        match &settings.limits {
            None => Ok(self.run.take_steps(count).map(|()| None)?),
            Some(limits) => {
                limits.take_steps(settings.system(self.slot.number as usize), &mut self.run, count)
            }
        }
    }

    /// The runner, unless this look shows that the member has ended.
    fn looked_at(mut self, result: Taken<S>, count: u64) -> Option<Self> {
        let run = &self.run;
        let place = match &result {
            Ok(Some((event, _))) => At::event(run.system(), event),
            Ok(None) | Err(_) => Ok(At::end_of(run)),
        };
        let (at, outcome) = match (place, result) {
            (Err(error), _) => (At::end_of(run), Outcome::Failed { error: error.to_string() }),
            (Ok(at), Err(error)) => (at, Outcome::Failed { error: error.to_string() }),
            (Ok(at), Ok(exit)) => {
                self.seen.look(&at);
                match exit {
                    Some((_, reason)) => (at, Outcome::Exited { reason: reason.into() }),
                    None if run.steps() < count => return Some(self),
                    None => (at, Outcome::Finished),
                }
            }
        };
        let member = self.seen.member(self.slot.number, &at, run.statistics(), outcome);
        self.slot.place = Place::Ended(member);
        None
    }

    /// Leaves the member to be gone on with, if it can be: a run that has just overflown takes a step more,
    /// which fails.
    fn is_left(&mut self, settings: &Settings<'a, S, M>) -> bool
    where
        M: Clone,
    {
        let Self { slot, run, seen } = self;
        let under_way = UnderWay { checkpoint: run.checkpoint(), seen: seen.clone() };
        let (system, method) = (settings.system(slot.number as usize), settings.method(slot.number));
        let can_go_on = Integrator::resume(system, method, &under_way.checkpoint).is_ok();
        if can_go_on {
            slot.place = Place::UnderWay(Box::new(under_way));
        }
        can_go_on
    }
}
