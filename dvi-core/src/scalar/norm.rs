//! The few measures of a vector that the solvers decide by.

use crate::error::StepFailure;
use crate::{Real, Scalar};

/// The number as it is reported in errors.
pub(crate) fn reported<T: Real>(value: T) -> f64 {
    nalgebra::convert_unchecked(value)
}

/// Where a vector has this many entries, it is worth to look at several at once.
pub(crate) const MANY: usize = 32;

/// maxᵢ |xᵢ|; an entry that is not a number does not count. Eight maxima do not wait for one another if
/// there are many entries.
#[inline]
pub(crate) fn largest<T: Real>(x: &[T]) -> T {
    let one_by_one = |x: &[T]| x.iter().fold(T::lift(0.0), |largest, &x| larger(largest, Scalar::abs(x)));
    if x.len() < MANY {
        return one_by_one(x);
    }
    let (chunks, rest) = x.as_chunks::<8>();
    let mut partial = [T::lift(0.0); 8];
    for chunk in chunks {
        for (partial, &x) in partial.iter_mut().zip(chunk) {
            *partial = larger(*partial, Scalar::abs(x));
        }
    }
    partial.into_iter().fold(one_by_one(rest), larger)
}

/// The same of entries that are numbers; if one is not, some number or none.
#[inline]
pub(crate) fn largest_number<T: Real>(x: &[T]) -> T {
    if x.len() >= MANY {
        return largest(x);
    }
    let mut sizes = x.iter().map(|&x| Scalar::abs(x));
    let first = sizes.next().unwrap_or(T::lift(0.0));
    sizes.fold(first, larger)
}

/// Sets `mean` to (a + b)/2.
#[inline]
pub(crate) fn mean<T: Real>(a: &[T], b: &[T], mean: &mut [T]) {
    for ((mean, &a), &b) in mean.iter_mut().zip(a).zip(b) {
        *mean = T::lift(0.5) * (a + b);
    }
}

/// 1/`pivot`, for a pivot of a matrix: an error if that is not a finite number.
#[inline]
pub(crate) fn reciprocal<T: Real>(pivot: T, column: usize) -> Result<T, StepFailure> {
    let reciprocal = T::lift(1.0) / pivot;
    if reciprocal.is_finite() { Ok(reciprocal) } else { Err(singular(pivot, column)) }
}

/// Whether a pivot of this size is of use: more than `least`, which rounding errors of others may make of
/// it. Not a number is none, and an infinite one would make all corrections zero.
#[inline]
pub(crate) fn is_pivot<T: Real>(size: T, least: T) -> bool {
    size > least && size < T::lift(f64::INFINITY)
}

/// The error of a pivot that is of no use.
#[cold]
pub(crate) fn singular<T: Real>(pivot: T, column: usize) -> StepFailure {
    let matrix = StepFailure::DISCRETE_LAGRANGIAN;
    StepFailure::Singular { matrix, column, pivot: reported(pivot) }
}

#[inline]
pub(crate) fn larger<T: Real>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

#[inline]
pub(crate) fn smaller<T: Real>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// Whether all entries are finite, else which one is not.
///
/// The sum of the entries is finite only if they all are, or overflows; so one comparison settles the
/// usual case and only the unusual one looks at each entry.
#[inline]
pub(crate) fn finite<T: Real>(x: &[T]) -> Result<(), StepFailure> {
    // Four partial sums do not wait for one another. They begin at −0, which the compiler knows to add
    // nothing.
    let (chunks, rest) = x.as_chunks::<4>();
    let partial = chunks.iter().fold([T::lift(-0.0); 4], |sum, x| [0, 1, 2, 3].map(|i| sum[i] + x[i]));
    let sum = rest.iter().fold((partial[0] + partial[2]) + (partial[1] + partial[3]), |sum, &x| sum + x);
    // Zero, or not a number.
    if sum * T::lift(0.0) == T::lift(0.0) { Ok(()) } else { each_finite(x) }
}

#[cold]
fn each_finite<T: Real>(x: &[T]) -> Result<(), StepFailure> {
    match x.iter().position(|x| !x.is_finite()) {
        Some(coordinate) => Err(StepFailure::NotFinite { coordinate, value: reported(x[coordinate]) }),
        None => Ok(()),
    }
}
