//! Ensembles: many runs of one method over all cores, from a list or a distribution of initial conditions
//! or parameters.
//!
//! Each member has a record of its own: how its run has ended and when, its last state, its energies and
//! momenta. A member that fails is recorded, and the others go on. The results are bit for bit the same for
//! every number of threads, with interruptions and without, as a whole and in shards; and for every number
//! of lanes, if systems that are equal by `==` do the same.
//!
//! ```
//! use dvi_core::ensemble::{Draws, Ensemble, Outcome};
//! use dvi_core::prelude::*;
//!
//! /// Hénon & Heiles 1964.
//! #[lagrangian(
//!     coordinates(x, y),
//!     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0
//!         - (x * x + y * y) / 2.0 - x * x * y + y.powi(3) / 3.0,
//! )]
//! #[derive(Debug, PartialEq)]
//! struct HenonHeiles;
//!
//! let states = Draws::new(7).take(100, |draw| HenonHeilesState {
//!     x: draw.normal(0.0, 0.2),
//!     y: draw.normal(0.0, 0.2),
//!     dot_x: draw.uniform(-0.5, 0.5),
//!     dot_y: 0.0,
//! });
//! let results = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, states)
//!     .until(["left the well"], |_, state, _| [state.x.hypot(state.y) - 3.0])
//!     .parameter("first_x", |_, start| start.x)
//!     .take_steps(2000)?;
//! let left = results.members().iter().filter(|member| matches!(member.outcome, Outcome::Exited { .. }));
//! println!("{} of 100 have left", left.count());
//! let record = results.record()?; // a row for each member
//! let mut table = Vec::new();
//! record.write_csv(&mut table)?;
//! # assert_eq!((results.members().len(), record.numbers("parameter.first_x")?.len()), (100, 100));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! All cores are those of the thread pool of rayon in which [`Ensemble::take_steps`] is called:
//! `pool.install(|| …)` takes another, and the environment variable `RAYON_NUM_THREADS` sets the number of
//! threads of the usual one.
//!
//! # Checkpoints and shards
//!
//! With [`Ensemble::checkpoints`] a run that was killed goes on where it was: begin it again. With
//! [`Ensemble::shard`] several processes share the members. Each writes a checkpoint, which holds its
//! results in the end; [`Results::read`] and [`Results::merge`] put them together:
//!
//! ```no_run
//! use dvi_core::ensemble::{Results, Shard};
//!
//! let shards = (0..8).map(|index| Results::read(Shard::new(index, 8)?.path("run.ckpt")));
//! let whole = Results::merge(shards.collect::<Result<Vec<_>, _>>()?)?;
//! whole.record()?.write_csv(std::fs::File::create("run.csv")?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(
    feature = "mpi",
    doc = "With the feature `mpi`, [`Ensemble::take_steps_on`] does all this over the processes of an MPI program."
)]

mod draws;
pub(crate) mod error;
pub(crate) mod facts;
mod file;
mod group;
mod limits;
mod member;
mod plan;
#[cfg(feature = "mpi")]
mod ranks;
mod results;
mod rounds;
pub(crate) mod sealed;
mod settings;
mod shard;

use std::borrow::ToOwned;
use std::boxed::Box;
use std::fmt;
use std::format;
use std::path::Path;
use std::string::String;
use std::time::Duration;
use std::vec::Vec;

use crate::Lagrangian;
use crate::methods::{InStep, Method, Suits};
use crate::run::Together;
use crate::shown::shown;
use limits::Given;
use plan::Plan;
use rounds::{Checkpoints, Rounds};
use settings::{Settings, Systems};

pub use draws::{Draw, Draws};
pub use error::EnsembleError;
pub use member::{Member, Outcome};
pub use results::Results;
pub use shard::Shard;

type Tell<'a> = Box<dyn FnMut(&Progress) + Send + 'a>;

