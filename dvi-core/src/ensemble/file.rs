//! A checkpoint on the disk: it is there as a whole, or as it was before.

use std::borrow::ToOwned;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::vec::Vec;

use serde::{Deserialize, Serialize};

use super::Shard;
use super::error::EnsembleError;
use super::fingerprint::Fingerprint;
use super::group::Slot;
use super::plan::Plan;

/// Begins each file; after it stand the length and the fingerprint of the content, then the content.
const MARK: &[u8] = b"dvi ensemble checkpoint 3\n";
/// The bytes before the content.
const HEAD: usize = MARK.len() + 16;

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
    Ok([MARK, &(content.len() as u64).to_le_bytes(), &fingerprint(&content), &content].concat())
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
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

/// Reads a file; `None` if there is none. Of another one only the head is read, however long it is.
pub(super) fn read(path: &Path) -> Result<Option<Saved>, EnsembleError> {
    let unread = |source| EnsembleError::File { path: path.to_owned(), source };
    let damaged = |reason| EnsembleError::Damaged { path: path.to_owned(), reason };
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unread(error)),
        Ok(metadata) if metadata.is_file() => {}
        // A pipe keeps its reader waiting, and a device need not end.
        Ok(_) => return Err(unread(io::Error::other("it is a folder, a device or a pipe, and no file"))),
    }
    let file = File::open(path).map_err(unread)?;
    let len = file.metadata().map_err(unread)?.len();
    let mut bytes = Vec::new();
    (&file).take(HEAD as u64).read_to_end(&mut bytes).map_err(unread)?;
    fingerprint_in_head(&bytes, len).map_err(damaged)?;
    file.take(len).read_to_end(&mut bytes).map_err(unread)?;
    decode(&bytes).map(Some).map_err(damaged)
}

/// The fingerprint of the content, in the head of a file of `len` bytes.
///
/// # Errors
/// What is wrong with head or length.
fn fingerprint_in_head(bytes: &[u8], len: u64) -> Result<[u8; 8], &'static str> {
    let rest = bytes.strip_prefix(MARK).ok_or("it does not begin as one")?;
    let (content, rest) = rest.split_first_chunk().ok_or("it ends too early")?;
    let fingerprint = rest.first_chunk().ok_or("it ends too early")?;
    if len.checked_sub(HEAD as u64) == Some(u64::from_le_bytes(*content)) {
        Ok(*fingerprint)
    } else {
        Err("it does not have the length with which it was written")
    }
}

/// Reads the bytes of a file.
///
/// # Errors
/// What is wrong with them.
pub(super) fn decode(bytes: &[u8]) -> Result<Saved, &'static str> {
    let found = fingerprint_in_head(bytes, bytes.len() as u64)?;
    let content = &bytes[HEAD..];
    if found != fingerprint(content) {
        return Err("its content has changed since it was written");
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
