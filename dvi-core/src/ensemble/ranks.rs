//! An ensemble over the processes of an MPI program: each takes a shard, and the first puts the results
//! together.

use std::fmt;
use std::io;
use std::vec;
use std::vec::Vec;

use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Source};
use thiserror::Error;

use super::error::{EnsembleError, MergeError};
use super::{Ensemble, Results, Shard, ShardError, file};
use crate::Lagrangian;
use crate::methods::Method;

crate::error::said!(RanksError);

/// The process that puts the results together.
const ROOT: i32 = 0;
/// Results are sent in pieces of this many bytes: MPI counts them in 32 bits.
const PIECE: usize = 1 << 30;
/// In place of the length of the results, if there are none.
const NONE: u64 = u64::MAX;

/// What keeps an ensemble over several processes from having results.
///
/// ```no_run
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble, RanksError};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let universe = mpi::initialize().ok_or("MPI has begun before")?;
/// let ensemble = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts);
/// match ensemble.take_steps_on(&universe.world(), 1000) {
///     Err(RanksError::Elsewhere { rank, .. }) => eprintln!("process {rank} has the reason"),
///     results => println!("{:?}", results?.map(|results| results.members().len())), // at the first process
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Error)]
#[non_exhaustive]
pub enum RanksError {
    /// The shard of this process cannot run.
    #[error(transparent)]
    Here(EnsembleError),
    /// The results of this process cannot be sent.
    #[error("the results of this process cannot be sent: {0}")]
    Encoding(io::Error),
    /// The shard of another process cannot run, which has the reason.
    #[error("the shard of rank {rank} could not be run")]
    Elsewhere {
        /// The first such process.
        rank: i32,
    },
    /// Not all processes have begun the same ensemble.
    #[error(transparent)]
    Merge(#[from] MergeError),
    /// The communicator has numbers that are none of a shard.
    #[error(transparent)]
    Shard(#[from] ShardError),
    /// What has been received is not the results of a shard.
    #[error("what rank {rank} has sent is not the results of a shard: {reason}")]
    Damaged {
        /// The process.
        rank: i32,
        /// What is wrong.
        reason: &'static str,
    },
}

impl<S: Lagrangian, M: Method<S, f64>> Ensemble<'_, S, M> {
    /// Takes up to `count` steps of each member, on all processes of `world`, which all call this with the
    /// same ensemble: rank r of n takes the shard r/n. The first process gets the results of all members,
    /// bit for bit those of [`take_steps`](Self::take_steps) alone, the others get `None`. With checkpoints
    /// there is one for each process; begin again with as many.
    ///
    /// # Errors
    /// [`RanksError`]. A shard that cannot run is an error of all processes.
    pub fn take_steps_on<C: Communicator>(self, world: &C, count: u64) -> Result<Option<Results>, RanksError>
    where
        S: Sync,
        S::State<f64>: Sync,
        M: Clone + Sync + fmt::Debug,
    {
        let of = world.size();
        let shard = Shard::new(world.rank() as u64, of as u64)?;
        let taken = self.shard(shard).take_steps(count).map_err(RanksError::Here);
        let taken = taken.and_then(|own| Ok((own.encoded().map_err(RanksError::Encoding)?, own)));
        let length = taken.as_ref().map_or(NONE, |(sent, _)| sent.len() as u64);
        let mut lengths = vec![NONE; of as usize];
        world.all_gather_into(&length, &mut lengths[..]);
        let (sent, own) = taken?;
        if let Some(rank) = (0..of).find(|&rank| lengths[rank as usize] == NONE) {
            return Err(RanksError::Elsewhere { rank });
        }
        if world.rank() != ROOT {
            sent.chunks(PIECE).for_each(|piece| world.process_at_rank(ROOT).send(piece));
            return Ok(None);
        }
        // All are received before one is refused, so that nobody waits.
        let received: Vec<_> =
            (1..of).map(|rank| (rank, receive(world, rank, lengths[rank as usize]))).collect();
        let others = received.into_iter().map(|(rank, bytes)| {
            let (plan, shard, slots) =
                file::decode(&bytes).map_err(|reason| RanksError::Damaged { rank, reason })?;
            Ok::<_, RanksError>(Results::of(plan, shard, slots))
        });
        let shards: Vec<Results> = [Ok(own)].into_iter().chain(others).collect::<Result<_, _>>()?;
        Ok(Some(Results::merge(shards)?))
    }
}

fn receive<C: Communicator>(world: &C, rank: i32, length: u64) -> Vec<u8> {
    let mut bytes = vec![0; length as usize];
    for piece in bytes.chunks_mut(PIECE) {
        world.process_at_rank(rank).receive_into(piece);
    }
    bytes
}
