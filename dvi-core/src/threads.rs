//! Work that is cut into parts, which threads share, with the feature `threads`.
//!
//! Each number is computed by one part, in an order that no cut changes: so results are bitwise the same for
//! every number of threads.

/// Parts for each thread: some are done sooner than others.
#[cfg(feature = "threads")]
const SHARES: usize = 8;

/// The largest part that is not cut, of work of the size `whole`. Parts smaller than `least` are not worth
/// handing over.
#[cfg(feature = "threads")]
pub(crate) fn largest_part(whole: usize, least: usize) -> usize {
    let threads = rayon::current_num_threads();
    if threads == 1 { usize::MAX } else { least.max(whole / (SHARES * threads)) }
}

/// The largest part that is not cut: all of it.
#[cfg(not(feature = "threads"))]
pub(crate) fn largest_part(_whole: usize, _least: usize) -> usize {
    usize::MAX
}

/// Whether this is one of the threads that share work: others have to wake these.
#[cfg(feature = "threads")]
pub(crate) fn is_in_pool() -> bool {
    rayon::current_thread_index().is_some()
}

/// Whether this is one of the threads that share work: it is the only one.
#[cfg(not(feature = "threads"))]
pub(crate) fn is_in_pool() -> bool {
    true
}

/// Does both, at once if there is a thread for each.
#[cfg(feature = "threads")]
pub(crate) fn at_once(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    rayon::join(one, other);
}

/// Does one after the other.
#[cfg(not(feature = "threads"))]
pub(crate) fn at_once(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    one();
    other();
}
