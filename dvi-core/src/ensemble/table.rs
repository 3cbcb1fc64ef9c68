//! Initial conditions and parameters from a table with named columns.

use std::borrow::ToOwned;
use std::io::Read;
use std::string::{String, ToString};
use std::vec::Vec;

use thiserror::Error;

use crate::Lagrangian;

crate::error::said!(TableError);

/// A table in CSV: names in the first line, then a line for each member. Columns that nobody asks for may
/// hold any text, in UTF-8.
///
/// ```
/// use dvi_core::ensemble::Table;
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
/// struct Spring { k: f64 }
///
/// let table = Table::read("k,x,dot_x,remark\n1.0,0.5,0,weak\n4.0,0.25,0,stiff\n".as_bytes())?;
/// let springs: Vec<_> = table.column("k")?.into_iter().map(|k| Spring { k }).collect();
/// let states: Vec<SpringState> = table.states(&springs[0])?;
/// assert_eq!((springs[1].k, states[1].x), (4.0, 0.25));
/// # Ok::<(), dvi_core::ensemble::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Table {
    text: Vec<u8>,
    names: Vec<String>,
    rows: Vec<csv::StringRecord>,
}

/// A table that cannot be read, or does not have what is asked for.
///
/// ```
/// use dvi_core::ensemble::{Table, TableError};
///
/// let table = Table::read("k,x\n1.0,0.5\n4.0,a lot\n".as_bytes())?;
/// let Err(TableError::Number { line, .. }) = table.column("x") else { panic!("text") };
/// assert_eq!(line, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Error)]
#[non_exhaustive]
pub enum TableError {
    /// It is no CSV, a line has more or fewer entries than the first, or reading fails.
    #[error("the table cannot be read: {0}")]
    Csv(#[from] csv::Error),
    /// Two columns have one name.
    #[error("the columns {first} and {second} of the table both have the name `{name}`")]
    Duplicate {
        /// The name.
        name: String,
        /// The first of them, counted from 1.
        first: usize,
        /// The second.
        second: usize,
    },
    /// There is no column of this name.
    #[error("the table has no column `{name}`, only {columns}")]
    Missing {
        /// The name.
        name: String,
        /// Those that it has.
        columns: String,
    },
    /// An entry is no number.
    #[error("line {line}, column `{column}`: `{text}` is no number")]
    Number {
        /// The line, counted from 1; the names are in line 1.
        line: u64,
        /// The name of the column.
        column: String,
        /// The entry.
        text: String,
    },
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// [`TableError::Csv`] and [`TableError::Duplicate`].
    pub fn read(mut from: impl Read) -> Result<Self, TableError> {
        let mut text = Vec::new();
        from.read_to_end(&mut text).map_err(csv::Error::from)?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(&text[..]);
        let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
        for (second, name) in names.iter().enumerate() {
            if let Some(first) = names[..second].iter().position(|other| other == name) {
                let (first, second) = (first + 1, second + 1);
                return Err(TableError::Duplicate { name: name.clone(), first, second });
            }
        }
        let rows = reader.into_records().collect::<Result<_, _>>()?;
        Ok(Self { text, names, rows })
    }

    /// The number of members.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// [`TableError::Missing`] and [`TableError::Number`].
    pub fn column(&self, name: &str) -> Result<Vec<f64>, TableError> {
        let place = self.place(name)?;
        self.rows.iter().map(|row| self.number(row, place)).collect()
    }

    /// The states of a system, from the columns with its [names](crate::System::names); members may have
    /// other parameters than `system` has.
    ///
    /// # Errors
    /// As of [`column`](Self::column).
    pub fn states<S: Lagrangian>(&self, system: &S) -> Result<Vec<S::State<f64>>, TableError> {
        let columns = system.names().map(|name| self.place(&name.to_string()));
        let columns: Vec<usize> = columns.collect::<Result<_, _>>()?;
        let state = |row| {
            let values = columns.iter().map(|&place| self.number(row, place));
            Ok(system.state_of(values.collect::<Result<Vec<f64>, _>>()?))
        };
        self.rows.iter().map(state).collect()
    }

    fn place(&self, name: &str) -> Result<usize, TableError> {
        self.names
            .iter()
            .position(|column| column == name)
            .ok_or_else(|| TableError::Missing { name: name.to_owned(), columns: self.names.join(", ") })
    }

    fn number(&self, row: &csv::StringRecord, place: usize) -> Result<f64, TableError> {
        let text = &row[place];
        text.parse().map_err(|_| TableError::Number {
            line: self.line(row),
            column: self.names[place].clone(),
            text: text.to_owned(),
        })
    }

    /// The line in which a row begins, behind empty ones.
    fn line(&self, row: &csv::StringRecord) -> u64 {
        let (before, rest) = self.text.split_at(row.position().map_or(0, |at| at.byte() as usize));
        let empty = rest.iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
        1 + before.iter().chain(empty).filter(|&&byte| byte == b'\n').count() as u64
    }
}
