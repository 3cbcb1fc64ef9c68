//! The few measures of a vector that the solvers decide by.

use crate::error::StepFailure;
use crate::{Real, Scalar};

/// The number as it is reported in errors.
pub(crate) fn reported<T: Real>(value: T) -> f64 {
    nalgebra::convert_unchecked(value)
}

/// Where a vector has this many entries, it is worth to look at several at once.
const MANY: usize = 32;

/// maxᵢ |xᵢ|; an entry that is not a number does not count.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn largest<T: Real>(x: &[T]) -> T {
    fold(x.len(), T::lift(0.0), |largest, i| larger(largest, Scalar::abs(x[i])), larger)
}

/// Folds i = 0, …, n − 1 into `start`, by an operation for which neither the order matters nor whether `start` counts once or
/// more often: eight that do not wait for one another if there are many, joined in the end.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn fold<T: Real>(
    n: usize,
    start: T,
    mut add: impl FnMut(T, usize) -> T,
    join: impl Fn(T, T) -> T,
) -> T {
    if n < MANY {
        return (0..n).fold(start, add);
    }
    let mut partial = [start; 8];
    let chunks = n / 8;
    for chunk in 0..chunks {
        for (lane, partial) in partial.iter_mut().enumerate() {
            *partial = add(*partial, 8 * chunk + lane);
        }
    }
    let rest = (8 * chunks..n).fold(start, add);
    partial.into_iter().fold(rest, join)
}

/// The same of a few entries that are numbers; if one is not, some number or none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn largest_number<T: Real>(x: &[T]) -> T {
    let mut sizes = x.iter().map(|&x| Scalar::abs(x));
    let first = sizes.next().unwrap_or(T::lift(0.0));
    sizes.fold(first, larger)
}

/// Sets `mean` to (a + b)/2.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn mean<T: Real>(a: &[T], b: &[T], mean: &mut [T]) {
    for ((mean, &a), &b) in mean.iter_mut().zip(a).zip(b) {
        *mean = T::lift(0.5) * (a + b);
    }
}

/// 1/`pivot`, for a pivot of a matrix: an error if that is not a finite number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn reciprocal<T: Real>(pivot: T, column: usize) -> Result<T, StepFailure> {
    let reciprocal = T::lift(1.0) / pivot;
    if reciprocal.is_finite() { Ok(reciprocal) } else { Err(singular(pivot, column)) }
}

/// The error of a pivot that is no use.
#[cold]
pub(crate) fn singular<T: Real>(pivot: T, column: usize) -> StepFailure {
    StepFailure::Singular { column, pivot: reported(pivot) }
}

/// The smallest |xᵢ| that is not zero, at most `bound`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn smallest<T: Real>(x: &[T], bound: T) -> T {
    let smaller = |a, b| if b < a { b } else { a };
    let add = |smallest, i: usize| {
        let size = Scalar::abs(x[i]);
        if size < smallest && size > T::lift(0.0) { size } else { smallest }
    };
    fold(x.len(), bound, add, smaller)
}

/// maxᵢ |xᵢ − yᵢ|; an entry that is not a number does not count.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn distance<T: Real>(x: &[T], y: &[T]) -> T {
    let n = x.len().min(y.len());
    fold(n, T::lift(0.0), |largest, i| larger(largest, Scalar::abs(x[i] - y[i])), larger)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn larger<T: Real>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Whether all entries are finite, else which one is not.
///
/// The sum of the entries is finite only if they all are, or overflows; so one comparison settles the
/// usual case and only the unusual one looks at each entry.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn finite<T: Real>(x: &[T]) -> Result<(), StepFailure> {
    if nothing(x) == T::lift(0.0) { Ok(()) } else { each_finite(x) }
}

/// Zero if all entries are finite, and else, or if their sum overflows, not a number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn nothing<T: Real>(x: &[T]) -> T {
    // Four partial sums do not wait for one another. They begin at −0, which the compiler knows to add nothing.
    let (chunks, rest) = x.as_chunks::<4>();
    let partial = chunks.iter().fold([T::lift(-0.0); 4], |sum, x| [0, 1, 2, 3].map(|i| sum[i] + x[i]));
    let sum = rest.iter().fold((partial[0] + partial[2]) + (partial[1] + partial[3]), |sum, &x| sum + x);
    sum * T::lift(0.0)
}

/// Whether a number that is not negative is finite, by one comparison.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_finite<T: Real>(size: T) -> bool {
    size <= T::max_value().unwrap_or(T::lift(f64::MAX))
}

/// The largest |xᵢ|, if all entries are finite.
///
/// # Errors
/// [`StepFailure::NotFinite`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn finite_size<T: Real>(x: &[T]) -> Result<T, StepFailure> {
    let sum = x.iter().fold(T::lift(-0.0), |sum, &x| sum + x);
    if !is_finite(Scalar::abs(sum)) {
        each_finite(x)?;
    }
    let sizes = x.iter().map(|&x| Scalar::abs(x));
    Ok(sizes.reduce(larger).unwrap_or(T::lift(0.0)))
}

#[cold]
fn each_finite<T: Real>(x: &[T]) -> Result<(), StepFailure> {
    match x.iter().position(|x| !x.is_finite()) {
        Some(coordinate) => Err(StepFailure::NotFinite { coordinate, value: reported(x[coordinate]) }),
        None => Ok(()),
    }
}
