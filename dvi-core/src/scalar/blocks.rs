//! Long vectors in blocks that stay in the first cache, for what passes over them several times.

use core::ops::Range;

/// How many coordinates a block has: eight vectors of so many numbers are half of a first cache of 32 KiB.
const BLOCK: usize = 256;

/// The ranges of the blocks of `n` coordinates.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn blocks(n: usize) -> impl Iterator<Item = Range<usize>> {
    (0..n).step_by(BLOCK).map(move |start| start..n.min(start + BLOCK))
}
