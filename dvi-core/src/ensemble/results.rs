//! The records of all members: put together from shards, and written as tables.

mod columns;
mod npy;

use std::borrow::ToOwned;
use std::io::{self, Write};
use std::path::Path;
use std::string::{String, ToString};
use std::vec::Vec;

use super::error::{EnsembleError, MergeError};
use super::file::{self, Saved};
use super::group::{Place, Slot};
use super::member::Member;
use super::plan::Plan;
use super::{Outcome, Shard};
use columns::{Cell, columns};

/// The members of an ensemble, or of a shard, in order.
#[derive(Clone, Debug)]
pub struct Results {
    plan: Plan,
    shard: Shard,
    members: Vec<Member>,
}

impl Results {
    /// The results of the members that have ended.
    pub(super) fn of(plan: Plan, shard: Shard, slots: Vec<Slot>) -> Self {
        let members = slots.into_iter().filter_map(|slot| match slot.place {
            Place::Ended(member) => Some(member),
            Place::Waiting | Place::UnderWay(_) => None,
        });
        Self { plan, shard, members: members.collect() }
    }

    /// The results in a file.
    pub(super) fn of_file(saved: Saved) -> Self {
        let shard = saved.shard();
        Self::of(saved.plan, shard, saved.slots)
    }

    /// The bytes of the file of these results.
    ///
    /// # Errors
    /// What keeps them from being written.
    #[cfg(feature = "mpi")]
    pub(super) fn encoded(&self) -> io::Result<Vec<u8>> {
        let slot = |member: &Member| Slot { number: member.number, place: Place::Ended(member.clone()) };
        let slots: Vec<Slot> = self.members.iter().map(slot).collect();
        file::encode(&self.plan, self.shard, &slots)
    }

    /// Reads the results of a shard from its [checkpoint](super::Ensemble::checkpoints), to be [put
    /// together](Self::merge) with others.
    ///
    /// # Errors
    /// [`EnsembleError::UnderWay`] if the shard has not ended; [`EnsembleError::File`] and
    /// [`EnsembleError::Damaged`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, EnsembleError> {
        let path = path.as_ref();
        let Some(saved) = file::read(path)? else {
            let source = io::Error::from(io::ErrorKind::NotFound);
            return Err(EnsembleError::File { path: path.to_owned(), source });
        };
        let members = saved.slots.len();
        let results = Self::of_file(saved);
        let ended = results.members.len();
        if ended < members {
            return Err(EnsembleError::UnderWay { path: path.to_owned(), ended, members });
        }
        Ok(results)
    }

    /// Puts the results of all shards together, in any order: they are then, bit for bit, those of the
    /// whole.
    ///
    /// # Errors
    /// [`MergeError`] if they are seen to belong to different ensembles, as [a
    /// checkpoint](super::Ensemble::checkpoints) is, if a member occurs twice, or if one is missing.
    pub fn merge(shards: impl IntoIterator<Item = Self>) -> Result<Self, MergeError> {
        let mut shards = shards.into_iter();
        let mut whole = shards.next().ok_or(MergeError::Nothing)?;
        for Self { plan, shard, members } in shards {
            if let Some(difference) = whole.plan.difference(&plan) {
                return Err(MergeError::Foreign { shard, difference });
            }
            whole.members.extend(members);
        }
        whole.members.sort_by_key(|member| member.number);
        whole.shard = Shard::WHOLE;
        for (expected, Member { number, .. }) in (0..).zip(&whole.members) {
            if *number < expected {
                return Err(MergeError::Twice { member: *number });
            }
            if *number > expected {
                return Err(MergeError::Missing { member: expected, members: whole.plan.members });
            }
        }
        let found = whole.members.len() as u64;
        if found < whole.plan.members {
            return Err(MergeError::Missing { member: found, members: whole.plan.members });
        }
        Ok(whole)
    }

    /// The members, in the order of their numbers.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// The shard that they are.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// The names of the entries of a state.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.plan.names.iter().map(String::as_str)
    }

    /// Writes a table in CSV, with a line for each member. Its numbers can be read back without a rounding
    /// error, and [`Table::states`](super::Table::states) reads the last states.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_csv(&self, to: impl Write) -> io::Result<()> {
        let columns = columns(&self.plan);
        let mut writer = csv::Writer::from_writer(to);
        writer.write_record(columns.iter().map(|column| &column.name)).map_err(io::Error::from)?;
        for member in &self.members {
            writer
                .write_record(columns.iter().map(|column| column.cell(member).to_string()))
                .map_err(io::Error::from)?;
        }
        writer.flush()
    }

    /// Writes an array of records in the format of NumPy, with the columns of the CSV as its fields, but for
    /// the texts of `run.reason`: `numpy.load(file)["energy.last"]`. `run.outcome` is 0 if the member
    /// finished, 1 if it exited, 2 if it failed. An exponent that is none is not a number.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_npy(&self, mut to: impl Write) -> io::Result<()> {
        let mut columns = columns(&self.plan);
        columns.retain(|column| column.kind.is_some());
        to.write_all(&npy::head(&columns, self.members.len())?)?;
        for member in &self.members {
            for column in &columns {
                match column.cell(member) {
                    Cell::Number(number) => to.write_all(&number.to_le_bytes())?,
                    Cell::Count(count) => to.write_all(&count.to_le_bytes())?,
                    Cell::Outcome(Outcome::Finished) => to.write_all(&[0])?,
                    Cell::Outcome(Outcome::Exited { .. }) => to.write_all(&[1])?,
                    Cell::Outcome(Outcome::Failed { .. }) => to.write_all(&[2])?,
                    Cell::None => to.write_all(&f64::NAN.to_le_bytes())?,
                    Cell::Text(_) => {}
                }
            }
        }
        to.flush()
    }
}
