//! What keeps an ensemble from running, and shards from being put together.

use std::io;
use std::path::PathBuf;
use std::string::String;

use thiserror::Error;

use super::Shard;
use crate::error::StartError;

crate::error::said!(EnsembleError, Difference);

/// An ensemble that cannot run, or shards that cannot be put together. The failure of a member is none: it
/// is the [`Outcome`](super::Outcome) of that member.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble, EnsembleError, Results, Shard};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let nowhere = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.0, starts).take_steps(1000);
/// assert!(matches!(nowhere, Err(EnsembleError::Step { h: 0.0, .. })));
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let half = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts).shard(Shard::new(0, 2)?);
/// let merged = Results::merge([half.take_steps(100)?]);
/// assert!(matches!(merged, Err(EnsembleError::Missing { member: 1, members: 10, .. })));
/// # Ok::<(), EnsembleError>(())
/// ```
#[derive(Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// The step is zero, infinite or not a number; or so short that 1/h may be infinite.
    #[error("the step h = {h:e} must be finite, and no less than the smallest number that has all digits")]
    Step {
        /// The step that was given.
        h: f64,
    },
    /// The stride is zero.
    #[error("the stride must be at least one step")]
    Stride,
    /// There is not one system for each state.
    #[error("there are {systems} systems for {states} states")]
    Systems {
        /// The number of systems.
        systems: usize,
        /// The number of states.
        states: usize,
    },
    /// The systems differ in the sizes of their arrays, and their states do not go into one table.
    #[error("the arrays of the system of member {member} have other lengths than those of member 0")]
    Shape {
        /// The member.
        member: usize,
    },
    /// The file of a checkpoint cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// The file is no checkpoint, or not all of one.
    #[error("{} is no whole checkpoint of an ensemble: {reason}", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: &'static str,
    },
    /// The file is a checkpoint of another ensemble. To begin anew, remove it.
    #[error("{} is the checkpoint of another ensemble: {difference}", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What differs: `what` it is, what is `expected` and what is `found`.
        difference: Difference,
    },
    /// A member cannot go on from its checkpoint.
    #[error("member {member} cannot go on from its checkpoint: {error}")]
    Resume {
        /// The member.
        member: u64,
        /// Why.
        error: StartError,
    },
    /// The checkpoint has no results yet.
    #[error("{} has the results of {ended} members only: {members} belong to it", .path.display())]
    UnderWay {
        /// The file.
        path: PathBuf,
        /// The members that have ended.
        ended: usize,
        /// Those of the shard.
        members: usize,
    },
    /// A text is no shard.
    #[error("`{text}` is no shard: write i/n, such as 0/4 for the first of four")]
    ShardText {
        /// The text.
        text: String,
    },
    /// The index of a shard is not below the number of shards.
    #[error("there is no shard {index} of {of}: they count from 0 to n − 1")]
    ShardRange {
        /// The index.
        index: u64,
        /// The number of shards.
        of: u64,
    },
    /// There are no shards to put together.
    #[error("there are no results to put together")]
    Nothing,
    /// Shards are those of different ensembles.
    #[error("shard {shard} belongs to another ensemble: {difference}")]
    ForeignShard {
        /// The shard.
        shard: Shard,
        /// What differs.
        difference: Difference,
    },
    /// A member occurs more than once.
    #[error("member {member} occurs more than once: a shard was given twice, or shards overlap")]
    Twice {
        /// The first such member.
        member: u64,
    },
    /// A member does not occur.
    #[error("member {member} of {members} is missing: not all shards were given")]
    Missing {
        /// The first such member.
        member: u64,
        /// The number of members of the ensemble.
        members: u64,
    },
    /// The results of a process cannot be written to be sent to the first, or not be read there.
    #[cfg(feature = "mpi")]
    #[error("the results of a process cannot be sent: {0}")]
    Encoding(io::Error),
    /// The shard of another process cannot run, which has the reason.
    #[cfg(feature = "mpi")]
    #[error("the shard of rank {rank} could not be run")]
    Elsewhere {
        /// The first such process.
        rank: i32,
    },
    /// What has been received is not the results of a shard.
    #[cfg(feature = "mpi")]
    #[error("what rank {rank} has sent is not the results of a shard: {reason}")]
    Received {
        /// The process.
        rank: i32,
        /// What is wrong.
        reason: &'static str,
    },
}

/// In what two ensembles differ.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble, EnsembleError, Results, Shard};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let half = |index: u64, h: f64| -> Result<Results, EnsembleError> {
///     let ensemble = Ensemble::new(&Pendulum, Variational::trapezoid(), h, starts.clone());
///     ensemble.shard(Shard::new(index, 2)?).take_steps(100)
/// };
/// let merged = Results::merge([half(0, 0.1)?, half(1, 0.2)?]); // another step
/// let Err(EnsembleError::ForeignShard { difference, .. }) = merged else { panic!("they differ") };
/// assert_eq!((difference.expected.as_str(), difference.found.as_str()), ("0.1", "0.2"));
/// # Ok::<(), EnsembleError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Error)]
#[error("its {what} is `{found}`, and `{expected}` is expected")]
pub struct Difference {
    /// What it is.
    pub what: String,
    /// What is expected.
    pub expected: String,
    /// What is found instead. Numbers in hexadecimal digits are fingerprints.
    pub found: String,
}
