//! Files that are either complete or absent, tables, and dates.

use std::fs::{self, File};
use std::io::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use anyhow::{Context as _, Result};

/// Writes the file under a provisional name and renames it when it is complete, so that whatever
/// happens in between, nothing incomplete ever bears the final name.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let provisional = PathBuf::from(format!("{}.partial", path.display()));
    let written = File::create(&provisional)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&provisional, path));
    if written.is_err() {
        let _ = fs::remove_file(&provisional);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}

/// Makes the folder, and makes sure that files can be made in it before the first number is computed.
pub fn prepare_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot create the folder {}", folder.display()))?;
    let probe = folder.join(".dvi-probe");
    let probed = fs::write(&probe, []).and_then(|()| fs::remove_file(&probe));
    probed.with_context(|| format!("cannot write into the folder {}", folder.display()))
}

/// A number with all its digits, and with an exponent if it is not in the range.
pub fn digits(value: f64, plain: Range<f64>) -> String {
    let is_plain = value == 0.0 || !value.is_finite() || plain.contains(&value.abs());
    if is_plain { value.to_string() } else { format!("{value:e}") }
}

pub fn number(value: f64) -> String {
    digits(value, 1e-4..1e15)
}

#[derive(Debug)]
pub struct Table(csv::Writer<Vec<u8>>);

impl Table {
    /// A table of columns with these names, and of rows that have texts first, from which marks of italics
    /// are taken out, and then numbers, some of which may be missing.
    ///
    /// # Errors
    /// If a row has more or fewer cells than there are columns.
    pub fn of<T, N>(columns: &str, rows: impl IntoIterator<Item = (T, N)>) -> Result<Self>
    where
        T: IntoIterator<Item: AsRef<str>>,
        N: IntoIterator<Item: Into<Option<f64>>>,
    {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(columns.split(','))?;
        for (texts, numbers) in rows {
            let texts = texts.into_iter().map(|text| text.as_ref().replace('*', ""));
            let numbers = numbers.into_iter().map(|value| value.into().map(number).unwrap_or_default());
            table.write_record(texts.chain(numbers)).context("a row cannot be added to a table")?;
        }
        Ok(Self(table))
    }

    pub fn save(self, folder: &Path, name: &str) -> Result<()> {
        let bytes = self.0.into_inner().context("a table could not be completed")?;
        write_whole(&folder.join(format!("{name}.csv")), &bytes)
    }
}

/// The first second of the year 10000, since 1970: there are no words for it.
const BEYOND_WORDS: u64 = 253_402_300_800;

/// When a run is made, in words; `SOURCE_DATE_EPOCH` in the environment, in seconds since 1970, stands for
/// the clock.
pub fn now() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let given = given.filter(|&seconds| seconds < BEYOND_WORDS).map(Duration::from_secs);
    let time = given.map_or_else(SystemTime::now, |since| SystemTime::UNIX_EPOCH + since);
    let text = humantime::format_rfc3339_seconds(time).to_string();
    format!("{} {} UTC", &text[..10], &text[11..16])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_as_a_whole_or_not_at_all_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let [path, taken] = ["a.csv", "taken"].map(|name| folder.path().join(name));
        write_whole(&path, b"old and longer").expect("written");
        write_whole(&path, b"new").expect("written");
        assert_eq!(fs::read(&path).expect("readable"), b"new");
        fs::create_dir(&taken).expect("a folder in the way");
        let error = write_whole(&taken, b"new").expect_err("a file cannot replace a folder");
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 2);
    }
}
