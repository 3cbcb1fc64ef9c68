//! A checkpoint on the disk: it is there as a whole, or as it was before.

use std::borrow::ToOwned;
use std::io::{self, BufReader, Read};
use std::path::Path;
use std::vec::Vec;

use super::Shard;
use super::error::EnsembleError;
use super::group::Slot;
use super::plan::Plan;
use super::sealed::{self, Found, Reader};

/// Begins each file; after it stands the content, sealed.
const MARK: &[u8] = b"dvi ensemble checkpoint 9\n";

/// What a file holds.
pub(super) type Saved = (Plan, Shard, Vec<Slot>);

/// Writes the file anew.
pub(super) fn write(path: &Path, plan: &Plan, shard: Shard, slots: &[Slot]) -> Result<(), EnsembleError> {
    let written = encode(plan, shard, slots).and_then(|bytes| sealed::replace(path, &bytes));
    written.map_err(|source| EnsembleError::File { path: path.to_owned(), source })
}

/// The bytes of a file.
pub(super) fn encode(plan: &Plan, shard: Shard, slots: &[Slot]) -> io::Result<Vec<u8>> {
    Ok([MARK, &sealed::sealed(&(plan, shard, slots))?].concat())
}

/// Reads a file; `None` if there is none. Of another one only the head is read, however long it is.
pub(super) fn read(path: &Path) -> Result<Option<Saved>, EnsembleError> {
    let unread = |source| EnsembleError::File { path: path.to_owned(), source };
    let damaged = |reason| EnsembleError::Damaged { path: path.to_owned(), reason };
    let Some((file, len)) = sealed::existing(path).map_err(unread)? else { return Ok(None) };
    decode(BufReader::new(file), len).map_err(unread)?.map(Some).map_err(damaged)
}

/// Reads what has been encoded in so many bytes.
///
/// # Errors
/// Those of `from`; and what is wrong with what has been read.
pub(super) fn decode(from: impl Read, len: u64) -> io::Result<Result<Saved, &'static str>> {
    let mut reader = Reader { from, place: 0, len };
    if !reader.begins_with(MARK)? {
        return Ok(Err("it does not begin as one"));
    }
    Ok(match reader.next()? {
        Found::Whole(content) if reader.place == len => saved(&content),
        Found::Whole(_) | Found::Cut { .. } => Err("it does not have the length with which it was written"),
        Found::Changed => Err("its content has changed since it was written"),
    })
}

/// The content of a file.
fn saved(content: &[u8]) -> Result<Saved, &'static str> {
    let saved: Saved = postcard::from_bytes(content).map_err(|_| "it is one of another version")?;
    let (plan, Shard { index, of }, slots) = &saved;
    let shard = Shard::new(*index, *of).map_err(|_| "there is no such shard")?;
    let expected = (0..plan.members).filter(|&member| shard.contains(member));
    if slots.iter().map(|slot| slot.number).eq(expected) {
        Ok(saved)
    } else {
        Err("its members are not those of its shard")
    }
}
