//! Linear equations whose matrix comes entry by entry: by elimination in the storage of its pattern, or,
//! where that would be that of a full matrix of high dimension, from products with vectors alone.

pub(crate) mod blocks;
mod coupled;
#[cfg(feature = "alloc")]
mod krylov;

use core::fmt::Debug;
use core::ops::Deref;

#[cfg(feature = "alloc")]
use crate::RunTime;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::square::SquareMatrix;
#[cfg(feature = "alloc")]
use crate::space::square::{Layout, Pattern, RunTimeSquare};
use crate::space::{Sink, Space};
use crate::{Real, Scalar};
#[cfg(feature = "alloc")]
use krylov::Krylov;

#[cfg(feature = "alloc")]
pub(crate) use coupled::RunTimeCoupled;
pub(crate) use coupled::{Blocks, CoupledSolver, NodeSum, entries};

/// A system of linear equations A x = b that can be evaluated as often as it is asked for.
pub trait LinearEquations<T> {
    /// Sets `b` and adds the entries of A to `sink`.
    ///
    /// # Errors
    /// Those of what they are computed from.
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure>;
}

/// The residual of the point where `equations` are linearised, b, relative in each row to Σⱼ |Aᵢⱼ| sⱼ and
/// |`given`(i)|, what is given in that row, with the sizes sⱼ = |`size`(j)| of the unknowns: the relative
/// error of the equations that this point solves (Oettli & Prager 1964). `b` and `sums` are storage.
#[cold]
#[inline(never)]
pub(crate) fn residual<T: Real>(
    equations: &mut impl LinearEquations<T>,
    size: impl Fn(usize) -> T,
    given: impl Fn(usize) -> T,
    [b, sums]: [&mut [T]; 2],
) -> Result<T, StepFailure> {
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = Scalar::abs(given(i));
    }
    let mut sink: &mut dyn FnMut(usize, usize, T) = &mut |i, j, a| sums[i] += Scalar::abs(a * size(j));
    equations.evaluate(b, &mut sink)?;
    relative(b, sums)
}

/// The largest residual `b` of a row, relative to what it is made of; one that is not a number is an error.
pub(crate) fn relative<T: Real>(b: &[T], sums: &[T]) -> Result<T, StepFailure> {
    let mut largest = T::lift(0.0);
    for (coordinate, (&b, &sum)) in b.iter().zip(sums).enumerate() {
        if !b.is_finite() {
            return Err(StepFailure::NotFinite { coordinate, value: norm::reported(b) });
        }
        if b != T::lift(0.0) {
            largest = norm::larger(largest, Scalar::abs(b) / sum);
        }
    }
    Ok(largest)
}

/// The same of equations for several vectors, whose residuals are in `vectors`, and whose unknowns have the
/// sizes one over `weights`.
#[cold]
#[inline(never)]
pub(crate) fn residual_of_nodes<
    const NODES: usize,
    T: Real,
    M: NodeSum<NODES, T>,
    V: Deref<Target = [T]>,
>(
    matrix: &mut M,
    weights: &[T],
    vectors: &[V; NODES],
    sums: &mut [T],
) -> Result<T, StepFailure> {
    let mut largest = T::lift(0.0);
    for (r, vector) in vectors.iter().enumerate().skip(M::FIRST) {
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = Scalar::abs(matrix.given(i));
        }
        entries(matrix, |[row, _], [i, j], entry| {
            if row == r {
                sums[i] += Scalar::abs(entry / weights[j]);
            }
        });
        largest = norm::larger(largest, relative(vector, sums)?);
    }
    Ok(largest)
}

