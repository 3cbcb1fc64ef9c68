//! The terms of a sum, several at a time.
//!
//! A generated loop whose terms need arithmetic alone runs over its first terms in packs of [`CHUNK`], and
//! over the rest one by one. Each sum then has one partial sum for each place in a pack. Where numbers are
//! packs themselves, the same loop takes one term at a time and adds it to the same partial sum: its results
//! are those of the lanes, bit for bit.

use core::marker::PhantomData;

use crate::scalar::lanes::Lanes;
use crate::scalar::simd::widest_if;
use crate::{Parameter, Real, Scalar};

/// The number of terms in a pack, and of partial sums.
pub(crate) const CHUNK: usize = 8;

/// Terms of a sum over numbers `T` that are computed at once.
pub trait Pack<T>: Scalar {
    /// How many.
    const WIDTH: usize;
    /// See [`all`].
    fn all(value: T) -> Self;
    /// See [`load`].
    fn load(from: &[T], at: usize) -> Self;
    /// See [`parameters`].
    fn parameters<P: Parameter<T>>(from: &[P], at: usize) -> Self;
    /// See [`add_to`].
    fn add(to: &mut [T], at: usize, terms: Self);
    /// See [`Waiting::exchange`].
    fn exchange<const K: usize>(self, waiting: &mut [T; K]) -> Self;
}

impl<T: Real> Pack<T> for Lanes<CHUNK, T> {
    const WIDTH: usize = CHUNK;
    #[inline]
    fn all(value: T) -> Self {
        Lanes::all(value)
    }
    #[inline]
    fn load(from: &[T], at: usize) -> Self {
        let mut terms = [T::lift(0.0); CHUNK];
        terms.copy_from_slice(&from[at..at + CHUNK]);
        Self(terms)
    }
    #[inline]
    fn parameters<P: Parameter<T>>(from: &[P], at: usize) -> Self {
        let (from, mut terms) = (&from[at..at + CHUNK], [T::lift(0.0); CHUNK]);
        for term in 0..CHUNK {
            terms[term] = from[term].value();
        }
        Self(terms)
    }
    #[inline]
    fn add(to: &mut [T], at: usize, terms: Self) {
        let to = &mut to[at..at + CHUNK];
        for term in 0..CHUNK {
            to[term] += terms.0[term];
        }
    }
    #[inline]
    fn exchange<const K: usize>(self, waiting: &mut [T; K]) -> Self {
        const { assert!(K <= CHUNK) };
        let mut terms = self;
        for term in 0..CHUNK {
            terms.0[term] = if term < K { waiting[term] } else { self.0[term - K] };
        }
        for term in 0..K {
            waiting[term] = self.0[CHUNK - K + term];
        }
        terms
    }
}

impl<const W: usize, T: Real> Pack<Self> for Lanes<W, T> {
    const WIDTH: usize = 1;
    #[inline]
    fn all(value: Self) -> Self {
        value
    }
    #[inline]
    fn load(from: &[Self], at: usize) -> Self {
        from[at]
    }
    #[inline]
    fn parameters<P: Parameter<Self>>(from: &[P], at: usize) -> Self {
        from[at].value()
    }
    #[inline]
    fn add(to: &mut [Self], at: usize, terms: Self) {
        to[at] += terms;
    }
    #[inline]
    fn exchange<const K: usize>(self, waiting: &mut [Self; K]) -> Self {
        waiting.rotate_left(1);
        waiting.last_mut().map_or(self, |last| core::mem::replace(last, self))
    }
}

/// `value` in all terms.
#[inline]
pub fn all<T: Scalar>(value: T) -> T::Pack {
    T::Pack::all(value)
}

/// The entries of `from` that begin at `at`.
#[inline]
pub fn load<T: Scalar>(from: &[T], at: usize) -> T::Pack {
    T::Pack::load(from, at)
}

