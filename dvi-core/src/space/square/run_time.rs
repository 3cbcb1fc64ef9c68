//! The square matrix of a space whose dimension is known at run time only: full, banded or sparse.

use alloc::boxed::Box;
use alloc::vec::Vec;

use super::SquareMatrix;
use super::banded::Banded;
use super::layout::Layout;
use super::ordering::Pattern;
use super::sparse::Sparse;
use crate::error::StepFailure;
use crate::space::RunTimeMatrix;
use crate::space::Sink;
use crate::space::elimination;
use crate::space::linear::scale;
use crate::{Real, RunTime, Scalar, Space};

/// The square matrix of a [`RunTime`] space.
#[derive(Clone, Debug)]
pub struct RunTimeSquare<T>(Storage<T>);

#[derive(Clone, Debug)]
enum Storage<T> {
    /// All entries, and the permutation of their rows.
    Dense(RunTimeMatrix<T>, Vec<usize>),
    /// Those near the diagonal.
    Banded(Banded<T>),
    /// Those of the pattern.
    Sparse(Box<Sparse<T>>),
}

impl<T: Scalar> RunTimeSquare<T> {
    /// With room for the entries that `entries` visits.
    pub(crate) fn new(space: RunTime, entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self {
        let mut pattern = Pattern::new(space.dimension);
        entries(&mut |row, column| pattern.add(row, column));
        Self::in_layout(space.dimension, Layout::of(pattern))
    }

    /// Stored in this way.
    pub(crate) fn in_layout(dimension: usize, layout: Layout) -> Self {
        let space = RunTime { dimension };
        Self(match layout {
            Layout::Full => Storage::Dense(space.matrix(), space.permutation()),
            Layout::Banded(order) => Storage::Banded(Banded::new(order)),
            Layout::Sparse(rows, fronts) => Storage::Sparse(Box::new(Sparse::new(&rows, fronts))),
        })
    }

    #[cfg(test)]
    pub(super) fn is_banded(&self) -> bool {
        matches!(self.0, Storage::Banded(_))
    }
}

impl<T: Scalar> Sink<T> for RunTimeSquare<T> {
    fn add(&mut self, row: usize, column: usize, entry: T) {
        match &mut self.0 {
            Storage::Dense(matrix, _) => matrix.add(row, column, entry),
            Storage::Banded(banded) => banded.add(row, column, entry),
            Storage::Sparse(sparse) => sparse.add(row, column, entry),
        }
    }
}

impl<T: Real> SquareMatrix<T> for RunTimeSquare<T> {
    type Entries = Self;

    fn cleared(&mut self) -> &mut Self {
        match &mut self.0 {
            Storage::Dense(matrix, _) => matrix.fill(T::lift(0.0)),
            Storage::Banded(banded) => banded.clear(),
            Storage::Sparse(sparse) => sparse.clear(),
        }
        self
    }
    fn scale_rows(&mut self, scales: &[T]) {
        match &mut self.0 {
            Storage::Dense(matrix, _) => elimination::scale_rows(matrix, scales),
            Storage::Banded(banded) => banded.scale_rows(scales),
            Storage::Sparse(sparse) => sparse.scale_rows(scales),
        }
    }
    fn eliminate(&mut self, scales: &mut [T], x: &mut [T]) -> Result<(), StepFailure> {
        if !matches!(self.0, Storage::Dense(..)) && !scales.is_empty() {
            self.scale_rows(scales);
            scale(x, scales);
        }
        match &mut self.0 {
            Storage::Dense(matrix, _) => elimination::eliminate(matrix, scales, x),
            Storage::Banded(banded) => {
                banded.factor()?;
                banded.solve(x);
                Ok(())
            }
            Storage::Sparse(sparse) => {
                sparse.factor()?;
                sparse.solve(x);
                Ok(())
            }
        }
    }
    fn eliminate_two(&self, weights: &[T], x: &mut [T]) -> Option<Result<(), StepFailure>> {
        match &self.0 {
            Storage::Dense(matrix, _) => elimination::eliminate_two(matrix, weights, x),
            Storage::Banded(_) | Storage::Sparse(_) => None,
        }
    }
    fn factor(&mut self) -> Result<(), StepFailure> {
        match &mut self.0 {
            Storage::Dense(matrix, permutation) => elimination::factor(matrix, permutation),
            Storage::Banded(banded) => banded.factor(),
            Storage::Sparse(sparse) => sparse.factor(),
        }
    }
    fn factor_in_any_units(&mut self) -> Result<(), StepFailure> {
        match &mut self.0 {
            Storage::Dense(matrix, permutation) => {
                elimination::factor_in_any_units(matrix, permutation, &mut [])
            }
            Storage::Banded(banded) => banded.factor(),
            Storage::Sparse(sparse) => sparse.factor(),
        }
    }
    fn factor_with_care(&mut self, work: [&mut [T]; 2]) -> Result<(), StepFailure> {
        match &mut self.0 {
            Storage::Dense(matrix, permutation) => elimination::factor_with_care(matrix, permutation, work),
            Storage::Banded(banded) => banded.factor(),
            Storage::Sparse(sparse) => sparse.factor(),
        }
    }
    fn solve(&self, x: &mut [T]) {
        match &self.0 {
            Storage::Dense(matrix, permutation) => elimination::solve(matrix, permutation, x),
            Storage::Banded(banded) => banded.solve(x),
            Storage::Sparse(sparse) => sparse.solve(x),
        }
    }
    fn is_positive(&self) -> bool {
        match &self.0 {
            Storage::Dense(matrix, permutation) => elimination::is_positive(matrix, permutation),
            Storage::Banded(banded) => banded.is_positive(),
            Storage::Sparse(sparse) => sparse.is_positive(),
        }
    }
    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        match &self.0 {
            Storage::Dense(matrix, _) => super::multiply_add(matrix, factor, x, sum),
            Storage::Banded(banded) => banded.multiply_add(factor, x, sum),
            Storage::Sparse(sparse) => sparse.multiply_add(factor, x, sum),
        }
    }
}
