//! Tables of numbers in text: one row for each point of a grid.

mod grid;
mod row;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use thiserror::Error;

pub use grid::Grid;
use row::Row;

crate::error::said!(TableError);

/// A table of numbers, read from text.
///
/// - A line is a row of numbers. All rows have the same number of columns, separated by blanks or tabs, by
///   commas, or by semicolons; blanks may stand around commas and semicolons. One table has one kind of
///   separator.
/// - Numbers have a decimal point, and exponents after `e`, `E`, or, as Fortran writes them, `d`, `D`.
/// - Empty lines do not count, and neither do comments, lines that begin with `#` or `%`. Errors of
///   spreadsheets, such as `#N/A`, are no comments.
/// - The first line may hold names of the columns. The first letter or digit of a name is a letter, and no
///   sign stands before it. `nan`, `inf` and, where all words of a line are such, `NA` and `null` are no
///   names. Without names in the first line, the last comment above the first row names the columns if it
///   has as many words as there are columns.
/// - What is neither a name nor a number is an error: `********`, `1.#QNAN`, and `0.141-270` too.
///
/// `psi.txt` may hold
/// ```text
/// # r   z   psi
///  1.0 0.0  0.0
///  …
/// ```
/// and a spline is made of it so:
/// ```
/// use dvi_core::field::{Axis, Spline, Table};
///
/// # let text: String = core::iter::once("# r z psi".to_string())
/// #     .chain((0..16).map(|k| format!("{} {} {}", k / 4, k % 4, k)))
/// #     .collect::<Vec<String>>()
/// #     .join("\n");
/// # let read = || Ok::<String, Box<dyn std::error::Error>>(text.clone());
/// // let text = std::fs::read_to_string("psi.txt")?;
/// # let text = read()?;
/// let table = Table::read(&text)?;
/// let grid = table.grid(["r", "z"])?;
/// let [r, z] = grid.points();
/// let psi = Spline::new([Axis::new(r)?, Axis::new(z)?], &grid.values("psi")?)?;
/// # let value: f64 = dvi_core::ScalarField::expansion(&psi, [1.5, 2.5]).value;
/// # assert!((value - 8.5).abs() < 1e-12, "{value}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    names: Vec<String>,
    /// The line of the names, or of the first row.
    first_line: usize,
    columns: usize,
    /// Row by row.
    numbers: Vec<f64>,
    /// The line of each row.
    lines: Vec<usize>,
}

/// A column of a [`Table`]: its name, or its number, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column<'a> {
    /// As the table calls it, with the same upper and lower case letters.
    Name(&'a str),
    /// Counted from 1.
    Number(usize),
}

impl<'a> From<&'a str> for Column<'a> {
    fn from(name: &'a str) -> Self {
        Self::Name(name)
    }
}

impl From<usize> for Column<'_> {
    fn from(number: usize) -> Self {
        Self::Number(number)
    }
}

