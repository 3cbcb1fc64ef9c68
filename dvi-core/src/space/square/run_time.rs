//! The square matrix of a space whose dimension is known at run time only: full, banded or sparse.

use alloc::boxed::Box;

use super::banded::Banded;
use super::layout::Layout;
use super::ordering::Pattern;
use super::sparse::Sparse;
use super::{Full, SquareMatrix};
use crate::error::StepFailure;
use crate::space::Sink;
use crate::{Real, RunTime, Scalar};

/// The square matrix of a [`RunTime`] space.
#[derive(Clone, Debug)]
pub enum RunTimeSquare<T: Scalar> {
    Full(Full<RunTime, T>),
    /// The entries near the diagonal.
    Banded(Banded<T>),
    /// Those of the pattern.
    Sparse(Box<Sparse<T>>),
}

/// What is done with the matrix, whichever storage it has.
macro_rules! stored {
    ($storage:expr, $matrix:ident => $done:expr) => {
        match $storage {
            RunTimeSquare::Full($matrix) => $done,
            RunTimeSquare::Banded($matrix) => $done,
            RunTimeSquare::Sparse($matrix) => $done,
        }
    };
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
        match layout {
            Layout::Full => Self::Full(Full::new(RunTime { dimension })),
            Layout::Banded(order) => Self::Banded(Banded::new(order)),
            Layout::Sparse(rows, fronts) => Self::Sparse(Box::new(Sparse::new(&rows, fronts))),
        }
    }
}

impl<T: Real> Sink<T> for RunTimeSquare<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        match self {
            Self::Full(full) => full.matrix.add(row, column, entry),
            Self::Banded(matrix) => matrix.add(row, column, entry),
            Self::Sparse(matrix) => matrix.entries.add(row, column, entry),
        }
    }
}

impl<T: Real> SquareMatrix<T> for RunTimeSquare<T> {
    type Entries = Self;

    fn cleared(&mut self) -> &mut Self {
        stored!(self, matrix => _ = matrix.cleared());
        self
    }
    fn scale_rows(&mut self, scales: &[T]) {
        stored!(self, matrix => matrix.scale_rows(scales));
    }
    fn eliminate(&mut self, scales: &mut [T], x: &mut [T]) -> Result<(), StepFailure> {
        stored!(self, matrix => matrix.eliminate(scales, x))
    }
    fn eliminate_two(&self, weights: &[T], x: &mut [T]) -> Option<Result<(), StepFailure>> {
        stored!(self, matrix => matrix.eliminate_two(weights, x))
    }
    fn factor(&mut self) -> Result<(), StepFailure> {
        stored!(self, matrix => matrix.factor())
    }
    fn factor_in_any_units(&mut self) -> Result<(), StepFailure> {
        stored!(self, matrix => matrix.factor_in_any_units())
    }
    fn factor_with_care(&mut self, work: [&mut [T]; 2]) -> Result<(), StepFailure> {
        stored!(self, matrix => matrix.factor_with_care(work))
    }
    fn solve(&self, x: &mut [T]) {
        stored!(self, matrix => matrix.solve(x));
    }
    fn is_positive(&self) -> bool {
        stored!(self, matrix => matrix.is_positive())
    }
    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        stored!(self, matrix => matrix.multiply_add(factor, x, sum));
    }
}
