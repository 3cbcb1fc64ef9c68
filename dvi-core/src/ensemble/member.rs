//! What is known of a member at the end of its run.

use serde::{Deserialize, Serialize};
use std::string::String;
use std::vec::Vec;

use crate::error::LengthError;
use crate::methods::Method;
use crate::run::{Event, Integrator, Run};
use crate::state::Statistics;
use crate::{Lagrangian, Space, State, System, Vector};

/// The record of one member.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let results = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts).take_steps(1000)?;
/// let member = &results.members()[9];
/// assert_eq!((member.number, member.steps), (9, 1000));
/// assert!((member.energy.first + 1_f64.cos()).abs() < 1e-15 && member.energy.largest_error < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Member {
    /// Its number, counted from 0, in the order of the states.
    pub number: u64,
    /// How its run has ended.
    pub outcome: Outcome,
    /// The time that it has reached: the last, that of the limit, or that of the last good state before a
    /// failure.
    pub time: f64,
    /// The steps that it has completed; the last one may have led beyond a limit.
    pub steps: u64,
    /// The iterations of nonlinear solvers.
    pub iterations: u64,
    /// The last good state, or that at the limit, in the order of [`System::names`].
    pub state: Vec<f64>,
    /// Its energy at the `first` and the `last` look, and the `largest_error` |E − E₀| of all, at each
    /// [`stride`](super::Ensemble::stride); not a number if one was not.
    pub energy: Energy,
    /// The first and the last value of each declared momentum.
    pub momenta: Vec<[f64; 2]>,
}

/// How the run of a member has ended.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble, Outcome};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let results = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts)
///     .until(["too fast"], |_, state, _| [state.dot_angle.abs() - 0.9])
///     .take_steps(1000)?;
/// // From 1 rad it passes the bottom with √(2 − 2 cos 1) = 0.96, from 0.9 rad with 0.87.
/// let fast = |member: &&dvi_core::ensemble::Member| matches!(member.outcome, Outcome::Exited { .. });
/// assert_eq!(results.members().iter().filter(fast).count(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// It has taken all steps.
    Finished,
    /// It has come to a [limit](super::Ensemble::until).
    Exited {
        /// What was said of it.
        reason: String,
    },
    /// It could not begin, or a step has failed.
    Failed {
        /// The text of the error.
        error: String,
    },
}

impl Outcome {
    /// What it is in a word, and the reason.
    pub(super) fn words(&self) -> [&str; 2] {
        match self {
            Self::Finished => ["finished", ""],
            Self::Exited { reason } => ["exited", reason],
            Self::Failed { error } => ["failed", error],
        }
    }
}

/// The energy of a member, looked at every [`stride`](super::Ensemble::stride) steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// At the start.
    pub first: f64,
    /// In the last good state.
    pub last: f64,
    /// The largest |E − E₀| that was seen; not a number if one was not.
    pub largest_error: f64,
}

/// Where a member is: at the end of a step, or where an event is.
pub(super) struct At<'a, S: Lagrangian> {
    system: &'a S,
    time: f64,
    q: Vector<S, f64>,
    v: Vector<S, f64>,
}

impl<'a, S: Lagrangian> At<'a, S> {
    pub(super) fn end_of<M: Method<S, f64>>(run: &'a Integrator<&S, M>) -> Self {
        let mut q = run.system().space().vector();
        q.copy_from_slice(run.q());
        Self { system: run.system(), time: run.time(), q, v: run.v() }
    }

    /// # Errors
    /// [`LengthError`] if the state is not one of the system.
    pub(super) fn event(system: &'a S, event: &Event<S::State<f64>, f64>) -> Result<Self, LengthError> {
        let (mut q, mut v) = (system.space().vector(), system.space().vector());
        event.state.write(&|block| system.block_len(block), &mut q, &mut v)?;
        Ok(Self { system, time: event.time, q, v })
    }

    fn energy(&self) -> f64 {
        self.system.energy(&self.q, &self.v, self.time)
    }

    fn momenta(&self) -> impl Iterator<Item = f64> {
        let all = 0..S::REPORT.momenta.len();
        all.map(|index| plain(self.system.momentum(index, &self.q, &self.v, self.time)))
    }
}

/// What is seen of a run that is under way.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Seen {
    energy: Energy,
    first_momenta: Vec<f64>,
}

impl Seen {
    /// What is seen at the start of a run.
    pub(super) fn first<S: Lagrangian>(at: &At<'_, S>) -> Self {
        let energy = plain(at.energy());
        Self {
            energy: Energy { first: energy, last: energy, largest_error: 0.0 },
            first_momenta: at.momenta().collect(),
        }
    }

    /// Looks at where a member is.
    pub(super) fn look<S: Lagrangian>(&mut self, at: &At<'_, S>) {
        self.energy = self.energy.with(at.energy());
    }

    /// The record of a run that has ended.
    pub(super) fn member<S: Lagrangian>(
        self,
        number: u64,
        at: &At<'_, S>,
        Statistics { steps, iterations, .. }: Statistics,
        outcome: Outcome,
    ) -> Member {
        Member {
            number,
            outcome,
            time: at.time,
            steps,
            iterations,
            state: at.system.values_of(&at.q, &at.v).map(plain).collect(),
            energy: self.energy.with(at.energy()),
            momenta: self.first_momenta.into_iter().zip(at.momenta()).map(Into::into).collect(),
        }
    }
}

impl Energy {
    fn with(self, now: f64) -> Self {
        let (last, error) = (plain(now), plain((now - self.first).abs()));
        let is_larger = error > self.largest_error || error.is_nan();
        Self { last, largest_error: if is_larger { error } else { self.largest_error }, ..self }
    }
}

impl Member {
    /// A member whose run could not begin. Its state is the initial one, if that has the right shape.
    pub(super) fn without_run<S: Lagrangian>(
        number: u64,
        system: &S,
        state: &S::State<f64>,
        error: String,
    ) -> Self {
        let none = f64::NAN;
        Self {
            number,
            outcome: Outcome::Failed { error },
            time: 0.0,
            steps: 0,
            iterations: 0,
            state: flat(system, state),
            energy: Energy { first: none, last: none, largest_error: none },
            momenta: S::REPORT.momenta.iter().map(|_| [none; 2]).collect(),
        }
    }
}

/// The entries of a state, in the order of the names; no numbers if it does not have the right shape.
fn flat<S: System>(system: &S, state: &S::State<f64>) -> Vec<f64> {
    match system.values(state) {
        Ok(values) => values.map(plain).collect(),
        Err(_) => system.names().map(|_| f64::NAN).collect(),
    }
}

/// The number, or the one bit pattern that stands for all that are none: which of them an operation yields
/// differs from instruction to instruction.
pub(super) fn plain(x: f64) -> f64 {
    if x.is_nan() { f64::NAN } else { x }
}
