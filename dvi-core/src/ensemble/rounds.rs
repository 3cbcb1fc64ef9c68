//! An ensemble on all cores, round after round. Between two rounds nobody else is at work: then checkpoints
//! are written, and progress is told.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::vec::Vec;

use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;

use super::error::EnsembleError;
use super::file;
use super::group::{Place, Slot};
use super::plan::Plan;
use super::{Progress, Results, Shard, Tell};

/// How often progress is told.
const PROGRESS: Duration = Duration::from_secs(1);

/// Takes the members of a group on, until they have ended or this says that they are interrupted: whatever
/// the systems and the method are.
type Advance<'w> = dyn Fn(&mut [Slot], &dyn Fn() -> bool) -> Result<(), EnsembleError> + Sync + 'w;

/// The file of a checkpoint, and how often it is written.
pub(super) struct Checkpoints {
    pub(super) path: PathBuf,
    pub(super) every: Duration,
}

/// The members of a shard, and how far they have got.
pub(super) struct Rounds {
    pub(super) plan: Plan,
    pub(super) shard: Shard,
    pub(super) slots: Vec<Slot>,
}

impl Rounds {
    /// Those that wait, or as the checkpoint has left them.
    pub(super) fn begin(
        plan: Plan,
        shard: Shard,
        checkpoints: Option<&Checkpoints>,
    ) -> Result<Self, EnsembleError> {
        let saved = checkpoints.map(|Checkpoints { path, .. }| Ok((path, file::read(path)?))).transpose()?;
        let Some((path, Some((saved_plan, saved_shard, slots)))) = saved else {
            let waiting = |number| Slot { number, place: Place::Waiting };
            let slots = (0..plan.members).filter(|&number| shard.contains(number)).map(waiting).collect();
            return Ok(Self { plan, shard, slots });
        };
        let of_shard = super::error::Difference {
            what: "shard".into(),
            expected: std::format!("{shard}"),
            found: std::format!("{}", saved_shard),
        };
        let other_shard = (saved_shard != shard).then_some(of_shard);
        match plan.difference(&saved_plan).or(other_shard) {
            Some(difference) => Err(EnsembleError::Foreign { path: path.clone(), difference }),
            None => Ok(Self { plan, shard, slots }),
        }
    }

    /// Goes on until all members have ended, with so many in a group.
    pub(super) fn run(
        mut self,
        work: (usize, &Advance<'_>),
        checkpoints: Option<&Checkpoints>,
        mut on_progress: Option<Tell<'_>>,
    ) -> Result<Results, EnsembleError> {
        // A path that cannot be written to shows before the work is done.
        self.write(checkpoints)?;
        let mut written = Instant::now();
        while !self.slots.iter().all(Slot::has_ended) {
            self.tell(&mut on_progress);
            let rest = checkpoints.map(|checkpoints| checkpoints.every.saturating_sub(written.elapsed()));
            let length = on_progress.as_ref().map(|_| PROGRESS).into_iter().chain(rest).min();
            self.round(work, length)?;
            if checkpoints.is_some_and(|checkpoints| written.elapsed() >= checkpoints.every) {
                self.write(checkpoints)?;
                written = Instant::now();
            }
        }
        self.write(checkpoints)?;
        self.tell(&mut on_progress);
        Ok(Results::of(self.plan, self.shard, self.slots))
    }

    /// Takes members on until they have ended or, if the round has a `length`, it is over. In each round at
    /// least one of them gets on.
    fn round(
        &mut self,
        (group, advance): (usize, &Advance<'_>),
        length: Option<Duration>,
    ) -> Result<(), EnsembleError> {
        let begin = Instant::now();
        let is_over = || length.is_some_and(|length| begin.elapsed() >= length);
        let has_begun = AtomicBool::new(false);
        self.slots.par_chunks_mut(group).with_max_len(1).try_for_each(|group| {
            if group.iter().all(Slot::has_ended) || (has_begun.swap(true, Ordering::Relaxed) && is_over()) {
                return Ok(());
            }
            advance(group, &is_over)
        })
    }

    fn write(&self, checkpoints: Option<&Checkpoints>) -> Result<(), EnsembleError> {
        checkpoints.map_or(Ok(()), |Checkpoints { path, .. }| {
            file::write(path, &self.plan, self.shard, &self.slots)
        })
    }

    fn tell(&self, on_progress: &mut Option<Tell<'_>>) {
        let Some(on_progress) = on_progress else { return };
        on_progress(&Progress {
            members: self.slots.len() as u64,
            ended: self.slots.iter().filter(|slot| slot.has_ended()).count() as u64,
            steps: self.slots.iter().map(|slot| u128::from(slot.steps())).sum(),
        });
    }
}
