//! What keeps something from being recorded.

use std::boxed::Box;
use std::string::String;

use thiserror::Error;

use super::Record;
use crate::error::{IndexError, LengthError, StepError};

crate::error::said!(RecordError);

/// A record that ends early, or that is asked for what it does not have.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// use dvi_core::record::RecordError;
///
/// // A head-on fall: the record up to the step that failed is in the error.
/// let fall = KeplerState { dot_y: 0.0, ..start };
/// let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
/// let mut run = Integrator::new(&Kepler, method, 0.01, fall)?;
/// let Err(RecordError::Step { record, error, .. }) = run.record(1, 1000) else { panic!("it falls") };
/// assert_eq!(record.rows() as u64, error.step + 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A step has failed. What was recorded before is not lost.
    #[error("{error}; {} rows were recorded before", .record.rows())]
    Step {
        /// What was recorded up to the last good state that was to be.
        record: Box<Record>,
        /// Why the step has failed.
        #[source]
        error: StepError,
    },
    /// There are to be no steps between two rows, so that the run would stay where it is.
    #[error("there must be at least one step between two rows")]
    Every,
    /// An array of a state has another length than the system declares, or the one that the columns are for.
    #[error(transparent)]
    State(#[from] LengthError),
    /// A parameter array is too short for the formulas.
    #[error(transparent)]
    Index(#[from] IndexError),
    /// Two columns would have one name.
    #[error("the record already has a column `{name}`")]
    Duplicate {
        /// The name.
        name: String,
    },
    /// There is no column of this name.
    #[error("the record has no column `{name}`, only {columns}")]
    Missing {
        /// The name.
        name: String,
        /// Those that it has.
        columns: String,
    },
    /// A column is longer or shorter than the others.
    #[error("the column `{name}` has {found} rows, and the record has {expected}")]
    Rows {
        /// The name.
        name: String,
        /// Its length.
        found: usize,
        /// That of the others.
        expected: usize,
    },
    /// The column is not one of numbers.
    #[error("the column `{name}` does not hold numbers, but counts or texts")]
    Texts {
        /// The name.
        name: String,
    },
    /// The position of a body does not have two or three coordinates.
    #[error("the position of the body `{name}` has {columns} columns: two in a plane, three in space")]
    Body {
        /// The name.
        name: String,
        /// How many columns were given.
        columns: usize,
    },
}
