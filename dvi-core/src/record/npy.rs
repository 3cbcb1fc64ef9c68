//! An array of records in the format of NumPy, in version 3, whose names are UTF-8.

use std::format;
use std::io::{self, BufWriter, Write};
use std::string::String;
use std::vec::Vec;

use super::Record;
use super::column::{Column, Values};

const MARK: &[u8] = b"\x93NUMPY\x03\x00";
/// The data begin at a multiple of this.
const ALIGNMENT: usize = 64;

impl Record {
    /// Writes an array of records in the format of NumPy, with the columns as its fields:
    /// `numpy.load(file)["energy"]`. Numbers are of type `<f8`, counts `<u8`, and texts `<U…`, which take
    /// four bytes for each letter of the longest one of their column. Where the names of the columns take
    /// more than 10,000 letters, NumPy wants to be told that they may: `numpy.load(file,
    /// max_header_size=10**7)`.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_npy(&self, to: impl Write) -> io::Result<()> {
        let letters: Vec<usize> = self.columns.iter().map(letters).collect();
        let mut to = BufWriter::new(to);
        to.write_all(&head(&self.columns, &letters, self.rows())?)?;
        for row in 0..self.rows() {
            for (column, &letters) in self.columns.iter().zip(&letters) {
                match &column.values {
                    Values::Numbers(numbers) => to.write_all(&numbers[row].to_le_bytes())?,
                    Values::Counts(counts) => to.write_all(&counts[row].to_le_bytes())?,
                    Values::Texts(texts) => {
                        let text = texts[row].chars().map(u32::from);
                        for letter in text.chain(core::iter::repeat(0)).take(letters) {
                            to.write_all(&letter.to_le_bytes())?;
                        }
                    }
                }
            }
        }
        to.flush()
    }
}

/// The letters of the longest text of a column, at least one: there is no type for texts of none.
fn letters(column: &Column) -> usize {
    match &column.values {
        Values::Texts(texts) => texts.iter().map(|text| text.chars().count()).fold(1, usize::max),
        Values::Numbers(_) | Values::Counts(_) => 1,
    }
}

/// What stands before the records: their type as a literal of Python.
fn head(columns: &[Column], letters: &[usize], rows: usize) -> io::Result<Vec<u8>> {
    let field = |(column, letters): (&Column, &usize)| {
        let name = literal(&column.name);
        match &column.values {
            Values::Numbers(_) => format!("({name}, '<f8'), "),
            Values::Counts(_) => format!("({name}, '<u8'), "),
            Values::Texts(_) => format!("({name}, '<U{letters}'), "),
        }
    };
    let fields: String = columns.iter().zip(letters).map(field).collect();
    let mut text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({rows},), }}");
    let before = MARK.len() + size_of::<u32>();
    // A line end closes the padding.
    let len = (before + text.len() + 1).next_multiple_of(ALIGNMENT) - before;
    text.extend(core::iter::repeat_n(' ', len - text.len() - 1));
    text.push('\n');
    let len = u32::try_from(len).map_err(io::Error::other)?;
    Ok([MARK, &len.to_le_bytes(), text.as_bytes()].concat())
}

/// A name as a string of Python.
fn literal(name: &str) -> String {
    let mut text = String::from("'");
    for letter in name.chars() {
        match letter {
            '\'' | '\\' => text.extend(['\\', letter]),
            _ if letter.is_control() => text.push_str(&format!("\\u{:04x}", u32::from(letter))),
            _ => text.push(letter),
        }
    }
    text.push('\'');
    text
}
