//! Square matrices that a sink fills and that are then solved with, in the storage that their pattern needs.
//!
//! With a dimension fixed at compile time they are dense. With one that is known at run time only, they are
//! stored in the way in which their elimination takes the least work. They are banded where the entries, in
//! the best order that is found, lie close enough to the diagonal: chains and rings, whose coordinates may
//! stand in several blocks. With n coordinates and b diagonals on each side, storage grows as n b and the
//! time of a solution as n b². They are sparse where there are few entries and no narrow band: trees,
//! networks, wide lattices. All others are full, also where one coordinate couples to all: its row may be
//! the pivot of any column, and then all columns fill. The search for an order of elimination ends where it
//! takes long, as in networks with links everywhere. Rows are exchanged in each of them, for the largest
//! pivot in a column.

#[cfg(feature = "alloc")]
mod banded;
#[cfg(feature = "alloc")]
mod exchanges;
#[cfg(feature = "alloc")]
mod fronts;
#[cfg(feature = "alloc")]
mod layout;
#[cfg(feature = "alloc")]
mod ordering;
#[cfg(feature = "alloc")]
mod run_time;
#[cfg(feature = "alloc")]
mod sparse;

use core::fmt::Debug;

use crate::error::StepFailure;
use crate::scalar::passes::multiply;
use crate::space::linear::scale;
use crate::space::{Sink, elimination, lines_mut};
use crate::{Real, Scalar, Space};

#[cfg(feature = "alloc")]
pub(crate) use layout::Layout;
#[cfg(feature = "alloc")]
pub(crate) use ordering::Pattern;
#[cfg(feature = "alloc")]
pub(crate) use run_time::RunTimeSquare;

/// A square matrix A that is filled entry by entry and then solved with. Its storage is chosen when it is
/// made.
pub trait SquareMatrix<T: Real>: Clone + Debug {
    /// What takes the entries.
    type Entries: Sink<T>;

    /// The entries, all of them set to zero. What is added to others than those that the matrix was made
    /// with is an error when it is solved with.
    fn cleared(&mut self) -> &mut Self::Entries;

    /// Multiplies row i by sᵢ.
    fn scale_rows(&mut self, scales: &[T]);

    /// Overwrites `x` with the solution of A y = x, and A and `scales` with nothing of use. Rows times their
    /// `scales` may be compared; where there are none, as they are.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] with the column that has no pivot, and the largest candidate for it;
    /// [`StepFailure::Pattern`] with an entry that has no room.
    fn eliminate(&mut self, scales: &mut [T], x: &mut [T]) -> Result<(), StepFailure> {
        if !scales.is_empty() {
            self.scale_rows(scales);
            scale(x, scales);
        }
        self.factor()?;
        self.solve(x);
        Ok(())
    }

    /// The same of two equations for unknowns with these `weights`, for which there is a faster way, or
    /// there are not two; A stays as it is.
    ///
    /// # Errors
    /// [`StepFailure::Singular`], or [`StepFailure::NotFinite`] if x is no number then.
    fn eliminate_two(&self, _weights: &[T], _x: &mut [T]) -> Option<Result<(), StepFailure>> {
        None
    }

    /// Replaces A by its factors.
    ///
    /// # Errors
    /// As [`eliminate`](Self::eliminate).
    fn factor(&mut self) -> Result<(), StepFailure>;

    /// The same of a matrix whose rows and columns may have units of very different size, if its storage has
    /// a way for it.
    ///
    /// # Errors
    /// As [`eliminate`](Self::eliminate).
    fn factor_in_any_units(&mut self) -> Result<(), StepFailure> {
        self.factor()
    }

    /// The same, which also finds singular what rounding errors of its entries may make singular, if its
    /// storage has a way for it. `work` has room for two vectors.
    ///
    /// # Errors
    /// As [`eliminate`](Self::eliminate).
    fn factor_with_care(&mut self, _work: [&mut [T]; 2]) -> Result<(), StepFailure> {
        self.factor()
    }

    /// Overwrites `x` with the solution of A y = x, for an A that has been factored.
    fn solve(&self, x: &mut [T]);

    /// Whether the determinant of an A that has been factored is positive.
    fn is_positive(&self) -> bool;

    /// Adds `factor` A x to `sum`, for an A that has not been factored.
    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]);
}

/// A full matrix, and the permutation of its rows.
#[derive(Clone, Debug)]
pub struct Full<S: Space, T: Scalar> {
    matrix: S::Matrix<T>,
    permutation: S::Vector<usize>,
}

impl<S: Space, T: Scalar> Full<S, T> {
    #[inline]
    pub(crate) fn new(space: S) -> Self {
        Self { matrix: space.matrix(), permutation: space.array(0) }
    }
}

impl<S: Space, T: Real> SquareMatrix<T> for Full<S, T> {
    type Entries = S::Matrix<T>;

    #[inline]
    fn cleared(&mut self) -> &mut Self::Entries {
        // −0 is neutral for every number, so that the first addition to an entry may be dropped.
        self.matrix.fill(T::lift(-0.0));
        &mut self.matrix
    }
    #[inline]
    fn scale_rows(&mut self, scales: &[T]) {
        for (line, &scale) in lines_mut(&mut self.matrix, scales.len()).zip(scales) {
            multiply(line, scale);
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn eliminate(&mut self, scales: &mut [T], x: &mut [T]) -> Result<(), StepFailure> {
        elimination::eliminate(&mut self.matrix, scales, x)
    }
    #[inline]
    fn eliminate_two(&self, weights: &[T], x: &mut [T]) -> Option<Result<(), StepFailure>> {
        elimination::eliminate_two(&self.matrix, weights, x)
    }
    #[inline]
    fn factor(&mut self) -> Result<(), StepFailure> {
        elimination::factor(&mut self.matrix, &mut self.permutation)
    }
    fn factor_in_any_units(&mut self) -> Result<(), StepFailure> {
        elimination::factor_in_any_units(&mut self.matrix, &mut self.permutation, &mut [])
    }
    fn factor_with_care(&mut self, work: [&mut [T]; 2]) -> Result<(), StepFailure> {
        elimination::factor_with_care(&mut self.matrix, &mut self.permutation, work)
    }
    #[inline]
    fn solve(&self, x: &mut [T]) {
        elimination::solve(&self.matrix, &self.permutation, x);
    }
    #[inline]
    fn is_positive(&self) -> bool {
        let (matrix, permutation): (&[T], &[usize]) = (&self.matrix, &self.permutation);
        let n = permutation.len();
        let is_negative = |k: usize| matrix[k * n + k] < T::lift(0.0);
        (0..n).fold(true, |positive, k| positive ^ is_negative(k) ^ (permutation[k] != k))
    }
    #[inline]
    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        elimination::multiply_add(&self.matrix, factor, x, sum);
    }
}

#[cfg(test)]
mod tests;
