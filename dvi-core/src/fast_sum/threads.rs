//! Work that is cut into parts, which threads share, with the feature `threads`.
//!
//! Each number is computed by one part, in an order that no cut changes: so results are bitwise the same for every number of threads.

/// Something to do that can be cut in two.
#[cfg_attr(not(feature = "threads"), allow(dead_code, reason = "one thread does it all"))]
pub(super) trait Part: Send + Sized {
    /// How much there is to do.
    fn size(&self) -> usize;
    /// Two parts of about the same size, or all of it if it cannot be cut.
    fn halves(self) -> (Self, Option<Self>);
}

/// Parts for each thread: some are done sooner than others.
#[cfg(feature = "threads")]
const SHARES: usize = 8;
/// What is smaller is not worth handing over.
#[cfg(feature = "threads")]
const LEAST: usize = 64;

/// Does all that there is to do.
#[cfg(feature = "threads")]
pub(super) fn share<P: Part>(whole: P, run: &(impl Fn(P) + Sync)) {
    let threads = rayon::current_num_threads();
    let largest = if threads == 1 { usize::MAX } else { LEAST.max(whole.size() / (SHARES * threads)) };
    cut(whole, largest, run);
}

#[cfg(feature = "threads")]
fn cut<P: Part>(part: P, largest: usize, run: &(impl Fn(P) + Sync)) {
    if part.size() <= largest {
        return run(part);
    }
    match part.halves() {
        (one, Some(other)) => {
            rayon::join(|| cut(one, largest, run), || cut(other, largest, run));
        }
        (all, None) => run(all),
    }
}

/// Does all that there is to do.
#[cfg(not(feature = "threads"))]
pub(super) fn share<P: Part>(whole: P, run: &(impl Fn(P) + Sync)) {
    run(whole);
}

/// Sorts numbers of which no two are equal.
#[cfg(feature = "threads")]
pub(super) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    rayon::slice::ParallelSliceMut::par_sort_unstable(numbers);
}

/// Sorts numbers of which no two are equal.
#[cfg(not(feature = "threads"))]
pub(super) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    numbers.sort_unstable();
}
