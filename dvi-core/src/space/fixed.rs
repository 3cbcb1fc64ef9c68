//! A space whose dimension is known at compile time.
//!
//! A fixed space is `BLOCKS` blocks of `N` coordinates, `SINGLES` of which have one coordinate only. Stable
//! Rust can write `[[T; N]; BLOCKS]` where it cannot yet write `[T; (BLOCKS - SINGLES) * N + SINGLES]`, so
//! that is the storage in a value, and the entries beyond the dimension are never seen.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::{Deref, DerefMut};

use super::linear::{Blocks, Stored, Storing};
use super::rows::FullRows;
use super::square::Full;
use super::{InPlace, Room, Sink, Space, Store};
use crate::{Real, Scalar};

/// A space of `BLOCKS` blocks of `N` coordinates, of which `SINGLES` have one coordinate only:
/// (`BLOCKS` − `SINGLES`) `N` + `SINGLES` coordinates. `R` says where vectors and matrices are kept.
///
/// Of systems with attributes, those of up to twelve coordinates are on the stack where sizes are literals,
/// and those of up to eight where one is a const generic. All others are on the heap. Without the feature
/// `alloc` there is none: all are on the stack, more than 64 coordinates do not compile, and neither does,
/// beside single coordinates, an `N` of zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fixed<const BLOCKS: usize, const N: usize, const SINGLES: usize = 0, R = InPlace>(PhantomData<R>);

impl<const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Fixed<BLOCKS, N, SINGLES, R> {
    /// The space.
    #[inline]
    pub fn new() -> Self {
        Self::default()
    }

    pub(super) const DIMENSION: usize = {
        assert!(SINGLES <= BLOCKS, "more single coordinates than blocks");
        let dimension = (BLOCKS - SINGLES) * N + SINGLES;
        assert!(
            dimension <= BLOCKS * N || R::LARGEST < usize::MAX,
            "an array of coordinates beside single ones needs one entry at least"
        );
        assert!(
            dimension <= 64 || cfg!(feature = "alloc"),
            "more than 64 coordinates need a heap: switch on the feature `alloc` of `dvi-core`"
        );
        dimension
    };
}

/// A vector or a matrix: what is seen of its storage, `$count` entries where the dimension is `$n`.
macro_rules! stored {
    ($(#[$doc:meta])* $Name:ident, $Storage:ident, $n:ident => $count:expr) => {
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $Name<T, const BLOCKS: usize, const N: usize, const SINGLES: usize, R>(
            R::$Storage<T, BLOCKS, N>,
        )
        where
            T: Clone + Debug,
            R: Room;

        impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Deref
            for $Name<T, BLOCKS, N, SINGLES, R>
        {
            type Target = [T];
            #[inline]
            fn deref(&self) -> &[T] {
                let $n = Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION;
                self.0.entries($count)
            }
        }

        impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> DerefMut
            for $Name<T, BLOCKS, N, SINGLES, R>
        {
            #[inline]
            fn deref_mut(&mut self) -> &mut [T] {
                let $n = Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION;
                self.0.entries_mut($count)
            }
        }
    };
}

stored!(
    /// The vector of a [`Fixed`] space.
    FixedVector, Vector, n => n
);
stored!(
    /// The matrix of a [`Fixed`] space.
    FixedMatrix, Matrix, n => n * n
);

impl<T: Scalar, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Sink<T>
    for FixedMatrix<T, BLOCKS, N, SINGLES, R>
{
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self[row * Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION + column] += entry;
    }
}

impl<const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Space
    for Fixed<BLOCKS, N, SINGLES, R>
{
    const ON_STACK: bool = Self::DIMENSION <= R::LARGEST;
    type Vector<E: Clone + Debug> = FixedVector<E, BLOCKS, N, SINGLES, R>;
    type Local<T: Scalar> = R::Local<T, BLOCKS, N>;
    type Matrix<T: Scalar> = FixedMatrix<T, BLOCKS, N, SINGLES, R>;
    type Square<T: Real> = Full<Self, T>;
    type Linear<T: Real> = Stored<Self, T>;
    type Coupled<const NODES: usize, T: Real> = Blocks<NODES, Self, T>;
    type Rows<C: Space, T: Scalar> = FullRows<C::Vector<Self::Vector<T>>>;

    #[inline]
    fn dimension(self) -> usize {
        Self::DIMENSION
    }
    #[inline]
    fn array<E: Clone + Debug>(self, entry: E) -> Self::Vector<E> {
        FixedVector(Store::new(Self::DIMENSION, entry))
    }
    #[inline]
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Rows<C, T> {
        FullRows(over.array(self.vector()))
    }
    #[inline]
    fn matrix<T: Scalar>(self) -> Self::Matrix<T> {
        FixedMatrix(Store::new(Self::DIMENSION * Self::DIMENSION, T::lift(0.0)))
    }
    #[inline]
    fn square<T: Real>(self, _entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self::Square<T> {
        Full::new(self)
    }
    #[inline]
    fn linear<T: Real>(
        self,
        _storing: Storing,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Linear<T> {
        Stored::new(self, Full::new(self))
    }
    #[inline]
    fn coupled<const NODES: usize, T: Real>(
        self,
        _unknown: usize,
        _storing: Storing,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T> {
        Blocks::new(self)
    }
}
