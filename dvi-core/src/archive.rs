//! A long run in one file: a checkpoint every so many steps or seconds, from which each state of the run is
//! computed again, bit for bit.
//!
//! # What is in the file
//!
//! What tells this run from others, and checkpoints in a row, each with its length and a fingerprint, in a
//! binary format in which numbers keep their bits. A checkpoint is appended and on the disk before the next
//! step is taken. Steps since the last one are in none: [`keep`](Archive::keep) keeps where the run is. A
//! process that is killed, or a disk that is full, leaves what was complete: the rest of a checkpoint is cut
//! off when the file is opened again. A file that has changed before its last checkpoint is an error, and
//! so is that of another system, method, control or start; it is left as it is then.
//! [A checkpoint alone](crate::guide::recipes#save-and-resume) is data for `serde`.

mod error;
mod file;

use std::fmt::Debug;
use std::format;
use std::path::Path;
use std::string::ToString;
use std::time::{Duration, Instant};
use std::vec::Vec;

use crate::ensemble::facts::{self, Facts};
use crate::methods::Method;
use crate::run::{Integrator, Run, StepControl, is_now};
use crate::state::fingerprint::Fingerprint;
use crate::{Held, Lagrangian};
use file::File;

pub use error::{ArchiveError, Difference};

/// How often a checkpoint is kept.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// use dvi_core::archive::{Archive, Every};
///
/// # let path = std::env::temp_dir().join(format!("dvi-every-{}", std::process::id()));
/// # let _ = std::fs::remove_file(&path);
/// let begin = || Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start.clone());
/// let mut archive = Archive::new(&path, begin()?, Every::Steps(1000))?;
/// archive.take_steps(2500)?;
/// let steps: Vec<u64> = archive.checkpoints().map(|(steps, _)| steps).collect();
/// assert_eq!(steps, [0, 1000, 2000]);
/// # drop(archive);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Every {
    /// After so many steps, counted from the start of the run; 0 is taken as 1.
    Steps(u64),
    /// After so much time of the clock on the wall, and a sixteenth of it more at most, or a step.
    Time(Duration),
}

/// A run whose states are kept in a file: one whose system and step control can be cloned, as a reference
/// and an `Arc` can.
///
/// ```
#[doc = include_str!("../docs/hidden/pendulum.txt")]
/// use dvi_core::archive::{Archive, Every};
///
/// # let path = std::env::temp_dir().join(format!("dvi-archive-{}", std::process::id()));
/// # let _ = std::fs::remove_file(&path);
/// let begin = || Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start.clone());
/// let mut archive = Archive::new(&path, begin()?, Every::Steps(10_000))?;
/// archive.take_steps(100_000)?;
///
/// // Later, perhaps in another process: the run goes on where its archive ends.
/// # drop(archive);
/// let mut archive = Archive::new(&path, begin()?, Every::Steps(10_000))?;
/// assert_eq!(archive.run().steps(), 100_000);
/// archive.take_steps(1000)?;
///
/// // What it was at t = 345.67, as a run of its own.
/// let then = archive.run_at(345.67)?;
/// let mut alone = begin()?;
/// alone.take_steps(34_567)?;
/// assert_eq!(then.state(), alone.state());
/// # drop(archive);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Archive<R> {
    run: R,
    every: Every,
    file: File,
    /// Steps between two looks at the clock.
    patience: u64,
    written: Instant,
}

