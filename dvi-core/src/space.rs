//! The two sizes of a configuration space: fixed at compile time, or known at run time only.
//!
//! A [`Space`] says how many coordinates there are and how a point, and a matrix over points, are
//! stored. Everything else in this crate sees flat slices, so that one body of code serves both: with
//! [`Fixed`] every length is a constant, and what is small lives on the stack; with [`RunTime`], and with
//! what is large, each array is allocated once, before the first step.
//!
//! A fixed space is `BLOCKS` blocks of `N` coordinates, `SINGLES` of which have one coordinate only. Stable
//! Rust can write `[[T; N]; BLOCKS]` where it cannot yet write `[T; (BLOCKS - SINGLES) * N + SINGLES]`, so
//! that is the storage in a value, and the entries beyond the dimension are never seen.

pub(crate) mod elimination;
pub(crate) mod inertia;
pub(crate) mod linear;
mod room;
mod rows;
pub mod sink;
pub(crate) mod square;
mod weights;

/// An array of coordinates whose length is known at run time only.
#[cfg(feature = "alloc")]
#[doc(no_inline)]
pub use alloc::vec::Vec;
use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::{Deref, DerefMut};

use crate::{Real, Scalar};

pub use linear::{
    CoupledSolver, FixedCoupled, FixedSolver, LinearEquations, LinearSolver, NodeSum, Storing,
};
#[cfg(feature = "alloc")]
pub use linear::{RunTimeCoupled, RunTimeSolver};
pub use room::{FewInPlace, InPlace, Room, Store};
#[cfg(feature = "alloc")]
pub use rows::SparseRows;
pub use rows::{FullRows, RowMatrix};
pub use sink::Sink;
#[cfg(feature = "alloc")]
pub use square::RunTimeSquare;
pub use square::{FixedSquare, SquareMatrix};
pub use weights::Weights;

/// The shape of a configuration space and the storage for it.
pub trait Space: Copy + Debug + PartialEq {
    /// Whether vectors live in the value itself, so that a new one on the stack costs nothing and may
    /// stay in registers. Where this does not hold, work space is kept from step to step.
    const ON_STACK: bool;
    /// A point, a velocity or a covector: `dimension` numbers.
    type Vector<T: Scalar>: Deref<Target = [T]> + DerefMut + Clone + Debug;
    /// A vector for the time of a function, where [`ON_STACK`](Self::ON_STACK) holds.
    type Local<T: Scalar>: Store<T>;
    /// A square matrix, `dimension`² numbers row by row.
    type Matrix<T: Scalar>: Deref<Target = [T]> + DerefMut + Clone + Debug + Sink<T>;
    /// A square matrix that is solved with, in the storage that its pattern needs.
    type Square<T: Real>: SquareMatrix<T>;
    /// What solves linear equations whose matrix comes entry by entry.
    type Linear<T: Real>: LinearSolver<T>;
    /// What solves linear equations for several vectors at once.
    type Coupled<const NODES: usize, T: Real>: CoupledSolver<NODES, T>;
    /// Something for each coordinate.
    type Array<E: Clone + Debug>: Deref<Target = [E]> + DerefMut + Clone + Debug;
    /// A row of `dimension` numbers for each dimension of `C`.
    type Rows<C: Space, T: Scalar>: RowMatrix<T>;
    /// A row permutation, `dimension` indices.
    type Permutation: Deref<Target = [usize]> + DerefMut + Clone + Debug;

    /// The number of coordinates.
    fn dimension(self) -> usize;
    /// A vector of zeros.
    fn vector<T: Scalar>(self) -> Self::Vector<T>;
    /// So many of them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn vectors<T: Scalar, const COUNT: usize>(self) -> [Self::Vector<T>; COUNT] {
        core::array::from_fn(|_| self.vector())
    }
    /// What `of` makes, for each coordinate.
    fn array<E: Clone + Debug>(self, of: impl FnMut() -> E) -> Self::Array<E>;
    /// Rows of zeros, one for each dimension of `over`, with room for the entries that `entries` visits.
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Rows<C, T>;
    /// A matrix of zeros.
    fn matrix<T: Scalar>(self) -> Self::Matrix<T>;
    /// A matrix of zeros with room for the entries in the rows and columns, below the dimension, that
    /// `entries` visits. Others may not be added to; see [`SquareMatrix::cleared`].
    fn square<T: Real>(self, entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self::Square<T>;
    /// A solver of linear equations with these entries, as of [`square`](Self::square). Where they are many
    /// and lie far apart, it keeps none of them.
    fn linear<T: Real>(
        self,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Linear<T>;
    /// A solver of linear equations for the last `unknown` of `NODES` vectors, coupled by blocks with these
    /// entries.
    fn coupled<const NODES: usize, T: Real>(
        self,
        unknown: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T>;
    /// A permutation, all zeros until it is written.
    fn permutation(self) -> Self::Permutation;
}

/// The rows of a row-major matrix with so many columns: none where there are none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lines<T>(matrix: &[T], columns: usize) -> core::slice::ChunksExact<'_, T> {
    matrix.chunks_exact(columns.max(1))
}

/// The same, to be written.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lines_mut<T>(matrix: &mut [T], columns: usize) -> core::slice::ChunksExactMut<'_, T> {
    matrix.chunks_exact_mut(columns.max(1))
}

