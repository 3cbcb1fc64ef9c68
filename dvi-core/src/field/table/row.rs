//! One line of a table.

use alloc::string::String;
use alloc::vec::Vec;

use super::TableError;

/// What stands between two columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Blanks,
    Comma,
    Semicolon,
}

impl Separator {
    fn name(self) -> &'static str {
        match self {
            Self::Blanks => "blanks",
            Self::Comma => "commas",
            Self::Semicolon => "semicolons",
        }
    }
}

/// A line that is neither empty nor a comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    /// Counted from 1.
    pub(super) line: usize,
    pub(super) columns: usize,
    text: &'a str,
    separator: Separator,
}

impl<'a> Row<'a> {
    pub(super) fn new(line: usize, text: &'a str) -> Self {
        let separator = match text {
            _ if text.contains(';') => Separator::Semicolon,
            _ if text.contains(',') => Separator::Comma,
            _ => Separator::Blanks,
        };
        let row = Self { line, columns: 0, text, separator };
        Self { columns: row.words().count(), ..row }
    }

    pub(super) fn words(self) -> impl Iterator<Item = &'a str> {
        let between = match self.separator {
            Separator::Blanks => None,
            Separator::Comma => Some(','),
            Separator::Semicolon => Some(';'),
        };
        // Other blanks than these stand within numbers, between thousands.
        let blank = between.is_none().then(|| self.text.split_ascii_whitespace());
        let split = between.map(|between| self.text.split(between).map(str::trim));
        blank.into_iter().flatten().chain(split.into_iter().flatten())
    }

    /// Whether it holds names.
    pub(super) fn is_header(self) -> bool {
        self.words().all(is_name) && !self.words().all(|word| MISSING.contains(&word))
    }

    /// An error unless it has the columns and separators of the first line of the table.
    pub(super) fn like(self, first: Self) -> Result<(), TableError> {
        let (line, found, expected) = (self.line, self.columns, first.columns);
        // With one column there is nothing to separate.
        if self.separator != first.separator && found > 1 && expected > 1 {
            self.read(&mut Vec::new()).or_else(|error| match error {
                comma @ TableError::DecimalComma { .. } => Err(comma),
                _ => Ok(()),
            })?;
            let (found, expected) = (self.separator.name(), first.separator.name());
            return Err(TableError::Separators { line, column: 1, found, expected, first: first.line });
        }
        if found != expected {
            let column = found.min(expected) + 1;
            return Err(TableError::Columns { line, column, found, expected, first: first.line });
        }
        Ok(())
    }

    /// Appends its numbers.
    pub(super) fn read(self, numbers: &mut Vec<f64>) -> Result<(), TableError> {
        for (i, word) in self.words().enumerate() {
            let (line, column) = (self.line, i + 1);
            let value = number(word).ok_or_else(|| match word {
                "" => TableError::Blank { line, column },
                _ if self.is_comma_between_blanks(word) => {
                    TableError::DecimalComma { line, column, word: beginning(self.text) }
                }
                _ if has_decimal_comma(word) => {
                    TableError::DecimalComma { line, column, word: beginning(word) }
                }
                _ => TableError::NotANumber { line, column, word: beginning(word) },
            })?;
            numbers.push(value);
        }
        Ok(())
    }

    /// Whether a word between two commas is the end of a number and the beginning of another.
    fn is_comma_between_blanks(self, word: &str) -> bool {
        self.separator == Separator::Comma && word.split_whitespace().all(|part| number(part).is_some())
    }
}

/// What programs write in the place of a number that they do not have: no comments, and names only beside
/// others.
#[rustfmt::skip]
const MISSING: [&str; 15] = [
    "NA", "N/A", "n/a", "<NA>", "NULL", "null", "None", "missing",
    "#N/A", "#NUM!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NULL!",
];

/// Whether a line, without blanks around it, is a comment.
pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%']) && !MISSING.iter().any(|word| line.starts_with(word))
}

/// Whether a word is a name and not a number, or what is left of one: its first letter or digit is a
/// letter, it has no sign, and it is no form of NaN or infinity.
fn is_name(word: &str) -> bool {
    let word = word.trim_matches('"');
    let first = word.chars().find(|c| c.is_alphanumeric());
    let is_signed = word.starts_with(['+', '-', '−']);
    let beginning = word.split('(').next().and_then(number);
    first.is_some_and(char::is_alphabetic) && !is_signed && beginning.is_none()
}

/// Whether a word is a number but for a comma in the place of the point.
fn has_decimal_comma(word: &str) -> bool {
    word.matches(',').count() == 1 && number(&word.replacen(',', ".", 1)).is_some()
}

/// The number that a word is.
fn number(word: &str) -> Option<f64> {
    // Words such as `inf`, `nan` and `infinity` are numbers too; whoever asks for them is told.
    word.parse().ok().or_else(|| {
        let is_fortran = word.bytes().all(|c| matches!(c, b'0'..=b'9' | b'+' | b'-' | b'.' | b'd' | b'D'));
        is_fortran.then(|| word.replacen(['d', 'D'], "e", 1).parse().ok()).flatten()
    })
}

/// As much of a text as fits in a message.
fn beginning(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut beginning: String = text.chars().take(LONGEST).collect();
    if beginning.len() < text.len() {
        beginning.push('…');
    }
    beginning
}
