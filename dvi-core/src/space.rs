//! The two sizes of a configuration space: fixed at compile time, or known at run time only.
//!
//! A [`Space`] says how many coordinates there are and how a point, and a matrix over points, are
//! stored. Everything else in this crate sees flat slices, so that one body of code serves both: with
//! [`Fixed`] every length is a constant, and what is small lives on the stack; with [`RunTime`], and with
//! what is large, each array is allocated once, before the first step.

pub(crate) mod elimination;
mod fixed;
pub(crate) mod inertia;
pub(crate) mod linear;
pub(crate) mod room;
mod rows;
#[cfg(feature = "alloc")]
mod run_time;
mod sink;
pub(crate) mod square;

/// An array of coordinates whose length is known at run time only.
#[cfg(feature = "alloc")]
#[doc(no_inline)]
pub use alloc::vec::Vec;
use core::fmt::Debug;
use core::ops::{Deref, DerefMut};

use crate::{Real, Scalar};

pub use fixed::Fixed;
pub(crate) use linear::{CoupledSolver, LinearEquations, LinearSolver, NodeSum, Storing};
pub(crate) use room::{InPlace, Room, Store};
pub(crate) use rows::RowMatrix;
#[cfg(feature = "alloc")]
pub use run_time::RunTime;
pub use sink::Sink;
pub(crate) use square::SquareMatrix;

/// The shape of a configuration space and the storage for it.
pub trait Space: Copy + Debug + PartialEq {
    /// Whether vectors live in the value itself, so that a new one on the stack costs nothing and may
    /// stay in registers. Where this does not hold, work space is kept from step to step.
    const ON_STACK: bool;
    /// Something for each coordinate: the numbers of a point, a velocity or a covector, the indices of a
    /// permutation.
    type Vector<E: Clone + Debug>: Deref<Target = [E]> + DerefMut + Clone + Debug;
    /// A vector for the time of a function, where [`ON_STACK`](Self::ON_STACK) holds.
    type Local<T: Scalar>: Store<T>;
    /// A square matrix, `dimension`² numbers row by row.
    type Matrix<T: Scalar>: Deref<Target = [T]> + DerefMut + Clone + Debug + Sink<T>;
    /// A square matrix that is solved with, in the storage that its pattern needs.
    type Square<T: Real>: SquareMatrix<T>;
    /// What solves linear equations whose matrix comes entry by entry.
    type Linear<T: Real>: LinearSolver<T> + Debug;
    /// What solves linear equations for several vectors at once.
    type Coupled<const NODES: usize, T: Real>: CoupledSolver<NODES, T>;
    /// A row of `dimension` numbers for each dimension of `C`.
    type Rows<C: Space, T: Scalar>: RowMatrix<T>;

    /// The number of coordinates.
    fn dimension(self) -> usize;
    /// A vector of zeros.
    #[inline]
    fn vector<T: Scalar>(self) -> Self::Vector<T> {
        self.array(T::lift(0.0))
    }
    /// So many of them.
    #[inline]
    fn vectors<T: Scalar, const COUNT: usize>(self) -> [Self::Vector<T>; COUNT] {
        core::array::from_fn(|_| self.vector())
    }
    /// `entry` for each coordinate.
    fn array<E: Clone + Debug>(self, entry: E) -> Self::Vector<E>;
    /// Rows of zeros, one for each dimension of `over`, with room for the entries that `entries` visits.
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Rows<C, T>;
    /// A matrix of zeros.
    fn matrix<T: Scalar>(self) -> Self::Matrix<T>;
    /// A matrix of zeros with room for the entries in the rows and columns, below the dimension, that
    /// `entries` visits. Others may not be added to; see `SquareMatrix::cleared`.
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
}

/// The rows of a row-major matrix with so many columns: none where there are none.
pub(crate) fn lines<T>(matrix: &[T], columns: usize) -> core::slice::ChunksExact<'_, T> {
    matrix.chunks_exact(columns.max(1))
}

/// The same, to be written.
pub(crate) fn lines_mut<T>(matrix: &mut [T], columns: usize) -> core::slice::ChunksExactMut<'_, T> {
    matrix.chunks_exact_mut(columns.max(1))
}

/// `scratch!(name = system, field)`: a vector to work in, on the stack if that is where vectors of the
/// system live, so that it can stay in registers, and else the given field.
macro_rules! scratch {
    ($name:ident = $system:expr, $field:expr) => {
        let mut on_stack;
        let $name: &mut [T] = if <S::Space as $crate::Space>::ON_STACK {
            let (dimension, zero) = ($crate::Space::dimension($system.space()), T::lift(0.0));
            on_stack =
                <<S::Space as $crate::Space>::Local<T> as $crate::space::Store<T>>::new(dimension, zero);
            $crate::space::Store::entries_mut(&mut on_stack, dimension)
        } else {
            &mut $field
        };
    };
}
pub(crate) use scratch;

/// The weights of the four blocks of the second derivative of L(q, v, t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<T> {
    /// Weight of ∂²L/∂qⁱ∂qʲ.
    pub qq: T,
    /// Weight of ∂²L/∂qⁱ∂vʲ.
    pub qv: T,
    /// Weight of ∂²L/∂vⁱ∂qʲ.
    pub vq: T,
    /// Weight of ∂²L/∂vⁱ∂vʲ.
    pub vv: T,
}

impl<T: Real> Weights<T> {
    /// Those that leave nothing.
    #[inline]
    pub(crate) fn none() -> Self {
        let zero = T::lift(0.0);
        Self { qq: zero, qv: zero, vq: zero, vv: zero }
    }

    /// Those that leave the mass matrix, ∂²L/∂v∂v.
    pub(crate) fn mass() -> Self {
        Self { vv: T::lift(1.0), ..Self::none() }
    }
}

/// Numbers in (−1, 1) from a linear congruential generator.
#[cfg(test)]
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