/// `scratch!(name = system, field)`: a vector to work in, on the stack if that is where vectors of the
/// system live, so that it can stay in registers, and else the given field.
macro_rules! scratch {
    ($name:ident = $system:expr, $field:expr) => {
        let mut on_stack;
        let $name: &mut [T] = if <S::Space as $crate::Space>::ON_STACK {
            let dimension = $crate::Space::dimension($system.space());
            on_stack =
                <<S::Space as $crate::Space>::Local<T> as $crate::space::Store<T>>::new(dimension, || {
                    T::lift(0.0)
                });
            $crate::space::Store::entries_mut(&mut on_stack, dimension)
        } else {
            &mut $field
        };
    };
}
pub(crate) use scratch;

/// A space of `BLOCKS` blocks of `N` coordinates, of which `SINGLES` have one coordinate only:
/// (`BLOCKS` − `SINGLES`) `N` + `SINGLES` coordinates. [`Room`] says where vectors and matrices are kept.
///
/// Of systems with attributes, those of up to twelve coordinates are on the stack where sizes are literals,
/// and those of up to eight where one is a const generic. All others are on the heap. Without the feature
/// `alloc` there is none: all are on the stack, more than 64 coordinates do not compile, and neither does,
/// beside single coordinates, an `N` of zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fixed<const BLOCKS: usize, const N: usize, const SINGLES: usize = 0, R = InPlace>(PhantomData<R>);

impl<const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Fixed<BLOCKS, N, SINGLES, R> {
    /// The space.
    pub fn new() -> Self {
        Self::default()
    }

    const DIMENSION: usize = {
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

/// The vector of a [`Fixed`] space.
#[derive(Clone, Debug)]
pub struct FixedVector<
    T: Clone + Debug,
    const BLOCKS: usize,
    const N: usize,
    const SINGLES: usize = 0,
    R: Room = InPlace,
>(R::Vector<T, BLOCKS, N>);

/// The matrix of a [`Fixed`] space.
#[derive(Clone, Debug)]
pub struct FixedMatrix<
    T: Clone + Debug,
    const BLOCKS: usize,
    const N: usize,
    const SINGLES: usize = 0,
    R: Room = InPlace,
>(R::Matrix<T, BLOCKS, N>);

impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Deref
    for FixedVector<T, BLOCKS, N, SINGLES, R>
{
    type Target = [T];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deref(&self) -> &[T] {
        self.0.entries(Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION)
    }
}

impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> DerefMut
    for FixedVector<T, BLOCKS, N, SINGLES, R>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deref_mut(&mut self) -> &mut [T] {
        self.0.entries_mut(Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION)
    }
}

impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Deref
    for FixedMatrix<T, BLOCKS, N, SINGLES, R>
{
    type Target = [T];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deref(&self) -> &[T] {
        let dimension = Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION;
        self.0.entries(dimension * dimension)
    }
}

impl<T: Clone + Debug, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> DerefMut
    for FixedMatrix<T, BLOCKS, N, SINGLES, R>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deref_mut(&mut self) -> &mut [T] {
        let dimension = Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION;
        self.0.entries_mut(dimension * dimension)
    }
}

impl<T: Scalar, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Sink<T>
    for FixedMatrix<T, BLOCKS, N, SINGLES, R>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self[row * Fixed::<BLOCKS, N, SINGLES, R>::DIMENSION + column] += entry;
    }
}

