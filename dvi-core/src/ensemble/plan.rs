//! What tells one ensemble from another: results and checkpoints belong to one plan.

use std::fmt;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use serde::{Deserialize, Serialize};

use super::error::{Difference, EnsembleError};
use super::facts::{self, Facts};
use super::member::plain;
use super::settings::{Settings, Swept, Systems};
use crate::methods::Method;
use crate::state::fingerprint::Fingerprint;
use crate::{Lagrangian, Space, State};

/// What an ensemble computes, as texts and fingerprints, and what its table looks like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Plan {
    facts: Facts,
    /// The name of the system.
    pub(super) title: String,
    pub(super) members: u64,
    /// Those that are written down, each with its name and its value for each member.
    pub(super) parameters: Vec<(String, Vec<f64>)>,
    /// The names of the entries of a state, and how many of them are coordinates.
    pub(super) names: Vec<String>,
    pub(super) coordinates: usize,
    /// The names of the declared momenta.
    pub(super) momenta: Vec<String>,
}

impl Plan {
    pub(super) fn new<S: Lagrangian, M: Method<S, f64> + Clone + fmt::Debug>(
        settings: &Settings<'_, S, M>,
        steps: u64,
    ) -> Result<Self, EnsembleError> {
        let Settings { h, stride, ref states, .. } = *settings;
        let names = names(settings)?;
        let coordinates = names.iter().filter(|(_, is_velocity)| !is_velocity).count();
        let names: Vec<String> = names.into_iter().map(|(name, _)| name).collect();
        // Below the smallest number that has all digits, 1/h may be infinite.
        if !h.is_finite() || h.abs() < f64::MIN_POSITIVE {
            return Err(EnsembleError::Step { h });
        }
        if stride == 0 {
            return Err(EnsembleError::Stride);
        }
        let [starts, systems, texts] = fingerprints(settings);
        let parameters = parameters(settings);
        let mut swept = Fingerprint::new();
        for (name, values) in &parameters {
            swept.text(name);
            values.iter().for_each(|&value| swept.number(value));
        }
        let mut varied = Fingerprint::new();
        if settings.vary.is_some() {
            (0..states.len() as u64).for_each(|number| varied.text(&facts::text(&settings.method(number))));
        }
        let reasons = settings.limits.as_ref().map_or(&[][..], |limits| limits.reasons());
        let others = [
            ("number of members", states.len().to_string()),
            ("fingerprint of the parameters", systems),
            // Empty where systems are not asked for it.
            ("fingerprint of the texts of the systems", texts),
            ("fingerprint of the initial states", starts),
            ("fingerprint of the methods of members", varied.to_string()),
            ("step h", format!("{h:?}")),
            ("number of steps", steps.to_string()),
            ("stride", stride.to_string()),
            ("exit condition", format!("{reasons:?}")),
            ("fingerprint of the parameters in the table", swept.to_string()),
        ];
        Ok(Self {
            title: S::REPORT.system.into(),
            parameters,
            coordinates,
            facts: facts::of::<S, M>(&names, &settings.method, others),
            members: states.len() as u64,
            names,
            momenta: S::REPORT.momenta.iter().map(|&name| name.into()).collect(),
        })
    }

    /// The first thing in which `found` differs.
    pub(super) fn difference(&self, found: &Self) -> Option<Difference> {
        facts::difference(&self.facts, &found.facts)
    }
}

/// The names of the entries of a state, which are the same for all members, and whether they are velocities.
fn names<S: Lagrangian, M: Method<S, f64>>(
    settings: &Settings<'_, S, M>,
) -> Result<Vec<(String, bool)>, EnsembleError> {
    let of =
        |system: &S| system.names().map(|name| (name.to_string(), name.is_velocity)).collect::<Vec<_>>();
    match settings.systems {
        Systems::Same(system) => Ok(of(system)),
        Systems::Each(systems) => {
            let states = settings.states.len();
            if systems.len() != states {
                return Err(EnsembleError::Systems { systems: systems.len(), states });
            }
            let Some(first) = systems.first() else { return Ok(Vec::new()) };
            match systems.iter().position(|system| !system.lengths().eq(first.lengths())) {
                Some(member) => Err(EnsembleError::Shape { member }),
                None => Ok(of(first)),
            }
        }
    }
}

/// The names of the parameters that are written down, and their values for all members.
fn parameters<S: Lagrangian, M: Method<S, f64>>(settings: &Settings<'_, S, M>) -> Vec<(String, Vec<f64>)> {
    let of = |(name, value): &Swept<'_, S, S::State<f64>>| {
        let members = settings.states.iter().enumerate();
        let values = members.map(|(member, start)| plain(value(settings.system(member), start)));
        (name.clone(), values.collect())
    };
    settings.parameters.iter().map(of).collect()
}

/// Those of the initial states, of what the parameters of the systems do there, and of what the systems say
/// of themselves, if they are asked.
fn fingerprints<S: Lagrangian, M: Method<S, f64>>(settings: &Settings<'_, S, M>) -> [String; 3] {
    let [mut starts, mut systems, mut texts] = [const { Fingerprint::new() }; 3];
    for (member, state) in settings.states.iter().enumerate() {
        let system = settings.system(member);
        let (mut q, mut v) = (system.space().vector(), system.space().vector());
        match state.write(&|block| system.block_len(block), &mut q, &mut v) {
            Ok(()) => [&q, &v].into_iter().flat_map(|half| half.iter()).for_each(|&x| starts.number(x)),
            Err(error) => starts.text(&error.to_string()),
        }
        if member > 0 && matches!(settings.systems, Systems::Same(_)) {
            continue;
        }
        if let Some(text) = settings.texts {
            texts.text(&text(system));
        }
        facts::parameters(&mut systems, system, &q, &v, 0.0);
    }
    let texts = settings.texts.map_or_else(String::new, |_| texts.to_string());
    [starts.to_string(), systems.to_string(), texts]
}
