//! The pairs of many bodies, which threads share.
//!
//! Each pair is computed once, and adds to the entries of both of its bodies. First come the pairs within
//! each half of the bodies, at once, and then those of one half with the other; pairs of two groups are
//! those of their first halves and, at once, of their second halves, and then those crosswise. What is done
//! at once has no body in common. To each entry is added in an order that depends on the number of bodies
//! alone: so results are bitwise the same for every number of threads.

use crate::Scalar;
use crate::scalar::pack::CHUNK;
use crate::scalar::simd::wide_if;
use crate::threads::{at_once, is_in_pool, largest_part};

/// So many bodies are halved. The pairs of fewer are taken as they come.
const MANY: usize = 512;
/// A group of as many bodies is not halved.
const GROUP: usize = 128;
/// So many pairs are not worth handing to another thread,
const LEAST: usize = 4096;
/// nor are so many in all worth waking threads from outside of their pool.
const LEAST_FROM_OUTSIDE: usize = 300_000;

/// Whether the pairs of `bodies` are taken in [`halves`].
#[inline]
pub fn are_many(bodies: usize) -> bool {
    bodies >= MANY
}

/// Adds what the pairs of `bodies` are to their `entries` in `B` vectors.
///
/// `row(body, [lower, upper, first], entries)` takes the pairs of `body` with those from `lower` to before
/// `upper`, which all come after it. It adds to their `entries`, which begin with that of `first`, and
/// returns what is to be added to those of `body`.
#[inline(never)]
pub fn halves<const B: usize, T: Scalar>(
    bodies: usize,
    entries: [&mut [T]; B],
    row: impl Fn(usize, [usize; 3], &mut [&mut [T]; B]) -> [T; B] + Sync,
) {
    let all = bodies * bodies / 2;
    let is_worth_it = is_in_pool() || all > LEAST_FROM_OUTSIDE;
    let largest = if is_worth_it { largest_part(all, LEAST) } else { usize::MAX };
    let pairs = |one: Option<&mut Bodies<'_, B, T>>, others: &mut Bodies<'_, B, T>| {
        wide_if!(true, rows(one, others, &row));
    };
    within(&mut Bodies { first: 0, past: bodies, entries }, &Work { largest, pairs: &pairs });
}

/// Bodies that lie beside one another.
struct Bodies<'a, const B: usize, T> {
    first: usize,
    /// The one after the last.
    past: usize,
    entries: [&'a mut [T]; B],
}

impl<const B: usize, T> Bodies<'_, B, T> {
    fn count(&self) -> usize {
        self.past - self.first
    }

    fn halves(&mut self) -> [Bodies<'_, B, T>; 2] {
        // Whole packs.
        let size = (self.count() / 2).next_multiple_of(CHUNK).min(self.count());
        let middle = self.first + size;
        let mut parts = self.entries.each_mut().map(|entries| entries.split_at_mut(size));
        let first = parts.each_mut().map(|(first, _)| core::mem::take(first));
        let second = parts.map(|(_, second)| second);
        [
            Bodies { first: self.first, past: middle, entries: first },
            Bodies { first: middle, past: self.past, entries: second },
        ]
    }
}

/// What is done for the pairs of two groups, or within one.
type Pairs<'a, const B: usize, T> = dyn Fn(Option<&mut Bodies<'_, B, T>>, &mut Bodies<'_, B, T>) + Sync + 'a;

/// What is done for all pairs. It is behind a pointer, so that what cuts them is the same for all systems.
struct Work<'a, const B: usize, T> {
    /// As many pairs stay on one thread.
    largest: usize,
    pairs: &'a Pairs<'a, B, T>,
}

impl<const B: usize, T> Work<'_, B, T> {
    /// Both parts of `pairs` pairs.
    fn both(&self, pairs: usize, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
        if pairs > self.largest {
            at_once(one, other);
        } else {
            one();
            other();
        }
    }
}

/// The pairs of `bodies` with one another.
fn within<const B: usize, T: Scalar>(bodies: &mut Bodies<'_, B, T>, work: &Work<'_, B, T>) {
    let count = bodies.count();
    if count <= GROUP {
        return (work.pairs)(None, bodies);
    }
    let [mut one, mut other] = bodies.halves();
    work.both(count * count / 2, || within(&mut one, work), || within(&mut other, work));
    between(&mut one, &mut other, work);
}

/// The pairs of each of `one` with each of `other`.
fn between<const B: usize, T: Scalar>(
    one: &mut Bodies<'_, B, T>,
    other: &mut Bodies<'_, B, T>,
    work: &Work<'_, B, T>,
) {
    if one.count().max(other.count()) <= GROUP {
        return (work.pairs)(Some(one), other);
    }
    let count = one.count() * other.count();
    for crosswise in [false, true] {
        let [mut a, mut b] = one.halves();
        let [mut c, mut d] = other.halves();
        if crosswise {
            core::mem::swap(&mut c, &mut d);
        }
        work.both(count / 2, || between(&mut a, &mut c, work), || between(&mut b, &mut d, work));
    }
}

/// The pairs of each of `one`, or of each of `others`, with those of `others` that come after it.
#[cfg_attr(not(debug_assertions), inline(always))]
fn rows<const B: usize, T: Scalar>(
    mut one: Option<&mut Bodies<'_, B, T>>,
    others: &mut Bodies<'_, B, T>,
    row: &impl Fn(usize, [usize; 3], &mut [&mut [T]; B]) -> [T; B],
) {
    let Bodies { first, past, entries } = others;
    let mut of_others = Aligned([[T::lift(-0.0); GROUP]; B]);
    let mut slices = of_others.0.each_mut().map(|sums| &mut sums[..]);
    let bodies = one.as_ref().map_or(*first..*past, |one| one.first..one.past);
    for (place, body) in bodies.enumerate() {
        let sums = row(body, [(body + 1).max(*first), *past, *first], &mut slices);
        match &mut one {
            Some(one) => add(&mut one.entries, place, sums),
            None => add(entries, place, sums),
        }
    }
    for (entries, sums) in entries.iter_mut().zip(&of_others.0) {
        for (entry, &sum) in entries.iter_mut().zip(sums).take(*past - *first) {
            *entry += sum;
        }
    }
}

/// Adds to the entries at a place.
fn add<const B: usize, T: Scalar>(entries: &mut [&mut [T]; B], place: usize, sums: [T; B]) {
    for output in 0..B {
        entries[output][place] += sums[output];
    }
}

/// Sums over the bodies of a group, where no pack crosses a line of the cache.
#[repr(align(64))]
struct Aligned<const B: usize, T>([[T; GROUP]; B]);
