//! Parts of an ensemble that run as processes of their own, for a batch system or GNU parallel.

use std::borrow::ToOwned;
use std::ffi::OsString;
use std::fmt;
use std::format;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::error::EnsembleError;

/// One of several parts of an ensemble: of `i/n` the members k with k mod n = i, where i counts from 0.
///
/// ```
/// use dvi_core::ensemble::Shard;
///
/// let shard: Shard = "2/8".parse()?;
/// assert!(shard.contains(10) && !shard.contains(11));
/// assert!("8/8".parse::<Shard>().is_err());
/// # Ok::<(), dvi_core::ensemble::EnsembleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    pub(super) index: u64,
    pub(super) of: u64,
}

impl Shard {
    /// All members.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// Shard `index` of `of`.
    ///
    /// # Errors
    /// [`EnsembleError::ShardRange`] if `index` is not below `of`.
    pub fn new(index: u64, of: u64) -> Result<Self, EnsembleError> {
        if index < of { Ok(Self { index, of }) } else { Err(EnsembleError::ShardRange { index, of }) }
    }

    /// Whether a member belongs to this shard.
    pub fn contains(self, member: u64) -> bool {
        member % self.of == self.index
    }

    /// The file of this shard among those of `path`: `run.ckpt.2-of-8` of `run.ckpt`, and `path` itself of
    /// the whole.
    pub fn path(self, path: impl AsRef<Path>) -> PathBuf {
        let path = path.as_ref();
        if self == Self::WHOLE {
            return path.to_owned();
        }
        let mut name: OsString = path.into();
        name.push(format!(".{}-of-{}", self.index, self.of));
        name.into()
    }
}

impl FromStr for Shard {
    type Err = EnsembleError;

    fn from_str(text: &str) -> Result<Self, EnsembleError> {
        let form = || EnsembleError::ShardText { text: text.to_owned() };
        let (index, of) = text.trim().split_once('/').ok_or_else(form)?;
        let number = |digits: &str| digits.parse().map_err(|_| form());
        Self::new(number(index)?, number(of)?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}
