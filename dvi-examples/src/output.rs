//! Files that are either complete or absent.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

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

/// A table with named columns.
#[derive(Debug)]
pub struct Table {
    columns: usize,
    writer: csv::Writer<Vec<u8>>,
}

impl Table {
    pub fn new(columns: &[&str]) -> Result<Self> {
        let mut table = Self { columns: columns.len(), writer: csv::Writer::from_writer(Vec::new()) };
        table.row(columns)?;
        Ok(table)
    }

    pub fn row<I>(&mut self, cells: I) -> Result<()>
    where
        I: IntoIterator<Item: ToString>,
    {
        let cells: Vec<String> = cells.into_iter().map(|cell| cell.to_string()).collect();
        // The writer itself notices only after it has written part of the row.
        ensure!(cells.len() == self.columns, "a row of {} cells in a table of {}", cells.len(), self.columns);
        self.writer.write_record(&cells).context("a table could not be written")
    }

    /// Writes `name.csv` into the folder.
    pub fn save(self, folder: &Path, name: &str) -> Result<()> {
        let bytes = self.writer.into_inner().context("a table could not be completed")?;
        write_whole(&folder.join(format!("{name}.csv")), &bytes)
    }
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
        assert!(table.row([1.0]).is_err());
        table.save(folder.path(), "series").expect("saved");
        let text = fs::read_to_string(folder.path().join("series.csv")).expect("readable");
        assert_eq!(text, "t,H\n0,0.1\n");
    }
}