/// What solves linear equations, with the storage that it needs.
pub trait LinearSolver<T: Real> {
    /// Sets `x` to the solution, whose entries have the sizes one over `weights`.
    ///
    /// # Errors
    /// Those of the equations; [`StepFailure::Singular`] if A is singular, or [`StepFailure::NotFinite`] if
    /// b is no number there; [`StepFailure::NotConverged`] where products with vectors lead to no solution.
    /// Of a regular A and a b that is no number, the solution may be no number.
    fn solve(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure>;
}

/// Where a number has its exponent.
const EXPONENT: u64 = 0x7ff << 52;

/// Sets `scales` to the sizes of unknowns with these weights, in units of the largest but for its binary
/// digits, which would round; there may be several unknowns for each weight. Scales are numbers without
/// derivatives; of what has no size it is one.
#[inline]
pub(crate) fn set_scales<T: Real>(scales: &mut [T], weights: &[T]) {
    let least = weights.iter().fold(T::lift(f64::INFINITY), |least, &weight| norm::smaller(least, weight));
    let unit = power_below(least);
    for scales in scales.chunks_mut(weights.len().max(1)) {
        for (scale, &weight) in scales.iter_mut().zip(weights) {
            let size = T::lift(norm::reported(unit / weight));
            *scale = if size > T::lift(1e-140) { size } else { T::lift(1.0) };
        }
    }
}

/// The largest power of two up to `scale`: times that, nothing is rounded.
#[inline]
pub(crate) fn power_below<T: Real>(scale: T) -> T {
    T::lift(f64::from_bits(norm::reported(scale).to_bits() & EXPONENT))
}

/// Multiplies the entries of `x` by their scales.
#[inline]
pub(crate) fn scale<T: Real>(x: &mut [T], scales: &[T]) {
    x.iter_mut().zip(scales).for_each(|(x, &scale)| *x *= scale);
}

/// What solves with a matrix that is stored.
#[derive(Debug)]
pub struct Stored<S: Space, T: Real> {
    matrix: S::Square<T>,
    scales: S::Vector<T>,
}

impl<S: Space, T: Real> Stored<S, T> {
    #[inline]
    pub(crate) fn new(space: S, matrix: S::Square<T>) -> Self {
        Self { matrix, scales: space.vector() }
    }
}

impl<S: Space, T: Real> LinearSolver<T> for Stored<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure> {
        let Self { matrix, scales } = self;
        equations.evaluate(x, matrix.cleared())?;
        if let Some(solved) = matrix.eliminate_two(weights, x) {
            return solved;
        }
        let finite = norm::finite(x);
        // Each equation is the derivative of an action by an unknown: times the size of that it is in units
        // of the action, and pivots may be compared whatever the units of A.
        set_scales(scales, weights);
        match matrix.eliminate(scales, x) {
            Ok(()) => Ok(()),
            Err(StepFailure::Singular { .. }) if finite.is_ok() => {
                set_scales(scales, weights);
                by_factors(matrix, equations, scales, x)
            }
            Err(singular) => Err(finite.err().unwrap_or(singular)),
        }
    }
}

/// Solves where elimination has found no pivot, of which the sizes of unknowns may be to blame.
#[cold]
#[inline(never)]
fn by_factors<T: Real, M: SquareMatrix<T>>(
    matrix: &mut M,
    equations: &mut impl LinearEquations<T>,
    scales: &[T],
    x: &mut [T],
) -> Result<(), StepFailure> {
    equations.evaluate(x, matrix.cleared())?;
    matrix.scale_rows(scales);
    scale(x, scales);
    matrix.factor_in_any_units()?;
    matrix.solve(x);
    Ok(())
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
pub enum RunTimeSolver<T: Real> {
    Matrix(Stored<RunTime, T>),
    Products(Krylov<T>),
}

#[cfg(feature = "alloc")]
impl<T: Real> RunTimeSolver<T> {
    /// For a matrix with the entries that `entries` visits.
    pub(crate) fn new(
        space: RunTime,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self {
        let RunTime { dimension } = space;
        let products = || Self::Products(Krylov::new(dimension));
        if storing == Storing::Never {
            return products();
        }
        let mut pattern = Pattern::new(dimension);
        entries(&mut |row, column| pattern.add(row, column));
        let layout = Layout::of(pattern);
        let is_large = layout.storage(dimension) > NUMBERS_IN_A_ROW.saturating_mul(dimension);
        if storing == Storing::IfSmall && is_large {
            return products();
        }
        Self::Matrix(Stored::new(space, RunTimeSquare::in_layout(dimension, layout)))
    }
}

#[cfg(feature = "alloc")]
impl<T: Real> LinearSolver<T> for RunTimeSolver<T> {
    fn solve(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure> {
        match self {
            Self::Matrix(stored) => stored.solve(equations, weights, x),
            Self::Products(krylov) => krylov.solve(equations, weights, x),
        }
    }
}
