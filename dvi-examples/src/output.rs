//! Files that are either complete or absent.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::{Context as _, Result, ensure};

/// Writes the file under a provisional name and renames it when it is complete, so that whatever
/// happens in between, nothing incomplete ever bears the final name.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let provisional = provisional_name(path);
    let written = fs::File::create(&provisional)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&provisional, path));
    if written.is_err() {
        let _ = fs::remove_file(&provisional);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}

fn provisional_name(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".partial");
    path.with_file_name(name)
}

/// Makes the folder, and makes sure that files can be made in it before the first number is computed.
pub fn prepare_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot create the folder {}", folder.display()))?;
    let probe = folder.join(".dvi-probe");
    fs::write(&probe, []).with_context(|| format!("cannot write into the folder {}", folder.display()))?;
    fs::remove_file(&probe)
        .with_context(|| format!("cannot remove files from the folder {}", folder.display()))
}

/// A number as tables have it: all its digits, with an exponent where it would have many zeros.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-4..1e15).contains(&magnitude) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// What a table can hold.
pub trait Cell {
    /// The content of the cell.
    fn text(&self) -> String;
}

impl Cell for f64 {
    fn text(&self) -> String {
        number(*self)
    }
}

/// Nothing, or a number.
impl Cell for Option<f64> {
    fn text(&self) -> String {
        self.map_or(String::new(), number)
    }
}

impl Cell for str {
    fn text(&self) -> String {
        self.to_owned()
    }
}

impl Cell for String {
    fn text(&self) -> String {
        self.clone()
    }
}

impl<C: Cell + ?Sized> Cell for &C {
    fn text(&self) -> String {
        (*self).text()
    }
}

/// A table with named columns.
#[derive(Debug)]
pub struct Table {
    columns: usize,
    writer: csv::Writer<Vec<u8>>,
}

impl Table {
    /// A table with these columns and no rows.
    pub fn new(columns: &[&str]) -> Result<Self> {
        let mut table = Self { columns: columns.len(), writer: csv::Writer::from_writer(Vec::new()) };
        table.row(columns)?;
        Ok(table)
    }

    /// A table of rows that have texts first, from which the marks of italics are taken out, and then
    /// numbers.
    ///
    /// # Errors
    /// If a row has more or fewer cells than there are columns.
    pub fn of<T, N>(columns: &[&str], rows: impl IntoIterator<Item = (T, N)>) -> Result<Self>
    where
        T: IntoIterator<Item: AsRef<str>>,
        N: IntoIterator<Item: Cell>,
    {
        let mut table = Self::new(columns)?;
        for (texts, numbers) in rows {
            let texts = texts.into_iter().map(|text| text.as_ref().replace('*', ""));
            table.row(texts.chain(numbers.into_iter().map(|number| number.text())))?;
        }
        Ok(table)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// If it has more or fewer cells than there are columns.
    pub fn row<I>(&mut self, cells: I) -> Result<()>
    where
        I: IntoIterator<Item: Cell>,
    {
        let cells: Vec<String> = cells.into_iter().map(|cell| cell.text()).collect();
        // The writer itself notices only after it has written part of the row.
        ensure!(
            cells.len() == self.columns,
            "a row of {} cells in a table of {}",
            cells.len(),
            self.columns
        );
        self.writer.write_record(&cells).context("a table could not be written")
    }

    /// Writes `name.csv` into the folder.
    pub fn save(self, folder: &Path, name: &str) -> Result<()> {
        let bytes = self.writer.into_inner().context("a table could not be completed")?;
        write_whole(&folder.join(format!("{name}.csv")), &bytes)
    }
}

/// A line, broken between words into lines of at most `width` letters; those that follow are indented by two
/// more.
pub fn wrapped(words: &str, indent: usize, width: Option<usize>) -> String {
    let width = width.unwrap_or(usize::MAX);
    let (mut text, mut used) = (" ".repeat(indent), indent);
    for (i, word) in words.split(' ').enumerate() {
        let letters = word.chars().count();
        if i > 0 && used + 1 + letters > width {
            text.push('\n');
            text.push_str(&" ".repeat(indent + 2));
            used = indent + 2;
        } else if i > 0 {
            text.push(' ');
            used += 1;
        }
        text.push_str(word);
        used += letters;
    }
    text.truncate(text.trim_end_matches(' ').len());
    text.push('\n');
    text
}

/// When a run is made, in words; `SOURCE_DATE_EPOCH` in the environment, in seconds since 1970, stands for
/// the clock.
pub fn now() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let clock = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    date(given.unwrap_or_else(clock))
}

/// Seconds since 1970 as a date, UTC.
fn date(seconds: u64) -> String {
    let (mut days, minutes) = (seconds / 86_400, seconds % 86_400 / 60);
    let is_leap =
        |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02} {:02}:{:02} UTC", days + 1, minutes / 60, minutes % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries =
            fs::read_dir(folder).expect("readable").map(|entry| entry.expect("readable").file_name());
        let mut names: Vec<_> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_as_a_whole_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.csv");
        write_whole(&path, b"old and longer").expect("written");
        write_whole(&path, b"new").expect("written");
        assert_eq!(fs::read(&path).expect("readable"), b"new");
        assert_eq!(names(folder.path()), ["a.csv"]);
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_and_removes_the_provisional_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("taken");
        fs::create_dir(&path).expect("a folder in the way");
        let error = write_whole(&path, b"new").expect_err("a file cannot replace a folder");
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(folder.path()), ["taken"]);
    }

    #[test]
    fn a_folder_below_a_file_cannot_be_prepared() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("file");
        fs::write(&file, []).expect("written");
        let error = prepare_folder(&file.join("below")).expect_err("not a folder");
        assert!(error.to_string().contains("cannot create the folder"), "{error}");
    }

    #[test]
    fn tables_have_headers_and_refuse_ragged_rows() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut table = Table::new(&["t", "H"]).expect("headers");
        table.row([0.0, 0.1]).expect("a row");
        table.row([1e-15, f64::NAN]).expect("a row");
        assert!(table.row([1.0]).is_err());
        table.save(folder.path(), "series").expect("saved");
        let text = fs::read_to_string(folder.path().join("series.csv")).expect("readable");
        assert_eq!(text, "t,H\n0,0.1\n1e-15,NaN\n");
    }

    #[test]
    fn lines_break_between_words_only() {
        assert_eq!(wrapped("one two three", 2, Some(9)), "  one two\n    three\n");
        assert_eq!(wrapped("a-word-that-is-too-long", 0, Some(5)), "a-word-that-is-too-long\n");
        assert_eq!(wrapped("one two", 1, None), " one two\n");
    }

    #[test]
    fn dates_are_those_of_the_calendar() {
        let shown = [0, 951_782_399, 951_782_400, 1_704_067_199, 1_795_303_259].map(date);
        let expected = [
            "1970-01-01 00:00 UTC",
            "2000-02-28 23:59 UTC",
            "2000-02-29 00:00 UTC",
            "2023-12-31 23:59 UTC",
            "2026-11-21 23:20 UTC",
        ];
        assert_eq!(shown, expected);
    }
}
