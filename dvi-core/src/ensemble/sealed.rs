//! Content in a file with its length and its fingerprint before it: it is there as a whole, or it is not
//! taken for whole.

use std::borrow::ToOwned;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;
#[cfg(unix)]
use std::path::PathBuf;
use std::vec;
use std::vec::Vec;

use serde::Serialize;

use crate::state::fingerprint::Fingerprint;

/// The length and the fingerprint of the content, and the content: in the binary format of the crate
/// postcard, in which each number keeps its bits.
pub(crate) fn sealed(content: &impl Serialize) -> io::Result<Vec<u8>> {
    let content = postcard::to_allocvec(content).map_err(io::Error::other)?;
    Ok([&(content.len() as u64).to_le_bytes(), &fingerprint(&content)[..], &content].concat())
}

fn fingerprint(content: &[u8]) -> [u8; 8] {
    let mut fingerprint = Fingerprint::new();
    fingerprint.bytes(content);
    fingerprint.value().to_le_bytes()
}

/// What is found in a file.
pub(crate) enum Found {
    Whole(Vec<u8>),
    /// The file ends before so many bytes of it.
    Cut {
        len: u64,
    },
    Changed,
}

/// Reads what has been sealed, one after the other.
pub(crate) struct Reader<F> {
    pub(crate) from: F,
    /// How far it has been read, and the length of the whole.
    pub(crate) place: u64,
    pub(crate) len: u64,
}

impl<F: Read> Reader<F> {
    /// Reads the mark of a file, if it is this one.
    pub(crate) fn begins_with(&mut self, mark: &[u8]) -> io::Result<bool> {
        let mut read = vec![0; mark.len()];
        Ok(self.exactly(&mut read)? && read == mark)
    }

    /// The next content.
    pub(crate) fn next(&mut self) -> io::Result<Found> {
        let [mut len, mut expected] = [[0; 8]; 2];
        if !self.exactly(&mut len)? || !self.exactly(&mut expected)? {
            return Ok(Found::Cut { len: 0 });
        }
        let len = u64::from_le_bytes(len);
        if len > self.len - self.place {
            return Ok(Found::Cut { len });
        }
        let mut content = Vec::new();
        self.from.by_ref().take(len).read_to_end(&mut content)?;
        self.place += len;
        Ok(if fingerprint(&content) == expected { Found::Whole(content) } else { Found::Changed })
    }

    /// Reads as many bytes, if there are as many.
    fn exactly(&mut self, bytes: &mut [u8]) -> io::Result<bool> {
        let is_there = self.len - self.place >= bytes.len() as u64;
        if is_there {
            self.from.read_exact(bytes)?;
            self.place += bytes.len() as u64;
        }
        Ok(is_there)
    }
}

/// Opens a file and tells its length; `None` if there is none.
pub(crate) fn existing(path: &Path) -> io::Result<Option<(File, u64)>> {
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
        Ok(metadata) if metadata.is_file() => {
            let file = File::open(path)?;
            let len = file.metadata()?.len();
            Ok(Some((file, len)))
        }
        // A pipe keeps its reader waiting, and a device need not end.
        Ok(_) => Err(io::Error::other("it is a folder, a device or a pipe, and no file")),
    }
}

/// Writes beside the file, makes sure that it is on the disk, and puts it in the place of the file.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".new");
    let mut file = File::create(&beside)?;
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    drop(file);
    let replaced = written.and_then(|()| fs::rename(&beside, path));
    if replaced.is_err() {
        // What keeps a part of a file from being removed is not told: the first error is the cause.
        let _ = fs::remove_file(&beside);
    }
    replaced?;
    #[cfg(unix)]
    File::open(folder(path))?.sync_all()?;
    Ok(())
}

#[cfg(unix)]
fn folder(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        Some(_) | None => PathBuf::from("."),
    }
}