impl<H, M, C> Archive<Integrator<H, M, f64, C>>
where
    H: Held<System: Lagrangian> + Clone,
    M: Method<H::System, f64> + Clone + Debug,
    C: StepControl<H::System, f64> + Clone,
{
    /// The archive of `run` in the file at `path`. If there is none, it is made, with `run` as it is; else
    /// `run` has to be as it was then, and the run goes on where the archive ends. No other process can have
    /// the file at the same time.
    ///
    /// # Errors
    /// [`ArchiveError`]: the file cannot be read or written, it is no archive or has changed, it is that of
    /// another run, or another process has it.
    pub fn new(
        path: impl AsRef<Path>,
        run: Integrator<H, M, f64, C>,
        every: Every,
    ) -> Result<Self, ArchiveError> {
        let (path, first) = (path.as_ref(), run.checkpoint());
        let file = File::open(path, &facts_of(&run), &first)?;
        let run = match file.kept() {
            [.., last] if last.step != first.statistics().steps => run.going_on_from(&file.read(*last)?)?,
            _ => run,
        };
        let every = if every == Every::Steps(0) { Every::Steps(1) } else { every };
        Ok(Self { run, every, file, patience: 1, written: Instant::now() })
    }

    /// The run, as far as it has come.
    pub fn run(&self) -> &Integrator<H, M, f64, C> {
        &self.run
    }

    /// The number of steps and the time of each checkpoint.
    pub fn checkpoints(&self) -> impl Iterator<Item = (u64, f64)> + '_ {
        self.file.kept().iter().map(|kept| (kept.step, kept.time))
    }

    /// Takes `count` steps, and keeps checkpoints on the way.
    ///
    /// # Errors
    /// [`ArchiveError::Step`] of the first step that fails: the run stays at the last good state.
    /// [`ArchiveError::File`] if a checkpoint cannot be written, as on a full disk: the archive ends with
    /// the one before, and the run stays where it is.
    pub fn take_steps(&mut self, count: u64) -> Result<(), ArchiveError> {
        let end = self.run.steps().saturating_add(count);
        while self.run.steps() < end {
            let (steps, begun) = (self.run.steps(), Instant::now());
            let stride = match self.every {
                Every::Steps(stride) => stride - steps % stride,
                Every::Time(_) => self.patience,
            };
            let taken = stride.min(end - steps);
            self.run.take_steps(taken)?;
            let is_due = match self.every {
                Every::Steps(_) => taken == stride,
                Every::Time(length) => {
                    if begun.elapsed() >= length / 32 {
                        self.patience = (taken / 2).max(1);
                    } else if taken == stride {
                        self.patience = stride.saturating_mul(2);
                    }
                    self.written.elapsed() >= length
                }
            };
            if is_due {
                self.keep()?;
            }
        }
        Ok(())
    }

    /// Keeps a checkpoint of the present state, if it is not kept already and a run can go on from there:
    /// where a force is infinite none can, and the steps from the checkpoint before lead there again.
    ///
    /// # Errors
    /// [`ArchiveError::File`].
    pub fn keep(&mut self) -> Result<(), ArchiveError> {
        self.written = Instant::now();
        if self.file.kept().last().is_some_and(|kept| kept.step == self.run.steps()) {
            return Ok(());
        }
        let checkpoint = self.run.checkpoint();
        if checkpoint.goes_on() { self.file.append(&checkpoint) } else { Ok(()) }
    }

    /// The run as it was after `steps` steps, counted as [`Run::steps`] does:
    /// another one, bit for bit, from the last checkpoint before.
    ///
    /// # Errors
    /// [`ArchiveError::Steps`] if it has not come so far, or has begun later.
    pub fn run_after(&self, steps: u64) -> Result<Integrator<H, M, f64, C>, ArchiveError> {
        let kept = self.file.kept().iter().take_while(|kept| kept.step <= steps).last();
        let Some(kept) = kept.filter(|_| steps <= self.run.steps()) else {
            return Err(ArchiveError::Steps { steps, reached: self.run.steps() });
        };
        let mut run = self.run.going_on_from(&self.file.read(*kept)?)?;
        run.take_steps(steps - kept.step)?;
        Ok(run)
    }

    /// The run as it was at time `t`, after the last step up to there, or to its rounding: another one, bit
    /// for bit. It takes the steps from the last checkpoint before twice.
    ///
    /// # Errors
    /// [`ArchiveError::Time`] if it has not come to `t`, or has begun later.
    pub fn run_at(&self, t: f64) -> Result<Integrator<H, M, f64, C>, ArchiveError> {
        let h = self.run.step_size();
        let is_at = |time: f64| t.is_finite() && is_now(t, [time, h]);
        let is_reached = |time: f64| is_at(time) || if h > 0.0 { time <= t } else { time >= t };
        let is_past = |time: f64| is_at(time) || if h > 0.0 { time >= t } else { time <= t };
        let kept = self.file.kept().iter().take_while(|kept| is_reached(kept.time)).last();
        let Some(kept) = kept.filter(|_| is_past(self.run.time())) else {
            return Err(ArchiveError::Time { t, reached: self.run.time() });
        };
        let (mut ahead, mut steps) = (self.run.going_on_from(&self.file.read(*kept)?)?, kept.step);
        while steps < self.run.steps() {
            ahead.advance()?;
            if !is_reached(ahead.time()) {
                break;
            }
            steps = ahead.steps();
        }
        self.run_after(steps)
    }
}

/// What tells the archive of `run` from others.
fn facts_of<H, M, C>(run: &Integrator<H, M, f64, C>) -> Facts
where
    H: Held<System: Lagrangian>,
    M: Method<H::System, f64> + Debug,
    C: StepControl<H::System, f64>,
{
    let system = run.system();
    // A length is compared with the start.
    let control: &dyn Debug = if C::ONE_LENGTH { &() } else { &run.control };
    let mut parameters = Fingerprint::new();
    facts::parameters(&mut parameters, system, run.q(), &run.v(), run.time());
    let names: Vec<_> = crate::System::names(system).map(|name| name.to_string()).collect();
    let others = [
        ("fingerprint of the parameters and the start", parameters.to_string()),
        ("step control", format!("{control:?}")),
    ];
    facts::of::<H::System, M>(&names, run.method(), others)
}
