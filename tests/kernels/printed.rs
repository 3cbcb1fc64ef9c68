//! The line of the benchmark that a test reads.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};

/// What stands before the hash of the bits of [wide](dvi_kernels::wide).
pub(crate) const WIDE: &str = "hash of what the widest instructions compute: ";

/// The hash of the bits of numbers, as it is printed.
pub(crate) fn hash_of(bits: &[u64]) -> String {
    let mut hasher = DefaultHasher::new();
    bits.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}