/// The parameters `from` that begin at `at`.
#[inline]
pub fn parameters<T: Scalar, P: Parameter<T>>(from: &[P], at: usize) -> T::Pack {
    T::Pack::parameters(from, at)
}

/// Adds each term to its entry of `to`, beginning at `at`.
#[inline]
pub fn add_to<T: Scalar>(to: &mut [T], at: usize, terms: T::Pack) {
    T::Pack::add(to, at, terms);
}

/// The last terms of a pack, where each term is added `K` places behind the first entry that the pack adds
/// to: they wait for the next pack, which adds to their entries.
#[derive(Clone, Copy, Debug)]
pub struct Waiting<const K: usize, T>(pub [T; K]);

impl<const K: usize, T: Scalar> Waiting<K, T> {
    /// The terms that belong to the entries of a pack: those that have waited, and then the first of
    /// `terms`. The others wait.
    #[inline]
    pub fn exchange(&mut self, terms: T::Pack) -> T::Pack {
        terms.exchange(&mut self.0)
    }

    /// Adds what waits to its entries of `to`, beginning at `at`.
    #[inline]
    pub fn add_to(self, to: &mut [T], at: usize) {
        for (entry, term) in to[at..].iter_mut().zip(self.0) {
            *entry += term;
        }
    }
}

/// The partial sums of a sum over packs.
#[derive(Clone, Copy, Debug)]
pub struct Sums<T> {
    partial: [T; CHUNK],
    /// Where the next term goes.
    next: usize,
}

impl<T: Scalar> Sums<T> {
    /// No terms yet: −0, which is neutral for every number.
    #[inline]
    pub fn empty() -> Self {
        Self { partial: [T::lift(-0.0); CHUNK], next: 0 }
    }

    /// Adds terms, each to the partial sum of its place.
    #[inline]
    pub fn add_terms(&mut self, terms: T::Pack) {
        T::Pack::add(&mut self.partial, self.next, terms);
        self.next = (self.next + T::Pack::WIDTH) % CHUNK;
    }

    /// The sum of all terms.
    #[inline]
    pub fn total(self) -> T {
        let [mut sum, rest @ ..] = self.partial;
        for partial in rest {
            sum += partial;
        }
        sum
    }
}

/// The end of the last whole chunk of a range.
#[inline]
pub fn whole(lower: usize, upper: usize) -> usize {
    upper - upper.saturating_sub(lower) % CHUNK
}

/// The first place of a range for which none of the `before` places before it is beyond the end of a ring.
#[inline]
pub fn first_unturned(lower: usize, upper: usize, before: usize) -> usize {
    lower.max(before).min(upper)
}

/// The end of the places, from `first` on, for which none of the `behind` places behind them is beyond the
/// end, `length`, of a ring.
#[inline]
pub fn past_unturned(first: usize, length: usize, behind: usize) -> usize {
    length.saturating_sub(behind).max(first)
}

/// Where the packs of numbers `T` begin in a range of whole chunks.
#[inline]
pub fn packs<T: Scalar>(lower: usize, upper: usize) -> Packs<T> {
    Packs { next: lower, upper, numbers: PhantomData }
}

/// The places that [`packs`] names.
#[derive(Debug)]
pub struct Packs<T> {
    next: usize,
    upper: usize,
    numbers: PhantomData<T>,
}

impl<T: Scalar> Iterator for Packs<T> {
    type Item = usize;
    #[inline]
    fn next(&mut self) -> Option<usize> {
        let here = self.next;
        (here < self.upper).then(|| {
            self.next = here + T::Pack::WIDTH;
            here
        })
    }
}

/// Loops over fewer numbers than this are not worth a choice of instructions.
const FEW: usize = 32;

/// What `body` returns; where it takes many numbers at once, it runs compiled for the widest instructions of
/// the processor.
#[inline]
pub fn widest<T: Scalar, R>(size: usize, body: impl FnOnce() -> R) -> R {
    widest_if(T::Pack::WIDTH > 1 && size >= FEW, body)
}
