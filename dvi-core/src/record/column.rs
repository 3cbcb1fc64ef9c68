//! The columns of a record.

use std::string::String;
use std::vec::Vec;

use serde::Serialize;

/// A named column of a record.
///
/// ```
/// use dvi_core::record::{Column, Record, Values};
///
/// let speed = Column::new("speed", vec![1.5, 2.5]);
/// assert_eq!(speed.name, "speed");
/// assert_eq!(speed.values, Values::Numbers(vec![1.5, 2.5]));
/// let record = Record::new("Two runs").with_column(speed)?.with_unit("speed", "m/s")?;
/// assert_eq!(record.column("speed")?.unit, "m/s");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Column {
    /// The name.
    pub name: String,
    /// What it is.
    pub quantity: Quantity,
    /// Its unit; empty if [nobody has said](super::Record::with_unit) it.
    pub unit: String,
    /// The values.
    pub values: Values,
}

/// What a column is, which decides where it stands on a page.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// use dvi_core::record::Quantity;
///
/// let record = Integrator::new(&Kepler, Variational::trapezoid(), 0.01, start)?.record(1, 10)?;
/// assert_eq!(record.column("dot_x")?.quantity, Quantity::Velocity);
/// assert_eq!(record.column("angular")?.quantity, Quantity::Momentum);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Quantity {
    /// The time: rows are states of a motion, one after the other.
    Time,
    /// A coordinate.
    Coordinate,
    /// A velocity.
    Velocity,
    /// The energy.
    Energy,
    /// A momentum.
    Momentum,
    /// A parameter, which was swept.
    Parameter,
    /// Anything else, such as a function of the user's.
    #[default]
    Other,
}

/// The values of a column.
///
/// ```
/// use dvi_core::record::{Column, Values};
///
/// let column = Column::new("steps", vec![100_u64, 200]);
/// let Values::Counts(steps) = column.values else { panic!("counts") };
/// assert_eq!(steps.iter().sum::<u64>(), 300);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Values {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Counts.
    Counts(Vec<u64>),
    /// Texts.
    Texts(Vec<String>),
}

impl Column {
    /// A column of a name and values, `Vec<f64>`, `Vec<u64>` or `Vec<String>`.
    pub fn new(name: impl Into<String>, values: impl Into<Values>) -> Self {
        let (quantity, unit) = (Quantity::default(), String::new());
        Self { name: name.into(), quantity, unit, values: values.into() }
    }

    /// The same as a column of another quantity than [`Quantity::Other`].
    pub fn with_quantity(mut self, quantity: Quantity) -> Self {
        self.quantity = quantity;
        self
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        match &self.values {
            Values::Numbers(numbers) => numbers.len(),
            Values::Counts(counts) => counts.len(),
            Values::Texts(texts) => texts.len(),
        }
    }
}

impl From<Vec<f64>> for Values {
    fn from(numbers: Vec<f64>) -> Self {
        Self::Numbers(numbers)
    }
}

impl From<Vec<u64>> for Values {
    fn from(counts: Vec<u64>) -> Self {
        Self::Counts(counts)
    }
}

impl From<Vec<String>> for Values {
    fn from(texts: Vec<String>) -> Self {
        Self::Texts(texts)
    }
}
