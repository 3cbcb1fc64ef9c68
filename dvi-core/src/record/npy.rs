//! An array of records in the format of NumPy, in version 3, whose names are UTF-8.

use std::format;
use std::io::{self, BufWriter, Write};
use std::string::String;
use std::vec::Vec;

use super::column::{Column, Values};

const MARK: &[u8] = b"\x93NUMPY\x03\x00";
/// The data begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// How the entries of a column are written: numbers and counts in eight bytes, texts in so many letters.
enum Kind {
    Number,
    Count,
    Text { letters: usize },
}

impl Kind {
    fn of(column: &Column) -> Self {
        match column.values() {
            Values::Numbers(_) => Self::Number,
            Values::Counts(_) => Self::Count,
            // There is no type for texts of no letters.
            Values::Texts(texts) => {
                let letters = texts.iter().map(|text| text.chars().count()).max();
                Self::Text { letters: letters.unwrap_or(0).max(1) }
            }
        }
    }

    fn name(&self) -> String {
        match self {
            Self::Number => "<f8".into(),
            Self::Count => "<u8".into(),
            Self::Text { letters } => format!("<U{letters}"),
        }
    }
}

pub(super) fn write(columns: &[Column], rows: usize, to: impl Write) -> io::Result<()> {
    let kinds: Vec<Kind> = columns.iter().map(Kind::of).collect();
    let mut to = BufWriter::new(to);
    to.write_all(&head(columns, &kinds, rows)?)?;
    for row in 0..rows {
        for (column, kind) in columns.iter().zip(&kinds) {
            match (column.values(), kind) {
                (Values::Numbers(numbers), _) => to.write_all(&numbers[row].to_le_bytes())?,
                (Values::Counts(counts), _) => to.write_all(&counts[row].to_le_bytes())?,
                (Values::Texts(texts), &Kind::Text { letters }) => {
                    let text = texts[row].chars().map(u32::from);
                    for letter in text.chain(core::iter::repeat(0)).take(letters) {
                        to.write_all(&letter.to_le_bytes())?;
                    }
                }
                (Values::Texts(_), Kind::Number | Kind::Count) => {}
            }
        }
    }
    to.flush()
}

/// What stands before the records: their type as a literal of Python.
fn head(columns: &[Column], kinds: &[Kind], rows: usize) -> io::Result<Vec<u8>> {
    let field =
        |(column, kind): (&Column, &Kind)| format!("({}, '{}'), ", literal(column.name()), kind.name());
    let fields: String = columns.iter().zip(kinds).map(field).collect();
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
