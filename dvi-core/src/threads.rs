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

/// Something to do that can be cut in two.
#[cfg(feature = "fast-sums")]
pub(crate) trait Part: Send + Sized {
    /// How much there is to do.
    fn size(&self) -> usize;
    /// Two parts of about the same size, or all of it if it cannot be cut.
    fn halves(self) -> (Self, Option<Self>);
}

/// Does all that there is to do.
#[cfg(feature = "fast-sums")]
pub(crate) fn share<P: Part>(whole: P, run: &(impl Fn(P) + Sync)) {
    /// What is smaller is not worth handing over.
    const LEAST: usize = 64;

    fn cut<P: Part>(part: P, largest: usize, run: &(impl Fn(P) + Sync)) {
        if part.size() <= largest {
            return run(part);
        }
        match part.halves() {
            (one, Some(other)) => at_once(|| cut(one, largest, run), || cut(other, largest, run)),
            (all, None) => run(all),
        }
    }

    let largest = largest_part(whole.size(), LEAST);
    cut(whole, largest, run);
}

/// Sorts numbers of which no two are equal.
#[cfg(all(feature = "fast-sums", feature = "threads"))]
pub(crate) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    rayon::slice::ParallelSliceMut::par_sort_unstable(numbers);
}

/// Sorts numbers of which no two are equal.
#[cfg(all(feature = "fast-sums", not(feature = "threads")))]
pub(crate) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    numbers.sort_unstable();
}

/// Changes each entry.
#[cfg(all(feature = "fast-sums", feature = "threads"))]
pub(crate) fn each<T: Send>(entries: &mut [T], change: impl Fn(&mut T) + Sync) {
    use rayon::iter::ParallelIterator;
    /// What is fewer is not worth handing over.
    const TOGETHER: usize = 4096;
    rayon::slice::ParallelSliceMut::par_chunks_mut(entries, TOGETHER)
        .for_each(|entries| entries.iter_mut().for_each(&change));
}

/// Changes each entry.
#[cfg(all(feature = "fast-sums", not(feature = "threads")))]
pub(crate) fn each<T: Send>(entries: &mut [T], change: impl Fn(&mut T) + Sync) {
    entries.iter_mut().for_each(change);
}