/// Runs from many states, or on many systems.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let results = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts).take_steps(1000)?;
/// let record = results.record()?;
/// assert_eq!(record.rows(), 10);
/// assert!(record.numbers("energy.largest_error")?.iter().all(|error| *error < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use = "an ensemble does nothing before `take_steps`"]
pub struct Ensemble<'a, S: Lagrangian, M: Method<S, f64>> {
    settings: Settings<'a, S, M>,
    shard: Shard,
    checkpoints: Option<Checkpoints>,
    on_progress: Option<Tell<'a>>,
}

/// How far an ensemble, or a shard of one, has got.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble, Progress};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let mut told: Vec<Progress> = Vec::new();
/// Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts)
///     .on_progress(|progress| told.push(*progress))
///     .take_steps(1000)?;
/// let last = told.last().unwrap();
/// assert_eq!((last.ended, last.members, last.steps), (10, 10, 10_000));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Progress {
    /// The members.
    pub members: u64,
    /// Those that have ended, in one way or another.
    pub ended: u64,
    /// The steps that all members together have taken.
    pub steps: u128,
}

impl<'a, S: Lagrangian, M: Method<S, f64>> Ensemble<'a, S, M> {
    /// Runs on one system from each of the `states`, at time 0 and with step `h`, which may be negative.
    pub fn new(
        system: &'a S,
        method: impl Suits<S, f64, M>,
        h: f64,
        states: impl IntoIterator<Item = S::State<f64>>,
    ) -> Self {
        Self::of(Systems::Same(system), method.suited(), h, states)
    }

    /// Runs on a system for each of the `states`, such as one with parameters from a table.
    pub fn with_systems(
        systems: &'a [S],
        method: impl Suits<S, f64, M>,
        h: f64,
        states: impl IntoIterator<Item = S::State<f64>>,
    ) -> Self {
        Self::of(Systems::Each(systems), method.suited(), h, states)
    }

    fn of(
        systems: Systems<'a, S>,
        method: M,
        h: f64,
        states: impl IntoIterator<Item = S::State<f64>>,
    ) -> Self {
        let settings = Settings {
            systems,
            states: states.into_iter().collect(),
            method,
            parameters: Vec::new(),
            vary: None,
            h,
            stride: 100,
            limits: None,
            packs: None,
            texts: None,
        };
        Self { settings, shard: Shard::WHOLE, checkpoints: None, on_progress: None }
    }

    /// Writes down a parameter of each member beside its results, such as one that its system has from a
    /// table, or a part of its first state: in the column `parameter.` and `name` of their
    /// [record](Results::record). One of the same name takes the place of the other.
    pub fn parameter(
        mut self,
        name: impl Into<String>,
        value: impl Fn(&S, &S::State<f64>) -> f64 + Send + Sync + 'a,
    ) -> Self {
        let name = name.into();
        self.settings.parameters.retain(|(other, _)| *other != name);
        self.settings.parameters.push((name, Box::new(value)));
        self
    }

    /// Changes the method of each member by its number: `Langevin` needs a seed of its own in each, for else
    /// all have the same noise.
    pub fn vary_method(mut self, vary: impl Fn(u64, &mut M) + Send + Sync + 'a) -> Self {
        self.settings.vary = Some(Box::new(vary));
        self
    }

    /// Looks at the energy of each member every `steps` steps, at its start and at its end. It is 100 if
    /// nothing else is said. What the energy does between two looks is not seen.
    pub fn stride(mut self, steps: u64) -> Self {
        self.settings.stride = steps;
        self
    }

