//! A run as data: where it is, and all that its next step depends on.

use alloc::vec::Vec;

use crate::error::{CheckpointError, StartError};
use crate::methods::{Carries, Clock, Method};
use crate::run::Stepper;
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::state::memory::{Memory, Reader, Record};
use crate::system::start::velocities;
use crate::{Lagrangian, Real, Space, Vector};

/// A run as data. From it [`Integrator::resume`](crate::run::Integrator::resume) and
/// [`ControlledIntegrator::resume`](crate::run::ControlledIntegrator::resume) go on, bit by bit as if the run had not stopped, on
/// the same system and with the same method; with another step or other parameters they go on from the same momenta.
///
/// With the feature `serde` it can be written to a file. A text format must write numbers so that they can be read back
/// without a rounding error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Checkpoint<T = f64> {
    /// The coordinates, flat, in the order of declaration.
    pub q: Vec<T>,
    /// The velocities of a regular system; nothing for a degenerate one.
    pub v: Vec<T>,
    /// The time.
    pub time: T,
    /// The length of the step: the next one of a fixed step, the latest of a controlled one.
    pub step_size: T,
    /// What the run has cost.
    pub statistics: Statistics,
    record: Record<T>,
}

impl<T: Real> Checkpoint<T> {
    /// Of a run whose clock and control are saved by `save`.
    pub(crate) fn of<S: Lagrangian, M: Method<S, T>>(
        stepper: &Stepper<'_, S, M, T>,
        [time, step_size]: [T; 2],
        save: impl FnOnce(&mut Record<T>),
    ) -> Self {
        let mut record = Record::new();
        stepper.memory.save(&mut record);
        save(&mut record);
        let v = stepper.with_velocity(time, |v| v.to_vec());
        Self { q: stepper.q.to_vec(), v, time, step_size, statistics: stepper.statistics, record }
    }

    /// A checkpoint from which a run with a fixed step goes on with steps of length `h`.
    #[must_use]
    pub fn with_step_size(self, h: T) -> Self {
        Self { step_size: h, ..self }
    }

    /// The coordinates and velocities, for `system`.
    pub(crate) fn point<S: Lagrangian>(&self, system: &S) -> Result<[Vector<S, T>; 2], StartError> {
        let (expected, found) = (system.space().dimension(), self.q.len());
        if found != expected || self.v.len() != velocities(system) {
            return Err(CheckpointError::Coordinates { expected, found }.into());
        }
        if let Some(coordinate) = self.q.iter().chain(&self.v).position(|x| !x.is_finite()) {
            let value = self.q.iter().chain(&self.v).nth(coordinate).copied().map_or(f64::NAN, reported);
            return Err(StartError::NotFinite { coordinate, value });
        }
        if self.statistics.steps > u64::MAX / 2 {
            return Err(CheckpointError::Damaged.into());
        }
        let (mut q, mut v): (Vector<S, T>, Vector<S, T>) = (system.space().vector(), system.space().vector());
        q.copy_from_slice(&self.q);
        v[..self.v.len()].copy_from_slice(&self.v);
        Ok([q, v])
    }

    /// Loads what has been saved into `memory`, and the rest by `load`.
    pub(crate) fn load<S: Lagrangian, M: Carries<S, T>>(
        &self,
        memory: &mut M::Memory,
        load: impl FnOnce(&mut Reader<'_, T>) -> Result<(), CheckpointError>,
    ) -> Result<(), StartError> {
        let mut reader = self.record.reader();
        memory.load(&mut reader)?;
        load(&mut reader)?;
        Ok(reader.end()?)
    }
}

impl<T: Real> Clock<T> {
    /// The clock of a checkpoint, saved at the start of the run.
    pub(crate) fn save(self, record: &mut Record<T>) {
        record.numbers(&[self.start, self.h]);
        record.count(self.step);
    }

    /// The clock of a run that goes on from a checkpoint, from the present time if the step is another one.
    pub(crate) fn load(
        checkpoint: &Checkpoint<T>,
        reader: &mut Reader<'_, T>,
    ) -> Result<Self, CheckpointError> {
        let mut numbers = [T::lift(0.0); 2];
        reader.numbers(&mut numbers)?;
        let ([start, h], step) = (numbers, reader.count()?);
        if h == checkpoint.step_size {
            return Ok(Self { start, h, step });
        }
        // No steps have been taken with this one.
        let step = 0_u64.wrapping_sub(checkpoint.statistics.steps);
        Ok(Self { start: checkpoint.time, h: checkpoint.step_size, step })
    }
}
