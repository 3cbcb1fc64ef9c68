//! A checkpoint on the disk: it is there as a whole, or as it was before.

use std::borrow::ToOwned;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::vec::Vec;

use serde::{Deserialize, Serialize};

use super::Shard;
use super::error::EnsembleError;
use super::group::Slot;
use super::plan::Plan;
use crate::state::fingerprint::Fingerprint;

/// Begins each file; after it stand the fingerprint of the rest and the rest.
const MARK: &[u8] = b"dvi ensemble checkpoint 1\n";

/// What a file holds, in the binary format of the crate postcard, in which each number keeps its bits.
#[derive(Deserialize)]
pub(super) struct Saved {
    pub(super) plan: Plan,
    shard: [u64; 2],
    pub(super) slots: Vec<Slot>,
}

/// The same, to be written.
#[derive(Serialize)]
struct Borrowed<'a> {
    plan: &'a Plan,
    shard: [u64; 2],
    slots: &'a [Slot],
}

impl Saved {
    pub(super) fn shard(&self) -> Shard {
        let [index, of] = self.shard;
        Shard { index, of }
    }
}

/// Writes beside the file, makes sure that it is on the disk, and puts it in the place of the file.
pub(super) fn write(path: &Path, plan: &Plan, shard: Shard, slots: &[Slot]) -> Result<(), EnsembleError> {
    let written = encode(plan, shard, slots).and_then(|bytes| replace(path, &bytes));
    written.map_err(|source| EnsembleError::File { path: path.to_owned(), source })
}

/// The bytes of a file.
pub(super) fn encode(plan: &Plan, shard: Shard, slots: &[Slot]) -> io::Result<Vec<u8>> {
    let saved = Borrowed { plan, shard: [shard.index, shard.of], slots };
    let content = postcard::to_allocvec(&saved).map_err(io::Error::other)?;
    Ok([MARK, &fingerprint(&content), &content].concat())
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".new");
    let mut file = File::create(&beside)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    drop(file);
    fs::rename(&beside, path)?;
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

/// Reads a file; `None` if there is none.
pub(super) fn read(path: &Path) -> Result<Option<Saved>, EnsembleError> {
    match fs::read(path) {
        Ok(bytes) => decode(&bytes)
            .map(Some)
            .map_err(|reason| EnsembleError::Damaged { path: path.to_owned(), reason }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(EnsembleError::File { path: path.to_owned(), source }),
    }
}

/// Reads the bytes of a file.
///
/// # Errors
/// What is wrong with them.
pub(super) fn decode(bytes: &[u8]) -> Result<Saved, &'static str> {
    let rest = bytes.strip_prefix(MARK).ok_or("it does not begin as one")?;
    let (found, content) = rest.split_first_chunk::<8>().ok_or("it ends too early")?;
    if *found != fingerprint(content) {
        return Err("its content has changed since it was written, or its end is missing");
    }
    let saved: Saved = postcard::from_bytes(content).map_err(|_| "it is one of another version")?;
    let shard = Shard::new(saved.shard[0], saved.shard[1]).map_err(|_| "there is no such shard")?;
    let expected = (0..saved.plan.members).filter(|&member| shard.contains(member));
    if !saved.slots.iter().map(|slot| slot.number).eq(expected) {
        return Err("its members are not those of its shard");
    }
    Ok(saved)
}

fn fingerprint(content: &[u8]) -> [u8; 8] {
    let mut fingerprint = Fingerprint::new();
    fingerprint.bytes(content);
    fingerprint.value().to_le_bytes()
}