impl Table {
    /// The table in `text`, the contents of a file.
    ///
    /// # Errors
    /// A [`TableError`], with line and column, where the text is not such a table. Numbers that are infinite
    /// or NaN are errors only in columns that are asked for.
    pub fn read(text: &str) -> Result<Self, TableError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut comment = None;
        let mut header: Option<Row<'_>> = None;
        let mut first: Option<Row<'_>> = None;
        let (mut numbers, mut lines) = (Vec::new(), Vec::new());
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if row::is_comment(line) {
                let words = line.trim_start_matches(['#', '%']).trim();
                comment = if first.is_none() { Some(Row::new(index + 1, words)) } else { comment };
            } else if !line.is_empty() {
                let row = Row::new(index + 1, line);
                if first.is_none() && header.is_none() && row.is_header() {
                    header = Some(row);
                    continue;
                }
                row.like(header.unwrap_or(*first.get_or_insert(row)))?;
                first.get_or_insert(row);
                lines.push(row.line);
                row.read(&mut numbers)?;
            }
        }
        let Some(first) = first else { return Err(TableError::Empty) };
        let columns = first.columns;
        let named = header.or(comment.filter(|words| words.columns == columns));
        let name = |word: &str| word.trim_matches('"').to_string();
        let names = named.map(|row| row.words().map(name).collect()).unwrap_or_default();
        Ok(Self { names, first_line: named.unwrap_or(first).line, columns, numbers, lines })
    }

    /// The names of the columns; empty if they have none.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// How many columns there are.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// How many rows of numbers there are.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The grid whose points have their coordinates in these columns, given by names or by numbers from 1.
    ///
    /// The rows may be nested in any order. On each axis the numbers increase, or decrease, from each new
    /// one to the next. The rows must form a full grid: each combination of the numbers of the axes stands
    /// in one row. Numbers that differ in their last digit are different numbers.
    ///
    /// # Errors
    /// [`TableError::NoName`], [`TableError::NoColumn`], [`TableError::SameName`],
    /// [`TableError::NotFinite`], [`TableError::NotMonotone`], [`TableError::Doubled`], and
    /// [`TableError::Missing`].
    pub fn grid<'a, const D: usize>(
        &self,
        coordinates: [impl Into<Column<'a>>; D],
    ) -> Result<Grid<'_, D>, TableError> {
        let mut columns = [0; D];
        for (column, asked) in columns.iter_mut().zip(coordinates) {
            *column = self.find(asked.into())?;
        }
        Grid::new(self, columns)
    }

    /// The numbers of a column, from row to row, all of them finite.
    ///
    /// # Errors
    /// [`TableError::NoName`], [`TableError::NoColumn`], [`TableError::SameName`], and
    /// [`TableError::NotFinite`].
    pub fn column<'a>(&self, column: impl Into<Column<'a>>) -> Result<Vec<f64>, TableError> {
        let column = self.find(column.into())?;
        (0..self.rows()).map(|row| self.number(row, column)).collect()
    }

    /// A finite number; rows and columns are counted from 0.
    fn number(&self, row: usize, column: usize) -> Result<f64, TableError> {
        let value = self.numbers[row * self.columns + column];
        if value.is_finite() {
            Ok(value)
        } else {
            Err(TableError::NotFinite { line: self.lines[row], column: column + 1, value })
        }
    }

    /// The column that is asked for, counted from 0.
    fn find(&self, column: Column<'_>) -> Result<usize, TableError> {
        let line = self.first_line;
        let name = match column {
            Column::Number(number) if (1..=self.columns).contains(&number) => return Ok(number - 1),
            Column::Number(column) => {
                return Err(TableError::NoColumn { line, column, columns: self.columns });
            }
            Column::Name(name) => name,
        };
        let mut places = self.names.iter().enumerate().filter(|(_, found)| *found == name).map(|(i, _)| i);
        match (places.next(), places.next()) {
            (Some(only), None) => Ok(only),
            (Some(first), Some(second)) => Err(TableError::SameName {
                line,
                column: second + 1,
                first: first + 1,
                name: name.to_string(),
            }),
            (None, _) => {
                Err(TableError::NoName { line, name: name.to_string(), names: self.listed_names() })
            }
        }
    }

    fn listed_names(&self) -> String {
        let quoted: Vec<String> = self.names.iter().map(|name| alloc::format!("`{name}`")).collect();
        if quoted.is_empty() { "no names but numbers".to_string() } else { quoted.join(", ") }
    }

    /// What errors call a column, counted from 0.
    fn called(&self, column: usize) -> String {
        self.names.get(column).cloned().unwrap_or_else(|| alloc::format!("column {}", column + 1))
    }
}

