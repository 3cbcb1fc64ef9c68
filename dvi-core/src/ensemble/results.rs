//! The records of all members: put together from shards, and as a table.

use std::borrow::ToOwned;
use std::format;
use std::io;
use std::path::Path;
use std::string::String;
use std::vec::Vec;

use super::Shard;
use super::error::EnsembleError;
use super::file;
use super::group::{Place, Slot};
use super::member::Member;
use super::plan::Plan;
use crate::record::{Column, Quantity, Record, RecordError};

/// The members of an ensemble, or of a shard, in order.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use dvi_core::ensemble::{Ensemble};
///
/// let starts = (1..=10).map(|k| PendulumState { angle: 0.1 * f64::from(k), dot_angle: 0.0 });
/// let results = Ensemble::new(&Pendulum, Variational::trapezoid(), 0.1, starts).take_steps(1000)?;
/// assert!(results.members().iter().all(|member| member.steps == 1000));
/// assert_eq!(results.record()?.numbers("angle")?.len(), 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
        let Some((plan, shard, slots)) = file::read(path)? else {
            let source = io::Error::from(io::ErrorKind::NotFound);
            return Err(EnsembleError::File { path: path.to_owned(), source });
        };
        let members = slots.len();
        let results = Self::of(plan, shard, slots);
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
    /// [`EnsembleError`] if they are seen to belong to different ensembles, as [a
    /// checkpoint](super::Ensemble::checkpoints) is, if a member occurs twice, or if one is missing.
    pub fn merge(shards: impl IntoIterator<Item = Self>) -> Result<Self, EnsembleError> {
        let mut shards = shards.into_iter();
        let mut whole = shards.next().ok_or(EnsembleError::Nothing)?;
        for Self { plan, shard, members } in shards {
            if let Some(difference) = whole.plan.difference(&plan) {
                return Err(EnsembleError::ForeignShard { shard, difference });
            }
            whole.members.extend(members);
        }
        whole.members.sort_by_key(|member| member.number);
        whole.shard = Shard::WHOLE;
        for (expected, Member { number, .. }) in (0..).zip(&whole.members) {
            if *number < expected {
                return Err(EnsembleError::Twice { member: *number });
            }
            if *number > expected {
                return Err(EnsembleError::Missing { member: expected, members: whole.plan.members });
            }
        }
        let found = whole.members.len() as u64;
        if found < whole.plan.members {
            return Err(EnsembleError::Missing { member: found, members: whole.plan.members });
        }
        Ok(whole)
    }

    /// The members, in the order of their numbers.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// A record with a row for each member: `write_csv`, `write_npy` and `write_page` of [`Record`] write
    /// it.
    ///
    /// | columns | what is in them |
    /// |---|---|
    /// | `run.member`, `run.steps`, `run.iterations`, `run.time` | what [`Member`] says |
    /// | `run.outcome`, `run.reason` | `finished`, `exited` or `failed`, and the text of the exit condition or of the error |
    /// | `parameter.k` | the [parameters](super::Ensemble::parameter) by their names |
    /// | `energy.first`, `energy.last`, `energy.largest_error` | the energies |
    /// | `momentum.angular.first`, `momentum.angular.last` | the momenta by their names |
    /// | `x`, `dot_x`, … | the last state |
    ///
    /// # Errors
    /// [`RecordError::Duplicate`] if two momenta have one name.
    pub fn record(&self) -> Result<Record, RecordError> {
        let Self { plan, members, .. } = self;
        let counts = |of: fn(&Member) -> u64| members.iter().map(of).collect::<Vec<u64>>();
        let numbers = |of: &dyn Fn(&Member) -> f64| members.iter().map(of).collect::<Vec<f64>>();
        let texts =
            |of: fn(&Member) -> &str| members.iter().map(|one| of(one).to_owned()).collect::<Vec<String>>();
        let mut columns = Vec::from([
            Column::new("run.member", counts(|member| member.number)),
            Column::new("run.outcome", texts(|member| member.outcome.words()[0])),
            Column::new("run.reason", texts(|member| member.outcome.words()[1])),
            Column::new("run.time", numbers(&|member| member.time)),
            Column::new("run.steps", counts(|member| member.steps)),
            Column::new("run.iterations", counts(|member| member.iterations)),
        ]);
        let mut add = |name: String, quantity, of: &dyn Fn(&Member) -> f64| {
            columns.push(Column::new(name, numbers(of)).with_quantity(quantity));
        };
        for (name, values) in &plan.parameters {
            let value = |member: &Member| at(values, member.number as usize);
            add(format!("parameter.{name}"), Quantity::Parameter, &value);
        }
        add("energy.first".into(), Quantity::Energy, &|member| member.energy.first);
        add("energy.last".into(), Quantity::Energy, &|member| member.energy.last);
        add("energy.largest_error".into(), Quantity::Energy, &|member| member.energy.largest_error);
        for (place, name) in plan.momenta.iter().enumerate() {
            for (end, which) in ["first", "last"].into_iter().enumerate() {
                let value = |member: &Member| member.momenta.get(place).map_or(f64::NAN, |ends| ends[end]);
                add(format!("momentum.{name}.{which}"), Quantity::Momentum, &value);
            }
        }
        for (place, name) in plan.names.iter().enumerate() {
            let is_velocity = place >= plan.coordinates;
            let quantity = if is_velocity { Quantity::Velocity } else { Quantity::Coordinate };
            let entry = numbers(&|member| at(&member.state, place));
            columns.push(Column::new(name, entry).with_quantity(quantity));
        }
        columns.into_iter().try_fold(Record::new(&plan.title), Record::with_column)
    }
}

/// An entry; not a number if there is none.
fn at(values: &[f64], place: usize) -> f64 {
    values.get(place).copied().unwrap_or(f64::NAN)
}
