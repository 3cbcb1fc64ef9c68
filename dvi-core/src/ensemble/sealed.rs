//! Content in a file with its length and its fingerprint before it: it is there as a whole, or it is not
//! taken for whole.

use std::borrow::ToOwned;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
#[cfg(unix)]
use std::path::PathBuf;
use std::vec::Vec;

use super::facts::Fingerprint;

/// The bytes of the length and the fingerprint.
pub(crate) const HEAD: usize = 16;

/// Length and fingerprint of the content, and the content.
pub(crate) fn sealed(content: &[u8]) -> Vec<u8> {
    [&(content.len() as u64).to_le_bytes(), &fingerprint(content)[..], content].concat()
}

/// The length and the fingerprint that begin `bytes`, if there are as many.
pub(crate) fn head(bytes: &[u8]) -> Option<(u64, [u8; 8])> {
    let (len, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*len), *rest.first_chunk()?))
}

pub(crate) fn fingerprint(content: &[u8]) -> [u8; 8] {
    Fingerprint::new().hash(content).to_le_bytes()
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