/// Text that is no table, or a table that is no grid. Lines and columns are counted from 1, columns as those
/// of the table.
#[derive(Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TableError {
    /// There is no row.
    #[error("the table has no row of numbers")]
    Empty,
    /// A word is not a number.
    #[error("line {line}, column {column}: `{word}` is found, and a number is expected")]
    NotANumber {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The beginning of the word.
        word: String,
    },
    /// A number has a comma in place of a decimal point.
    #[error(
        "line {line}, column {column}: `{word}` is found, and a number with a decimal point is expected, or commas between \
         all columns"
    )]
    DecimalComma {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The beginning of the word.
        word: String,
    },
    /// There is nothing between two separators, or after the last.
    #[error("line {line}, column {column}: an empty column is found, and a number is expected")]
    Blank {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// A row does not have as many columns as the first line of the table.
    #[error(
        "line {line}, column {column}: {found} columns are found, and {expected} are expected, as in line {first}"
    )]
    Columns {
        /// The line.
        line: usize,
        /// The first column that is missing, or not expected.
        column: usize,
        /// The number of columns.
        found: usize,
        /// That of the first line.
        expected: usize,
        /// The first line.
        first: usize,
    },
    /// A row has other separators than the first line of the table.
    #[error(
        "line {line}, column {column}: columns separated by {found} are found, and by {expected} are expected, as in line \
         {first}"
    )]
    Separators {
        /// The line.
        line: usize,
        /// The first column that ends with another separator, which is 1.
        column: usize,
        /// What separates its columns.
        found: &'static str,
        /// What separates those of the first line.
        expected: &'static str,
        /// The first line.
        first: usize,
    },
    /// A number is infinite or NaN, or too large.
    #[error("line {line}, column {column}: {value} is found, and a finite number is expected")]
    NotFinite {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The number.
        value: f64,
    },
    /// No column has the name.
    #[error("line {line}: a column `{name}` is expected, and found are {names}")]
    NoName {
        /// The line of the names, or of the first row if there are no names.
        line: usize,
        /// The name.
        name: String,
        /// The names of the table.
        names: String,
    },
    /// No column has the number.
    #[error("line {line}: column {column} is expected, and found are columns 1 to {columns}")]
    NoColumn {
        /// The line of the names, or of the first row if there are no names.
        line: usize,
        /// The number.
        column: usize,
        /// How many columns there are.
        columns: usize,
    },
    /// Two columns have the name.
    #[error("line {line}, column {column}: `{name}` is found again, and is the name of column {first} too")]
    SameName {
        /// The line of the names.
        line: usize,
        /// The second column.
        column: usize,
        /// The first column.
        first: usize,
        /// The name.
        name: String,
    },
    /// The numbers of an axis neither increase nor decrease, in the order in which the rows bring them.
    #[error(
        "line {line}, column {column}: {name} = {number} is out of order, and numbers that increase, or decrease, from each \
         new one to the next are expected"
    )]
    NotMonotone {
        /// The line of the number that is out of order.
        line: usize,
        /// Its column.
        column: usize,
        /// The name of the column.
        name: String,
        /// The number.
        number: f64,
    },
    /// A point of the grid stands in two rows.
    #[error(
        "line {line}, column {column}: the point {point} is found again, and is expected once; it is in line {first} too"
    )]
    Doubled {
        /// The second of the two lines.
        line: usize,
        /// The column of the first coordinate.
        column: usize,
        /// The point.
        point: String,
        /// The first of the two lines.
        first: usize,
    },
    /// A point of the grid stands in no row. It is one of those whose number on one axis is in too few rows;
    /// line and column are where that number is found first.
    #[error(
        "line {line}, column {column}: {number} is found in {found} of {expected} rows that are expected; the point {point} is \
         missing"
    )]
    Missing {
        /// The first line with the number.
        line: usize,
        /// Its column.
        column: usize,
        /// The number.
        number: String,
        /// In how many rows it is.
        found: usize,
        /// The points of the grid that have it.
        expected: usize,
        /// One of those that are missing.
        point: String,
    },
}
