//! Linear equations whose matrix comes entry by entry: by elimination in the storage of its pattern, or, where that would
//! be that of a full matrix of high dimension, from products with vectors alone.

pub(crate) mod blocks;
mod coupled;
#[cfg(feature = "alloc")]
mod krylov;

use core::fmt::Debug;

use crate::Real;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::square::SquareMatrix;
use crate::space::{FixedSquare, Room, Sink};

#[cfg(feature = "alloc")]
use crate::Scalar;
#[cfg(feature = "alloc")]
use crate::space::square::{Layout, Pattern, RunTimeSquare};
#[cfg(feature = "alloc")]
use krylov::Krylov;

#[cfg(feature = "alloc")]
pub use coupled::RunTimeCoupled;
pub use coupled::{CoupledSolver, FixedCoupled, NodeSum};

/// A system of linear equations A x = b that can be evaluated as often as it is asked for.
pub trait LinearEquations<T> {
    /// Sets `b` and adds the entries of A to `sink`.
    ///
    /// # Errors
    /// Those of what they are computed from.
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure>;

    /// Whether A is regular but for single points, so that a small pivot is one of units, and not of rows that depend on each other.
    const IN_ANY_UNITS: bool = false;
}

/// What solves linear equations, with the storage that it needs.
pub trait LinearSolver<T: Real>: Debug {
    /// Sets `x` to the solution.
    ///
    /// # Errors
    /// Those of the equations; [`StepFailure::Singular`] if A is singular, or [`StepFailure::NotFinite`] if b is no number
    /// there; [`StepFailure::NotConverged`] where products with vectors lead to no solution. Of a regular A and a b that is no
    /// number, the solution may be no number.
    fn solve(&mut self, equations: &mut impl LinearEquations<T>, x: &mut [T]) -> Result<(), StepFailure>;
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn eliminate<T: Real, M: SquareMatrix<T>, E: LinearEquations<T>>(
    matrix: &mut M,
    equations: &mut E,
    x: &mut [T],
) -> Result<(), StepFailure> {
    equations.evaluate(x, matrix.cleared())?;
    if let Some(solved) = matrix.eliminate_two(x) {
        return solved;
    }
    let finite = norm::finite(x);
    match matrix.eliminate(x) {
        Ok(()) => Ok(()),
        Err(StepFailure::Singular { .. }) if finite.is_ok() && E::IN_ANY_UNITS => {
            by_factors(matrix, equations, x)
        }
        Err(singular) => Err(finite.err().unwrap_or(singular)),
    }
}

/// The same where elimination has found no pivot.
#[cold]
#[inline(never)]
fn by_factors<T: Real, M: SquareMatrix<T>>(
    matrix: &mut M,
    equations: &mut impl LinearEquations<T>,
    x: &mut [T],
) -> Result<(), StepFailure> {
    equations.evaluate(x, matrix.cleared())?;
    matrix.factor_in_any_units()?;
    matrix.solve(x);
    Ok(())
}

impl<T: Real, const BLOCKS: usize, const N: usize, const SINGLES: usize, R: Room> LinearSolver<T>
    for FixedSquare<T, BLOCKS, N, SINGLES, R>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(&mut self, equations: &mut impl LinearEquations<T>, x: &mut [T]) -> Result<(), StepFailure> {
        eliminate(self, equations, x)
    }
}

/// Whether a matrix is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storing {
    /// It is, in the storage that its pattern needs.
    Always,
    /// It is, unless it would take more than 1024 numbers for each row on average.
    IfSmall,
    /// It is not: products with vectors have to do. A matrix of fixed size is stored all the same.
    Never,
}

/// How many numbers a matrix takes at most for each of its rows, where it is stored if it is small.
#[cfg(feature = "alloc")]
const NUMBERS_IN_A_ROW: usize = 1024;

/// The linear solver of a [`RunTime`](crate::RunTime) space.
#[cfg(feature = "alloc")]
#[derive(Debug)]
pub struct RunTimeSolver<T>(Storage<T>);

#[cfg(feature = "alloc")]
#[derive(Debug)]
enum Storage<T> {
    Matrix(RunTimeSquare<T>),
    Products(Krylov<T>),
}

#[cfg(feature = "alloc")]
impl<T: Scalar> RunTimeSolver<T> {
    /// For a matrix with the entries that `entries` visits.
    pub(crate) fn new(
        dimension: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self {
        if storing == Storing::Never {
            return Self(Storage::Products(Krylov::new(dimension)));
        }
        let mut pattern = Pattern::new(dimension);
        entries(&mut |row, column| pattern.add(row, column));
        let layout = Layout::of(pattern);
        let is_large = layout.storage(dimension) > NUMBERS_IN_A_ROW.saturating_mul(dimension);
        Self(if storing == Storing::IfSmall && is_large {
            Storage::Products(Krylov::new(dimension))
        } else {
            Storage::Matrix(RunTimeSquare::in_layout(dimension, layout))
        })
    }
}

#[cfg(feature = "alloc")]
impl<T: Real> LinearSolver<T> for RunTimeSolver<T> {
    fn solve(&mut self, equations: &mut impl LinearEquations<T>, x: &mut [T]) -> Result<(), StepFailure> {
        match &mut self.0 {
            Storage::Matrix(matrix) => eliminate(matrix, equations, x),
            Storage::Products(krylov) => krylov.solve(equations, x),
        }
    }
}
