//! What writes down states: those of a run, or any that come with a time.

use std::boxed::Box;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use super::body::Body;
use super::column::{Column, Quantity, Values};
use super::{Record, RecordError};
use crate::error::LengthError;
use crate::run::Run;
use crate::shown::shown;
use crate::system::{Factor, Name};
use crate::{Lagrangian, Space, State};

type Function<'f, S, Q> = Box<dyn FnMut(&S, &Q, f64) -> f64 + 'f>;

/// Writes down states of a system: the time, the entries of the state, energy, momenta, and functions of
/// the user's.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// use dvi_core::record::Recorder;
///
/// let mut run = Integrator::new(&Kepler, Gauss::<4>::new(), 0.05, start)?;
/// let recorder = || Recorder::new(&Kepler).with_function("radius", |_, state, _| state.x.hypot(state.y));
/// let record = recorder()?.record(&mut run, 10, 100)?; // now, and 100 times after 10 steps each
/// let farthest = record.numbers("radius")?.iter().fold(0.0_f64, |a, b| a.max(*b));
/// assert!((farthest - 2.57).abs() < 0.01); // the apocentre, 1.44/0.56
///
/// let mut passages = recorder()?;
/// for passage in run.events([Direction::Rising], |_, state| [state.y])?.take(3) {
///     let passage = passage?;
///     passages.push(&Kepler, passage.time, &passage.state)?;
/// }
/// // Each at the pericentre.
/// assert!(passages.finish().numbers("radius")?.iter().all(|radius| (radius - 1.0).abs() < 1e-4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Recorder<'f, S: Lagrangian> {
    record: Record,
    /// Those of the system that the columns are for.
    lengths: Vec<usize>,
    functions: Vec<Function<'f, S, S::State<f64>>>,
}

/// Runs that can be recorded: all whose numbers are `f64`.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// let mut run = Integrator::new(&Kepler, Variational::trapezoid(), 0.01, start)?;
/// let record = run.record(10, 200)?; // now, and 200 times after 10 steps each
/// assert_eq!(record.numbers("time")?.last(), Some(&20.0));
/// let mut csv = Vec::new();
/// record.write_csv(&mut csv)?;
/// assert!(csv.starts_with(b"time,x,y,dot_x,dot_y,energy,angular\n0.0,1.0,0.0,"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Recorded: Run<Scalar = f64> + Sized {
    /// Takes `rows` times `every` steps, and records the present state and the one after each `every` steps:
    /// `rows` + 1 rows. The page on the [module](crate::record) shows it.
    ///
    /// # Errors
    /// [`RecordError::Every`] if `every` is zero. If a step fails, [`RecordError::Step`] holds the record up
    /// to there, and the run stays at the last good state.
    fn record(&mut self, every: u64, rows: u64) -> Result<Record, RecordError> {
        Recorder::new(self.system()).record(self, every, rows)
    }
}

impl<R: Run<Scalar = f64>> Recorded for R {}

impl<'f, S: Lagrangian> Recorder<'f, S> {
    /// A recorder without rows, for states of systems whose arrays are as long as those of `system`.
    pub fn new(system: &S) -> Self {
        let column = |name, quantity| Column::new(name, Vec::<f64>::new()).with_quantity(quantity);
        let entry = |name: Name| {
            let quantity = if name.is_velocity { Quantity::Velocity } else { Quantity::Coordinate };
            column(name.to_string(), quantity)
        };
        let mut columns: Vec<Column> = system.names().map(entry).collect();
        let entries = columns.len();
        let momenta = S::REPORT.momenta.iter().map(|&name| (name, Quantity::Momentum));
        for (name, quantity) in
            [("time", Quantity::Time), ("energy", Quantity::Energy)].into_iter().chain(momenta)
        {
            let mut name = name.to_string();
            while columns.iter().any(|column| column.name == name) {
                name.insert_str(0, "run.");
            }
            columns.push(column(name, quantity));
        }
        // The time comes first.
        columns[..=entries].rotate_right(1);
        let mut record = Record::new(S::REPORT.system);
        (record.columns, record.turning) = (columns, turning(system));
        Self { record, lengths: system.lengths().collect(), functions: Vec::new() }
    }

    /// The same with a column more: a function of the system, the state and the time.
    ///
    /// # Errors
    /// [`RecordError::Duplicate`] if there is a column of this name; [`RecordError::Rows`] if there are rows
    /// already.
    pub fn with_function(
        mut self,
        name: impl Into<String>,
        function: impl FnMut(&S, &S::State<f64>, f64) -> f64 + 'f,
    ) -> Result<Self, RecordError> {
        self.record = self.record.with_column(Column::new(name, Vec::<f64>::new()))?;
        self.functions.push(Box::new(function));
        Ok(self)
    }

