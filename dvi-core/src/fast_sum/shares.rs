//! Work that threads share, with the feature `threads`.
//!
//! Each number is computed by one part, in an order that no cut changes: so results are bitwise the same for
//! every number of threads.

/// Something to do that can be cut in two.
pub(super) trait Part: Send + Sized {
    /// How much there is to do.
    fn size(&self) -> usize;
    /// Two parts of about the same size, or all of it if it cannot be cut.
    fn halves(self) -> (Self, Option<Self>);
}

/// Does all that there is to do.
pub(super) fn share<P: Part>(whole: P, run: &(impl Fn(P) + Sync)) {
    /// Parts for each thread: some are done sooner than others.
    const SHARES: usize = 8;
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

    #[cfg(feature = "threads")]
    let threads = rayon::current_num_threads();
    #[cfg(not(feature = "threads"))]
    let threads = 1;
    let largest = if threads == 1 { usize::MAX } else { LEAST.max(whole.size() / (SHARES * threads)) };
    cut(whole, largest, run);
}

fn at_once(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    #[cfg(feature = "threads")]
    rayon::join(one, other);
    #[cfg(not(feature = "threads"))]
    {
        one();
        other();
    }
}

/// Sorts numbers of which no two are equal.
pub(super) fn sort<T: Ord + Send>(numbers: &mut [T]) {
    #[cfg(feature = "threads")]
    rayon::slice::ParallelSliceMut::par_sort_unstable(numbers);
    #[cfg(not(feature = "threads"))]
    numbers.sort_unstable();
}

/// Changes each entry.
pub(super) fn each<T: Send>(entries: &mut [T], change: impl Fn(&mut T) + Sync) {
    #[cfg(feature = "threads")]
    {
        use rayon::iter::ParallelIterator;
        /// What is fewer is not worth handing over.
        const TOGETHER: usize = 4096;
        rayon::slice::ParallelSliceMut::par_chunks_mut(entries, TOGETHER)
            .for_each(|entries| entries.iter_mut().for_each(&change));
    }
    #[cfg(not(feature = "threads"))]
    entries.iter_mut().for_each(change);
}
