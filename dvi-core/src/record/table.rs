//! The record itself: columns, what is known of them, and where they are written.

use std::string::String;
use std::vec::Vec;

use super::RecordError;
use super::body::{self, Body};
use super::column::{Column, Values};

/// A table of named columns, all of one length, and what it knows of the motion: which columns are the
/// positions of bodies.
///
/// It is what [`record`](super::Recorded::record), a [`Recorder`](super::Recorder) or an ensemble makes; or
/// begin with [`new`](Self::new) and add columns. This pendulum is declared by its angle, and shown in its
/// plane:
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::record::Recorder;
///
/// #[lagrangian(coordinates(angle), lagrangian = dot(angle).powi(2) / 2.0 + 9.81 * angle.cos())]
/// struct Pendulum;
///
/// let start = PendulumState { angle: 2.0, dot_angle: 0.0 };
/// let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), 0.01, start)?;
/// let record = Recorder::new(&Pendulum)
///     .with_function("bob_x", |_, state, _| state.angle.sin())?
///     .with_function("bob_y", |_, state, _| -state.angle.cos())?
///     .record(&mut run, 1, 1000)?
///     .with_title("A pendulum of length 1 m")
///     .with_unit("time", "s")?
///     .with_unit("angle", "rad")?;
/// let mut page = Vec::new();
/// record.write_page(&mut page)?; // its angle and energy over time, and the bob as it moves
/// # let text = String::from_utf8(page)?;
/// # assert!(text.contains("A pendulum of length 1 m") && text.contains("bob_x"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    title: String,
    pub(super) columns: Vec<Column>,
    /// Those of unit vectors and rotations, which no names tell.
    pub(super) turning: Vec<Body>,
    /// Those that the user has named.
    named: Vec<Body>,
}

impl Record {
    /// A record without columns. The title stands above its [page](Self::write_page).
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// The same with another title; that of a run is the name of the system.
    pub fn with_title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The same with a column more.
    ///
    /// # Errors
    /// [`RecordError::Duplicate`] if there is one of this name, [`RecordError::Rows`] if it is longer or
    /// shorter than those that there are.
    pub fn with_column(mut self, column: Column) -> Result<Self, RecordError> {
        let name = &column.name;
        if self.columns.iter().any(|other| other.name == *name) {
            return Err(RecordError::Duplicate { name: name.clone() });
        }
        let (found, expected) = (column.len(), self.rows());
        if found != expected && !self.columns.is_empty() {
            return Err(RecordError::Rows { name: name.clone(), found, expected });
        }
        self.columns.push(column);
        Ok(self)
    }

    /// The same with the unit of a column, such as `"m/s"`, for the axes of the [page](Self::write_page).
    ///
    /// # Errors
    /// [`RecordError::Missing`].
    pub fn with_unit(mut self, column: &str, unit: impl Into<String>) -> Result<Self, RecordError> {
        let place = self.place(column)?;
        self.columns[place].unit = unit.into();
        Ok(self)
    }

    /// The same with a body whose position is in two or three columns, for the [page](Self::write_page).
    ///
    /// If none is named, the bodies are those whose coordinates, or functions of yours, have names that are
    /// alike but for the letters `x`, `y` and perhaps `z` at their beginning or end, as `x[3]` and `y[3]`,
    /// `x2` and `y2`, `sun_x` and `sun_y`; and unit vectors and the three axes of rotations. The array
    /// `r[3]` is none, since its numbers may be three angles as well: where it is a position, name it.
    ///
    /// # Errors
    /// [`RecordError::Missing`]; [`RecordError::Texts`] if a column has no numbers; [`RecordError::Body`] if
    /// there are not two or three.
    pub fn with_body(mut self, name: impl Into<String>, position: &[&str]) -> Result<Self, RecordError> {
        let name = name.into();
        if !matches!(position.len(), 2 | 3) {
            return Err(RecordError::Body { name, columns: position.len() });
        }
        for column in position {
            self.numbers(column)?;
        }
        let position = position.iter().map(|&column| column.into()).collect();
        self.named.push(Body { name, position, is_arm: false });
        Ok(self)
    }

    /// The title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The columns, in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The length of the columns.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Column::len)
    }

    /// The bodies that move in a plane or in space: those that were named, or those that names tell.
    pub(super) fn bodies(&self) -> Vec<Body> {
        if self.named.is_empty() { body::told(&self.columns, &self.turning) } else { self.named.clone() }
    }

    /// A column.
    ///
    /// # Errors
    /// [`RecordError::Missing`].
    pub fn column(&self, name: &str) -> Result<&Column, RecordError> {
        self.place(name).map(|place| &self.columns[place])
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// [`RecordError::Missing`]; [`RecordError::Texts`] if it holds counts or texts.
    pub fn numbers(&self, name: &str) -> Result<&[f64], RecordError> {
        match &self.column(name)?.values {
            Values::Numbers(numbers) => Ok(numbers),
            Values::Counts(_) | Values::Texts(_) => Err(RecordError::Texts { name: name.into() }),
        }
    }

    fn place(&self, name: &str) -> Result<usize, RecordError> {
        self.columns.iter().position(|column| column.name == name).ok_or_else(|| {
            let names: Vec<&str> = self.columns.iter().map(|column| &column.name[..]).collect();
            RecordError::Missing { name: name.into(), columns: names.join(", ") }
        })
    }
}
