//! An ensemble over the processes of an MPI program: each takes a shard, and the first puts the results
//! together.

use std::fmt;
use std::vec;
use std::vec::Vec;

use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Source};

use super::error::EnsembleError;
use super::{Ensemble, Results, Shard, file};
use crate::Lagrangian;
use crate::methods::Method;

/// The process that puts the results together.
const ROOT: i32 = 0;
/// Results are sent in pieces of this many bytes: MPI counts them in 32 bits.
const PIECE: usize = 1 << 30;
/// In place of the length of the results, if there are none.
const NONE: u64 = u64::MAX;

impl<S: Lagrangian, M: Method<S, f64>> Ensemble<'_, S, M> {
    /// Takes up to `count` steps of each member, on all processes of `world`, which all call this with the
    /// same ensemble: rank r of n takes the shard r/n. The first process gets the results of all members,
    /// bit for bit those of [`take_steps`](Self::take_steps) alone, the others get `None`. With checkpoints
    /// there is one for each process; begin again with as many.
    ///
    /// # Errors
    /// [`EnsembleError`]. A shard that cannot run is an error of all processes.
    pub fn take_steps_on<C: Communicator>(
        self,
        world: &C,
        count: u64,
    ) -> Result<Option<Results>, EnsembleError>
    where
        S: Sync,
        S::State<f64>: Sync,
        M: Clone + Sync + fmt::Debug,
    {
        let of = world.size();
        let shard = Shard::new(world.rank() as u64, of as u64)?;
        let taken = self.shard(shard).take_steps(count);
        let taken = taken.and_then(|own| Ok((own.encoded().map_err(EnsembleError::Encoding)?, own)));
        let length = taken.as_ref().map_or(NONE, |(sent, _)| sent.len() as u64);
        let mut lengths = vec![NONE; of as usize];
        world.all_gather_into(&length, &mut lengths[..]);
        let (sent, own) = taken?;
        if let Some(rank) = (0..of).find(|&rank| lengths[rank as usize] == NONE) {
            return Err(EnsembleError::Elsewhere { rank });
        }
        if world.rank() != ROOT {
            sent.chunks(PIECE).for_each(|piece| world.process_at_rank(ROOT).send(piece));
            return Ok(None);
        }
        // All are received before one is refused, so that nobody waits.
        let received: Vec<_> =
            (1..of).map(|rank| (rank, receive(world, rank, lengths[rank as usize]))).collect();
        let others = received.into_iter().map(|(rank, bytes)| {
            let saved = file::decode(&bytes[..], bytes.len() as u64).map_err(EnsembleError::Encoding)?;
            let (plan, shard, slots) = saved.map_err(|reason| EnsembleError::Received { rank, reason })?;
            Ok::<_, EnsembleError>(Results::of(plan, shard, slots))
        });
        let shards: Vec<Results> = [Ok(own)].into_iter().chain(others).collect::<Result<_, _>>()?;
        Results::merge(shards).map(Some)
    }
}

fn receive<C: Communicator>(world: &C, rank: i32, length: u64) -> Vec<u8> {
    let mut bytes = vec![0; length as usize];
    for piece in bytes.chunks_mut(PIECE) {
        world.process_at_rank(rank).receive_into(piece);
    }
    bytes
}
