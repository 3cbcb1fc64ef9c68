//! A run as data: where it is, and all that its next step depends on.

use alloc::vec::Vec;

use crate::error::{CheckpointError, StartError};
use crate::memory::{Memory, Record};
use crate::state::Statistics;
use crate::state::fingerprint::Fingerprint;
use crate::system::start::{evaluate, finite, velocities};
use crate::{Lagrangian, Real, Space, Vector};

/// A run as data. From it [`Integrator::resume`](crate::run::Integrator::resume) and
/// [`Integrator::resume_controlled`](crate::run::Integrator::resume_controlled) go on, bit by bit as if the
/// run had not stopped: on a system with the same parameters, and with the same method and options. That
/// they are the same is not checked beyond the amount of what they carry.
///
/// With the feature `serde` it can be written to a file. A text format must write and read numbers without
/// a rounding error; `serde_json` does it with its feature `float_roundtrip`. A checkpoint has a checksum,
/// and to read one whose numbers have changed is an error of the reader with the text of
/// [`CheckpointError::Changed`].
///
/// With other parameters a run begins anew, at the time and in the state of the one before. Here a spring is
/// stiffened half way, and the error stays of the order of the method:
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
/// struct Spring {
///     k: f64,
/// }
///
/// /// Where the run is after five units of time with k = 1, and five with k = 4.
/// fn end(steps: u64) -> Result<f64, Box<dyn std::error::Error>> {
///     let [soft, stiff] = [Spring { k: 1.0 }, Spring { k: 4.0 }];
///     let (method, h) = (Variational::trapezoid(), 5.0 / steps as f64);
///     let mut run = Integrator::new(&soft, method, h, SpringState { x: 1.0, dot_x: 0.0 })?;
///     run.take_steps(steps)?;
///     let mut run = Integrator::new_at(&stiff, method, run.time(), run.step_size(), run.state())?;
///     run.take_steps(steps)?;
///     let state: SpringState = run.state();
///     Ok(state.x)
/// }
///
/// let exact = 5_f64.cos() * 10_f64.cos() - 5_f64.sin() / 2.0 * 10_f64.sin();
/// let [coarse, fine] = [(end(200)? - exact).abs(), (end(400)? - exact).abs()];
/// assert!((3.9..4.1).contains(&(coarse / fine)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The velocities are those of the state. Where masses change, the momenta change with them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Sealed<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Checkpoint<T = f64>(Sealed<T>);

/// What a checkpoint holds. Of one that has just been read the checksum may be wrong.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Sealed<T> {
    q: Vec<T>,
    v: Vec<T>,
    /// How many velocities a state of the system has, of which `v` has all or none.
    velocities: u64,
    time: T,
    step_size: T,
    statistics: Statistics,
    record: Record<T>,
    checksum: u64,
}

impl<T: Real> Sealed<T> {
    fn with_checksum(mut self) -> Self {
        self.checksum = self.fingerprint();
        self
    }

    /// The checksum that belongs to the rest: 53 bits, as many as the numbers of any format have.
    fn fingerprint(&self) -> u64 {
        let Self { q, v, velocities, time, step_size, statistics, record, checksum: _ } = self;
        let (numbers, counts) = record.parts();
        let mut fingerprint = Fingerprint::new();
        for list in [&q[..], &v[..], &[*time, *step_size], numbers] {
            fingerprint.word(list.len() as u64);
            list.iter().for_each(|&number| fingerprint.real(number));
        }
        fingerprint.word(*velocities);
        statistics.counts().iter().chain(counts).for_each(|&count| fingerprint.word(count));
        fingerprint.value() >> 11
    }
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Sealed<T>> for Checkpoint<T> {
    type Error = CheckpointError;

    fn try_from(read: Sealed<T>) -> Result<Self, CheckpointError> {
        if read.checksum == read.fingerprint() { Ok(Self(read)) } else { Err(CheckpointError::Changed) }
    }
}

/// No run has come so far.
const BEYOND: u64 = u64::MAX / 2;

impl<T: Real> Checkpoint<T> {
    /// Of a run that has saved what it carries.
    pub(crate) fn of(
        [q, v]: [&[T]; 2],
        [time, step_size]: [T; 2],
        statistics: Statistics,
        record: Record<T>,
    ) -> Self {
        let velocities = v.len() as u64;
        let v = if v.iter().all(|v| v.is_finite()) { v } else { &[] };
        let [q, v] = [q.to_vec(), v.to_vec()];
        let sealed = Sealed { q, v, velocities, time, step_size, statistics, record, checksum: 0 };
        Self(sealed.with_checksum())
    }

    /// The coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.0.q
    }

    /// The velocities of a regular system; empty for a degenerate one, and where the momenta of the run have
    /// no velocity.
    pub fn v(&self) -> &[T] {
        &self.0.v
    }

    /// The time.
    pub fn time(&self) -> T {
        self.0.time
    }

    /// The length of the step: the next one of a fixed step, the latest of a controlled one.
    pub fn step_size(&self) -> T {
        self.0.step_size
    }

    /// What the run has cost.
    pub fn statistics(&self) -> Statistics {
        self.0.statistics
    }

    /// A checkpoint from which a run with a fixed step goes on with steps of length `h`. The defect of a run
    /// of [`Sigma`](crate::methods::Sigma) belongs to its step: with another one it becomes a parasitic
    /// mode, unless α is affine and σ = ½. Begin such a run anew.
    #[must_use]
    pub fn with_step_size(self, h: T) -> Self {
        Self(Sealed { step_size: h, ..self.0 }.with_checksum())
    }

    /// Whether a run can go on from there: not where what it carries is no number, as an infinite force is.
    pub(crate) fn goes_on(&self) -> bool {
        self.0.record.is_finite()
    }

    /// The coordinates and velocities, for `system`, if all numbers and counts are those of a run.
    pub(crate) fn point<S: Lagrangian<T>>(&self, system: &S) -> Result<[Vector<S, T>; 2], StartError> {
        let Sealed { v: known, velocities: found, .. } = &self.0;
        let of_q = ("coordinates", system.space().dimension(), self.0.q.len());
        let of_v = ("velocities", velocities(system), *found as usize);
        if let Some((what, expected, found)) = [of_q, of_v].into_iter().find(|(_, a, b)| a != b) {
            return Err(CheckpointError::Size { what, expected, found }.into());
        }
        let [mut q, mut v]: [Vector<S, T>; 2] = system.space().vectors();
        q.copy_from_slice(&self.0.q);
        let is_damaged = self.0.statistics.counts().iter().any(|&count| count > BEYOND);
        if is_damaged || !(known.is_empty() || known.len() == velocities(system)) {
            return Err(CheckpointError::Damaged.into());
        }
        v[..known.len()].copy_from_slice(known);
        finite(system, &q, &v)?;
        if !self.goes_on() {
            // As a force that is infinite there.
            evaluate(system, &q, &v[..velocities(system)], self.0.time)?;
            return Err(CheckpointError::Damaged.into());
        }
        Ok([q, v])
    }

    /// Loads what has been saved, if it is as much as `carried` saves.
    pub(crate) fn load(&self, carried: &mut impl Memory<T>) -> Result<(), CheckpointError> {
        let (mut record, mut expected) = (self.0.record.clone(), Record::new());
        carried.save(&mut expected);
        record.fits(&expected)?;
        carried.load(&mut record)
    }
}
