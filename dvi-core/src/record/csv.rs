//! Records as tables in CSV: written, and read again.

use std::borrow::ToOwned;
use std::format;
use std::io::{self, Read, Write};
use std::string::{String, ToString};
use std::vec::Vec;

use super::column::{Column, Values};
use super::{Record, RecordError};
use crate::Lagrangian;

impl Record {
    /// Writes a table in CSV: the names, then a line for each row. Its numbers can be read back without a
    /// rounding error; those that are none are `NaN`, `inf` and `-inf`.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_csv(&self, to: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(to);
        writer.write_record(self.columns.iter().map(|column| &column.name)).map_err(io::Error::from)?;
        for row in 0..self.rows() {
            let entries = self.columns.iter().map(|column| match &column.values {
                // As many digits as tell it from its neighbours.
                Values::Numbers(numbers) => format!("{:?}", numbers[row]),
                Values::Counts(counts) => counts[row].to_string(),
                Values::Texts(texts) => texts[row].clone(),
            });
            writer.write_record(entries).map_err(io::Error::from)?;
        }
        writer.flush()
    }

    /// Reads a table in CSV, in UTF-8: names in the first line, then a line for each row. A column holds
    /// numbers if all its entries are numbers, and texts otherwise.
    ///
    /// # Errors
    /// [`RecordError::Csv`], [`RecordError::Quote`] and [`RecordError::Duplicate`].
    ///
    /// ```
    /// use dvi_core::prelude::*;
    /// use dvi_core::record::{Record, RecordError};
    ///
    /// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
    /// struct Spring { k: f64 }
    ///
    /// let table = Record::read_csv("k,x,dot_x,remark\n1.0,0.5,0,weak\n4.0,0.25,0,stiff\n".as_bytes())?;
    /// let springs: Vec<_> = table.numbers("k")?.iter().map(|&k| Spring { k }).collect();
    /// let states: Vec<SpringState> = table.states(&springs[0])?;
    /// assert_eq!((springs[1].k, states[1].x), (4.0, 0.25));
    /// let Err(RecordError::Number { line, .. }) = table.numbers("remark") else { panic!("it is text") };
    /// assert_eq!(line, 2);
    /// # Ok::<(), RecordError>(())
    /// ```
    pub fn read_csv(mut from: impl Read) -> Result<Self, RecordError> {
        let mut text = Vec::new();
        from.read_to_end(&mut text).map_err(csv::Error::from)?;
        if let Some(line) = open_quote(&text) {
            return Err(RecordError::Quote { line });
        }
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(&text[..]);
        let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
        let rows = reader.into_records().collect::<Result<Vec<_>, _>>()?;
        let column = |(place, name): (usize, String)| {
            let entries = || rows.iter().map(|row| &row[place]);
            let numbers = entries().map(number).collect::<Option<Vec<f64>>>();
            let texts = || Values::Texts(entries().map(str::to_owned).collect());
            Column::new(name, numbers.map_or_else(texts, Values::Numbers))
        };
        let columns = names.into_iter().enumerate().map(column);
        let mut record = columns.into_iter().try_fold(Self::default(), Self::with_column)?;
        record.lines = rows.iter().map(|row| line(&text, row)).collect();
        Ok(record)
    }

    /// The states of a system, one for each row, from the columns with its [names](crate::System::names): of
    /// systems with other parameters too.
    ///
    /// # Errors
    /// As of [`numbers`](Self::numbers).
    pub fn states<S: Lagrangian>(&self, system: &S) -> Result<Vec<S::State<f64>>, RecordError> {
        let columns = system.names().map(|name| self.numbers(&name.to_string()));
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let state = |row| system.state_of(columns.iter().map(|column| column[row]).collect::<Vec<f64>>());
        Ok((0..self.rows()).map(state).collect())
    }
}

/// The number that an entry is. Digits of a number beyond all of `f64` are text, and not infinite.
pub(super) fn number(entry: &str) -> Option<f64> {
    let number = entry.parse::<f64>().ok()?;
    (number.is_finite() || !entry.contains(|letter: char| letter.is_ascii_digit())).then_some(number)
}

/// The line of a quote that is opened and not closed, at which a reader takes all that follows for one entry.
fn open_quote(text: &[u8]) -> Option<u64> {
    /// Where in an entry, with the line of the quote that it begins with.
    enum At {
        Begin,
        Within,
        Quoted(u64),
        /// Behind a second quote, unless another one follows.
        Closed(u64),
    }
    let (mut line, mut at) = (1, At::Begin);
    for byte in text {
        at = match (at, byte) {
            (At::Begin, b'"') => At::Quoted(line),
            (At::Quoted(opened), b'"') => At::Closed(opened),
            (At::Closed(opened), b'"') => At::Quoted(opened),
            (At::Quoted(opened), _) => At::Quoted(opened),
            (_, b',' | b'\r' | b'\n') => At::Begin,
            _ => At::Within,
        };
        line += u64::from(*byte == b'\n');
    }
    if let At::Quoted(opened) = at { Some(opened) } else { None }
}

/// The line in which a row begins, behind empty ones.
fn line(text: &[u8], row: &csv::StringRecord) -> u64 {
    let (before, rest) = text.split_at(row.position().map_or(0, |at| at.byte() as usize));
    let empty = rest.iter().take_while(|byte| matches!(byte, b'\r' | b'\n'));
    1 + before.iter().chain(empty).filter(|&&byte| byte == b'\n').count() as u64
}
