//! A checkpoint on the disk: it is there as a whole, or as it was before.

use std::borrow::ToOwned;
use std::io::{self, Read};
use std::path::Path;
use std::vec::Vec;

use super::Shard;
use super::error::EnsembleError;
use super::group::Slot;
use super::plan::Plan;
use super::sealed::{self, HEAD};

/// Begins each file; after it stands the content, sealed.
const MARK: &[u8] = b"dvi ensemble checkpoint 6\n";
/// The bytes before the content.
const BEFORE: usize = MARK.len() + HEAD;

/// What a file holds, in the binary format of the crate postcard, in which each number keeps its bits.
pub(super) type Saved = (Plan, Shard, Vec<Slot>);

/// Writes the file anew.
pub(super) fn write(path: &Path, plan: &Plan, shard: Shard, slots: &[Slot]) -> Result<(), EnsembleError> {
    let written = encode(plan, shard, slots).and_then(|bytes| sealed::replace(path, &bytes));
    written.map_err(|source| EnsembleError::File { path: path.to_owned(), source })
}

/// The bytes of a file.
pub(super) fn encode(plan: &Plan, shard: Shard, slots: &[Slot]) -> io::Result<Vec<u8>> {
    let content = postcard::to_allocvec(&(plan, shard, slots)).map_err(io::Error::other)?;
    Ok([MARK, &sealed::sealed(&content)].concat())
}

/// Reads a file; `None` if there is none. Of another one only the head is read, however long it is.
pub(super) fn read(path: &Path) -> Result<Option<Saved>, EnsembleError> {
    let unread = |source| EnsembleError::File { path: path.to_owned(), source };
    let damaged = |reason| EnsembleError::Damaged { path: path.to_owned(), reason };
    let Some((file, len)) = sealed::existing(path).map_err(unread)? else { return Ok(None) };
    let mut bytes = Vec::new();
    (&file).take(BEFORE as u64).read_to_end(&mut bytes).map_err(unread)?;
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
    let (content, fingerprint) = sealed::head(rest).ok_or("it ends too early")?;
    if len.checked_sub(BEFORE as u64) == Some(content) {
        Ok(fingerprint)
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
    let content = &bytes[BEFORE..];
    if found != sealed::fingerprint(content) {
        return Err("its content has changed since it was written");
    }
    let saved: Saved = postcard::from_bytes(content).map_err(|_| "it is one of another version")?;
    let (plan, Shard { index, of }, slots) = &saved;
    let shard = Shard::new(*index, *of).map_err(|_| "there is no such shard")?;
    let expected = (0..plan.members).filter(|&member| shard.contains(member));
    if !slots.iter().map(|slot| slot.number).eq(expected) {
        return Err("its members are not those of its shard");
    }
    Ok(saved)
}
