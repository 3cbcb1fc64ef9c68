//! The file of an archive: a head that is written at once, and checkpoints that are appended.

use std::borrow::ToOwned;
use std::fs::{self, TryLockError};
use std::io::{self, BufReader, Seek, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::vec::Vec;

use super::{ArchiveError, Difference};
use crate::ensemble::facts::{self, Facts};
use crate::ensemble::sealed::{self, Found, Reader};
use crate::run::Checkpoint;

/// Begins each file; after it stand the facts, and then the checkpoints, each of them sealed.
const MARK: &[u8] = b"dvi run archive 3\n";

const CHANGED: &str = "a checkpoint has changed since it was written";

/// A checkpoint in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    pub(super) step: u64,
    pub(super) time: f64,
    /// Where it begins.
    place: u64,
}

#[derive(Debug)]
pub(super) struct File {
    path: PathBuf,
    file: fs::File,
    kept: Vec<Kept>,
    /// Where the next checkpoint begins.
    end: u64,
}

impl File {
    /// Opens the file at `path`, and makes it if there is none.
    pub(super) fn open(path: &Path, facts: &Facts, first: &Checkpoint) -> Result<Self, ArchiveError> {
        let unread = |source| ArchiveError::File { path: path.to_owned(), source };
        if sealed::existing(path).map_err(unread)?.is_none() {
            let begun =
                || sealed::replace(path, &[MARK, &sealed::sealed(facts)?, &sealed::sealed(first)?].concat());
            begun().map_err(unread)?;
        }
        let file = fs::File::options().read(true).write(true).open(path).map_err(unread)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(ArchiveError::Taken { path: path.to_owned() }),
            Err(TryLockError::Error(source)) => return Err(unread(source)),
        }
        let mut opened = Self { path: path.to_owned(), file, kept: Vec::new(), end: 0 };
        opened.look_through(facts, first)?;
        // What was not completed.
        opened.file.set_len(opened.end).map_err(unread)?;
        Ok(opened)
    }

    pub(super) fn kept(&self) -> &[Kept] {
        &self.kept
    }

    fn unread(&self, source: io::Error) -> ArchiveError {
        ArchiveError::File { path: self.path.clone(), source }
    }

    fn damaged(&self, reason: &'static str) -> ArchiveError {
        ArchiveError::Damaged { path: self.path.clone(), reason }
    }

    fn foreign(&self, difference: Difference) -> ArchiveError {
        ArchiveError::Foreign { path: self.path.clone(), difference }
    }

    /// Finds the checkpoints that are whole, if they are those of a run with these facts and this start.
    fn look_through(&mut self, facts: &Facts, first: &Checkpoint) -> Result<(), ArchiveError> {
        let len = self.file.metadata().map_err(|source| self.unread(source))?.len();
        let mut reader = Reader { from: BufReader::new(&self.file), place: 0, len };
        if !reader.begins_with(MARK).map_err(|source| self.unread(source))? {
            return Err(self.damaged("it does not begin as one"));
        }
        let Found::Whole(found) = reader.next().map_err(|source| self.unread(source))? else {
            return Err(self.damaged("what it says of the run is not whole"));
        };
        let found: Facts =
            postcard::from_bytes(&found).map_err(|_| self.damaged("it is one of another version"))?;
        if let Some(difference) = facts::difference(facts, &found) {
            return Err(self.foreign(difference));
        }
        let mut longest = 0;
        loop {
            self.end = reader.place;
            let content = match reader.next().map_err(|source| self.unread(source))? {
                Found::Whole(content) => content,
                // A checkpoint that was not completed: they are about as long as one another.
                Found::Cut { len } if len <= 2 * longest => break,
                Found::Changed if reader.place == reader.len => break,
                Found::Cut { .. } | Found::Changed => return Err(self.damaged(CHANGED)),
            };
            let checkpoint = self.decoded(&content)?;
            if self.kept.is_empty() && postcard::to_allocvec(first).is_ok_and(|first| first != content) {
                let [expected, found] = [first, &checkpoint].map(|start| {
                    let [steps, time] = [start.statistics().steps as f64, start.time()];
                    let (h, q, v) = (start.step_size(), start.q(), start.v());
                    std::format!("{steps} steps, t = {time}, h = {h}, q = {q:?}, v = {v:?}")
                });
                return Err(self.foreign(Difference { what: "start".to_owned(), expected, found }));
            }
            let (step, time) = (checkpoint.statistics().steps, checkpoint.time());
            self.kept.push(Kept { step, time, place: self.end });
            longest = longest.max(content.len() as u64);
        }
        if self.kept.is_empty() { Err(self.damaged("it has no whole checkpoint")) } else { Ok(()) }
    }

    /// Reads a checkpoint.
    pub(super) fn read(&self, kept: Kept) -> Result<Checkpoint, ArchiveError> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(kept.place)).map_err(|source| self.unread(source))?;
        let mut reader = Reader { from: file, place: kept.place, len: self.end };
        match reader.next().map_err(|source| self.unread(source))? {
            Found::Whole(content) => self.decoded(&content),
            Found::Cut { .. } | Found::Changed => Err(self.damaged(CHANGED)),
        }
    }

    fn decoded(&self, content: &[u8]) -> Result<Checkpoint, ArchiveError> {
        postcard::from_bytes(content).map_err(|_| self.damaged("it is one of another version"))
    }

    /// Appends a checkpoint, and makes sure that it is on the disk.
    pub(super) fn append(&mut self, checkpoint: &Checkpoint) -> Result<(), ArchiveError> {
        let written = sealed::sealed(checkpoint).and_then(|bytes| {
            self.file.seek(SeekFrom::Start(self.end))?;
            self.file.write_all(&bytes)?;
            self.file.sync_data()?;
            Ok(bytes.len() as u64)
        });
        match written {
            Ok(len) => {
                let (step, time) = (checkpoint.statistics().steps, checkpoint.time());
                self.kept.push(Kept { step, time, place: self.end });
                self.end += len;
                Ok(())
            }
            Err(source) => {
                // What stays of it is no whole checkpoint, and is not taken for one.
                let _ = self.file.set_len(self.end);
                Err(self.unread(source))
            }
        }
    }
}

impl Drop for File {
    fn drop(&mut self) {
        // A process that is just being started may have the file too, as long as it is not another program
        // yet.
        let _ = self.file.unlock();
    }
}
