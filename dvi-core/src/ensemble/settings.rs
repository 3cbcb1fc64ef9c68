//! What the threads share while an ensemble runs.

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use super::limits::Limits;
use crate::Lagrangian;
use crate::error::StepError;
use crate::methods::Method;
use crate::run::Integrator;

/// The name of a parameter, and what it is of a system and its first state.
pub(super) type Swept<'a, S, Q> = (String, Box<dyn Fn(&S, &Q) -> f64 + Send + Sync + 'a>);
/// What is special to the method of one member.
pub(super) type Vary<'a, M> = Box<dyn Fn(u64, &mut M) + Send + Sync + 'a>;
/// Takes steps of several runs together. It hides the number of lanes.
pub(super) type Packs<'a, S, M> =
    Box<dyn FnMut(Vec<&mut Integrator<&'a S, M>>, u64) -> Vec<Result<(), StepError>> + 'a>;
pub(super) type NewPacks<'a, S, M> = fn(&Integrator<&'a S, M>) -> Packs<'a, S, M>;

/// One system for all members, or one for each.
pub(super) enum Systems<'a, S> {
    Same(&'a S),
    Each(&'a [S]),
}

/// Everything that the record of a member depends on, but for the number of steps.
pub(super) struct Settings<'a, S: Lagrangian, M: Method<S, f64>> {
    pub(super) systems: Systems<'a, S>,
    pub(super) states: Vec<S::State<f64>>,
    pub(super) method: M,
    pub(super) parameters: Vec<Swept<'a, S, S::State<f64>>>,
    pub(super) vary: Option<Vary<'a, M>>,
    pub(super) h: f64,
    pub(super) stride: u64,
    pub(super) limits: Option<Box<dyn Limits<'a, S, M> + 'a>>,
    /// With the number of lanes.
    pub(super) packs: Option<(usize, NewPacks<'a, S, M>)>,
    /// The parameters of a system as a text, for a checkpoint to be compared with.
    pub(super) texts: Option<fn(&S) -> String>,
}

impl<'a, S: Lagrangian, M: Method<S, f64>> Settings<'a, S, M> {
    pub(super) fn system(&self, member: usize) -> &'a S {
        match self.systems {
            Systems::Same(system) => system,
            Systems::Each(systems) => &systems[member],
        }
    }

    /// The method of a member.
    pub(super) fn method(&self, number: u64) -> M
    where
        M: Clone,
    {
        let mut method = self.method.clone();
        if let Some(vary) = &self.vary {
            vary(number, &mut method);
        }
        method
    }

    /// The lanes that members go in, which none do that are watched from step to step.
    pub(super) fn packs(&self) -> Option<(usize, NewPacks<'a, S, M>)> {
        self.packs.filter(|_| self.limits.is_none())
    }

    /// The members that go together into lanes.
    pub(super) fn group(&self) -> usize {
        self.packs().map_or(1, |(lanes, _)| lanes)
    }
}