    /// Ends the run of a member where one of the functions `g` of system, state and time comes from below to
    /// zero, with its reason: such as "left the region" where `g` is the distance from the origin less the
    /// radius of the region. A member that begins beyond a limit, where its g is positive, ends there, and so
    /// does one that begins where g is zero and leaves outwards: where g is positive 10⁻⁵ of a step later.
    /// Another call replaces the limits of the one before.
    ///
    /// These are [`Events`](crate::run::Events): time and state of the member are those at the limit, as
    /// accurate as its run is, whatever the length of a step, and a member that a step leads beyond a limit
    /// and back has come to it. A function that is not a number is a failure. Each step is watched, so that
    /// members go alone, not in lanes; what has been known of g is forgotten at each look at the energy,
    /// after which a step costs some more.
    pub fn until<const N: usize>(
        mut self,
        reasons: [&'static str; N],
        g: impl Fn(&S, &S::State<f64>, f64) -> [f64; N] + Send + Sync + 'a,
    ) -> Self {
        self.settings.limits = Some(Box::new(Given { reasons, g }));
        self
    }

    /// Takes `W` members at a time in lanes, as [`Together`] does: members of systems that are equal, or
    /// differ in parameters of a [generic type](crate::Parameter) only, which are neighbours in their
    /// shard; those with [limits](Self::until) go alone. It is faster, and the results are the same, as long
    /// as systems that are equal by `==` do the same: 0.0 and −0.0 are equal.
    pub fn in_lanes<const W: usize>(mut self) -> Self
    where
        S: PartialEq,
        M: InStep<W, S, Packs: 'a> + PartialEq + 'a,
    {
        self.settings.packs = Some((W, |run| {
            let mut together = Together::<W, S, M>::new(run);
            Box::new(move |runs, count| together.take_steps(runs, count))
        }));
        self
    }

    /// Writes a checkpoint to `path` about `every` so often, and at the end; goes on from it if it is there.
    /// A shard has a file of its own, [`Shard::path`]. The file is replaced as a whole, so that a process
    /// that is killed leaves a good one. Only one process at a time may use it.
    ///
    /// A checkpoint of another ensemble is an error that says in what it differs. Initial states are
    /// compared by their bits; the method by its type and by what [`Debug`](fmt::Debug) says of it; the
    /// systems by their type, their formulas, energy and gradient at the start, and by what `Debug` says of
    /// them. So that must be the same in each process, which the address of a function is not. Of limits the
    /// reasons are compared; what they and functions of your own in formulas compute cannot be: remove the
    /// file when that changes. It is written between two [looks](Self::stride), so that a long stride makes
    /// it late.
    pub fn checkpoints(mut self, path: impl AsRef<Path>, every: Duration) -> Self
    where
        S: fmt::Debug,
    {
        self.settings.texts = Some(|system| format!("{system:?}"));
        self.checkpoints = Some(Checkpoints { path: path.as_ref().to_owned(), every });
        self
    }

    /// Takes the members of a shard only. All shards are given all states.
    pub fn shard(mut self, shard: Shard) -> Self {
        self.shard = shard;
        self
    }

    /// Calls `tell` at the start, about once in a second as far as the [stride](Self::stride) allows, and at
    /// the end: from one thread, and never twice at once.
    pub fn on_progress(mut self, tell: impl FnMut(&Progress) + Send + 'a) -> Self {
        self.on_progress = Some(Box::new(tell));
        self
    }

    /// Takes up to `count` steps of each member.
    ///
    /// # Errors
    /// [`EnsembleError`] if the ensemble makes no sense, or its checkpoint cannot be written or is not its
    /// own. Members that fail are no error: their [`Outcome`] says so.
    pub fn take_steps(mut self, count: u64) -> Result<Results, EnsembleError>
    where
        S: Sync,
        S::State<f64>: Sync,
        M: Clone + Sync + fmt::Debug,
    {
        let plan = Plan::new(&self.settings, count)?;
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.path = self.shard.path(&checkpoints.path);
        }
        let checkpoints = self.checkpoints.as_ref();
        let rounds = Rounds::begin(plan, self.shard, checkpoints)?;
        let settings = &self.settings;
        let advance = |group: &mut [_], is_interrupted: &dyn Fn() -> bool| {
            settings.advance(group, count, is_interrupted)
        };
        rounds.run((settings.group(), &advance), checkpoints, self.on_progress)
    }
}

shown! {
    [S: Lagrangian, M: Method<S, f64> + fmt::Debug] Ensemble<'_, S, M>, |ensemble|
    system: S::REPORT.system,
    method: ensemble.settings.method,
    members: ensemble.settings.states.len(),
    shard: ensemble.shard
}