    /// Adds a row: a state of `system` at a time.
    ///
    /// # Errors
    /// [`RecordError::State`] if an array of the state does not have the length that `system` declares, or
    /// that the system of [`new`](Self::new) does; [`RecordError::Index`] if a parameter array of `system`
    /// is too short. There is no row then.
    pub fn push(&mut self, system: &S, time: f64, state: &S::State<f64>) -> Result<(), RecordError> {
        system.check()?;
        let (mut q, mut v) = (system.space().vector(), system.space().vector());
        state.write(&|block| system.block_len(block), &mut q, &mut v)?;
        Ok(self.add(system, time, state, [&q, &v])?)
    }

    /// Adds a row for where a run is: as its state is read from its coordinates, so are the entries.
    fn add_present(&mut self, run: &impl Run<System = S, Scalar = f64>) -> Result<(), LengthError> {
        self.add(run.system(), run.time(), &run.state(), [run.q(), &run.v()])
    }

    /// Adds a row for a state in both forms.
    fn add(
        &mut self,
        system: &S,
        time: f64,
        state: &S::State<f64>,
        [q, v]: [&[f64]; 2],
    ) -> Result<(), LengthError> {
        state.write(
            &|block| self.lengths[block],
            &mut system.space().vector(),
            &mut system.space().vector(),
        )?;
        let momentum = |index| system.momentum(index, q, v, time);
        let functions = self.functions.iter_mut().map(|function| function(system, state, time));
        let row = [time]
            .into_iter()
            .chain(system.values_of(q, v))
            .chain([system.energy(q, v, time)])
            .chain((0..S::REPORT.momenta.len()).map(momentum))
            .chain(functions);
        let mut columns = self.record.columns.iter_mut();
        row.for_each(|value| {
            if let Some(Column { values: Values::Numbers(numbers), .. }) = columns.next() {
                numbers.push(value);
            }
        });
        Ok(())
    }

    /// Takes `rows` times `every` steps of `run`, and adds a row for its present state and one after each
    /// `every` steps.
    ///
    /// # Errors
    /// As of [`Recorded::record`]; [`RecordError::State`] if an array of the run does not have the length
    /// that the system of [`new`](Self::new) declares.
    pub fn record<R>(mut self, run: &mut R, every: u64, rows: u64) -> Result<Record, RecordError>
    where
        R: Run<System = S, Scalar = f64>,
    {
        if every == 0 {
            return Err(RecordError::Every);
        }
        self.add_present(run)?;
        for _ in 0..rows {
            if let Err(error) = run.take_steps(every) {
                return Err(RecordError::Step { record: Box::new(self.record), error });
            }
            self.add_present(run)?;
        }
        Ok(self.record)
    }

    /// The record of the rows so far.
    pub fn finish(self) -> Record {
        self.record
    }
}

shown!([S: Lagrangian] Recorder<'_, S>, |recorder| record: recorder.record);

/// The ends of unit vectors, and of the three axes of bodies that turn, in space.
fn turning<S: Lagrangian>(system: &S) -> Vec<Body> {
    let mut bodies = Vec::new();
    let mut names = system.names().filter(|name| !name.is_velocity).peekable();
    while let Some(&first) = names.peek() {
        let is_same =
            |name: &Name| name.block == first.block && (name.index == first.index || first.axis.is_none());
        let entries: Vec<String> =
            std::iter::from_fn(|| names.next_if(is_same)).map(|name| name.to_string()).collect();
        let name = match (first.axis, first.index) {
            (Some(_), Some(index)) => format!("{}[{index}]", first.block),
            _ => first.block.into(),
        };
        match (first.factor, &entries[..]) {
            (Factor::Sphere, [_, _, _]) => bodies.push(Body { name, position: entries, is_arm: true }),
            // The columns of the matrix are the axes of the body.
            (Factor::Rotation, [_, _, _, _, _, _, _, _, _]) => {
                bodies.extend((0..3).map(|axis| Body {
                    name: format!("{name}, axis {}", axis + 1),
                    position: [axis, axis + 3, axis + 6].map(|place| entries[place].clone()).into(),
                    is_arm: true,
                }));
            }
            _ => {}
        }
    }
    bodies
}