impl<const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> Space
    for Fixed<BLOCKS, N, SINGLES, R>
{
    const ON_STACK: bool = Self::DIMENSION <= R::LARGEST;
    type Vector<T: Scalar> = FixedVector<T, BLOCKS, N, SINGLES, R>;
    type Local<T: Scalar> = R::Local<T, BLOCKS, N>;
    type Matrix<T: Scalar> = FixedMatrix<T, BLOCKS, N, SINGLES, R>;
    type Square<T: Real> = FixedSquare<T, BLOCKS, N, SINGLES, R>;
    type Linear<T: Real> = FixedSolver<T, BLOCKS, N, SINGLES, R>;
    type Coupled<const NODES: usize, T: Real> = FixedCoupled<T, NODES, BLOCKS, N, SINGLES, R>;
    type Array<E: Clone + Debug> = FixedVector<E, BLOCKS, N, SINGLES, R>;
    type Rows<C: Space, T: Scalar> = FullRows<C::Array<FixedVector<T, BLOCKS, N, SINGLES, R>>>;
    type Permutation = FixedVector<usize, BLOCKS, N, SINGLES, R>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn dimension(self) -> usize {
        Self::DIMENSION
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn vector<T: Scalar>(self) -> Self::Vector<T> {
        FixedVector(Store::new(Self::DIMENSION, || T::lift(0.0)))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn array<E: Clone + Debug>(self, of: impl FnMut() -> E) -> FixedVector<E, BLOCKS, N, SINGLES, R> {
        FixedVector(Store::new(Self::DIMENSION, of))
    }
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Rows<C, T> {
        FullRows(over.array(|| self.vector()))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn matrix<T: Scalar>(self) -> Self::Matrix<T> {
        FixedMatrix(Store::new(Self::DIMENSION * Self::DIMENSION, || T::lift(0.0)))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn square<T: Real>(self, _entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self::Square<T> {
        FixedSquare::new(self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear<T: Real>(
        self,
        _storing: Storing,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Linear<T> {
        FixedSolver::new(self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn coupled<const NODES: usize, T: Real>(
        self,
        _unknown: usize,
        _storing: Storing,
        _entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T> {
        FixedCoupled::new(self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn permutation(self) -> Self::Permutation {
        FixedVector(Store::new(Self::DIMENSION, || 0))
    }
}

/// A space whose dimension is known at run time only; its storage is on the heap.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunTime {
    /// The number of coordinates.
    pub dimension: usize,
}

/// The matrix of a [`RunTime`] space.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug, PartialEq)]
pub struct RunTimeMatrix<T> {
    entries: alloc::vec::Vec<T>,
    dimension: usize,
}

#[cfg(feature = "alloc")]
impl<T> Deref for RunTimeMatrix<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.entries
    }
}

#[cfg(feature = "alloc")]
impl<T> DerefMut for RunTimeMatrix<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Sink<T> for RunTimeMatrix<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.entries[row * self.dimension + column] += entry;
    }
}

#[cfg(feature = "alloc")]
impl RunTime {
    /// Reads a block of a state whose length the run knows; generated code does.
    #[doc(hidden)]
    pub fn read_block<T: Scalar>(len: usize, at: &mut usize, flat: &[T]) -> Vec<T> {
        let start = *at;
        *at += len;
        flat[start..*at].to_vec()
    }
}

#[cfg(feature = "alloc")]
impl Space for RunTime {
    const ON_STACK: bool = false;
    type Vector<T: Scalar> = alloc::vec::Vec<T>;
    type Local<T: Scalar> = alloc::vec::Vec<T>;
    type Matrix<T: Scalar> = RunTimeMatrix<T>;
    type Square<T: Real> = RunTimeSquare<T>;
    type Linear<T: Real> = RunTimeSolver<T>;
    type Coupled<const NODES: usize, T: Real> = RunTimeCoupled<T>;
    type Array<E: Clone + Debug> = alloc::vec::Vec<E>;
    type Rows<C: Space, T: Scalar> = SparseRows<T>;
    type Permutation = alloc::vec::Vec<usize>;

    fn dimension(self) -> usize {
        self.dimension
    }
    fn vector<T: Scalar>(self) -> Self::Vector<T> {
        alloc::vec![T::lift(0.0); self.dimension]
    }
    fn array<E: Clone + Debug>(self, mut of: impl FnMut() -> E) -> alloc::vec::Vec<E> {
        (0..self.dimension).map(|_| of()).collect()
    }
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> SparseRows<T> {
        SparseRows::new(over.dimension(), entries)
    }
    fn matrix<T: Scalar>(self) -> Self::Matrix<T> {
        let Self { dimension } = self;
        RunTimeMatrix { entries: alloc::vec![T::lift(0.0); dimension * dimension], dimension }
    }
    fn square<T: Real>(self, entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self::Square<T> {
        RunTimeSquare::new(self, entries)
    }
    fn linear<T: Real>(
        self,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Linear<T> {
        RunTimeSolver::new(self.dimension, storing, entries)
    }
    fn coupled<const NODES: usize, T: Real>(
        self,
        unknown: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T> {
        RunTimeCoupled::new(self, unknown, storing, entries)
    }
    fn permutation(self) -> Self::Permutation {
        alloc::vec![0; self.dimension]
    }
}
