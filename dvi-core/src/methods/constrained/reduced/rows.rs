//! Linear algebra with a few rows: the gradients of the constraints.

use core::ops::Deref;

use crate::solve::sizes::weight_of;
use crate::space::elimination::LEAST;
use crate::space::{Sink, SquareMatrix};
use crate::{Real, Scalar};

/// Sums begin here: added to any number it leaves that number, so that the compiler may drop the first
/// addition.
pub(super) const NEUTRAL: f64 = -0.0;

/// Adds Σ `factors`ₖ `rows`ₖ to `sum`.
#[inline]
pub(super) fn combine<T: Real, V: Deref<Target = [T]>>(rows: &[V], factors: &[T], sum: &mut [T]) {
    for (row, &factor) in rows.iter().zip(factors) {
        for (sum, &entry) in sum.iter_mut().zip(row.iter()) {
            *sum += factor * entry;
        }
    }
}

/// a·b, from the last entry to the first: of three entries the compiler then packs the first two, as it does
/// elsewhere.
#[inline]
pub(super) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).rev().fold(T::lift(NEUTRAL), |sum, (&a, &b)| sum + a * b)
}

/// One over the length of a gradient with this square: constraints have units of their own, and may be
/// compared where their gradients are as long as one.
#[inline]
fn scale<T: Real>(square: T) -> T {
    weight_of(Scalar::sqrt(Scalar::abs(square)))
}

/// Sets a matrix to A Bᵀ, where A and B have these rows, times the scales of constraints whose gradients
/// have these `squares`.
#[inline]
pub(super) fn fill<T: Real, V: Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    [a, b]: [&[V]; 2],
    squares: &[T],
) {
    let entries = gram.cleared();
    for (k, (a, &square)) in a.iter().zip(squares).enumerate() {
        let scale = scale(square);
        for (l, b) in b.iter().enumerate() {
            entries.add(k, l, scale * dot(a, b));
        }
    }
}

/// Overwrites `x` with the solution of A Bᵀ y = x, where A and B have these rows, for constraints whose
/// gradients have these `squares`; `None` where the matrix is singular.
#[inline]
pub(super) fn solve<T: Real, V: Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    rows: [&[V]; 2],
    squares: &[T],
    x: &mut [T],
) -> Option<()> {
    if let ([a], [b], [x]) = (rows[0], rows[1], &mut *x) {
        let pivot = dot(a, b);
        *x /= pivot;
        return (Scalar::abs(pivot) > T::default_epsilon() * T::lift(LEAST)).then_some(());
    }
    fill(gram, rows, squares);
    x.iter_mut().zip(squares).for_each(|(x, &square)| *x *= scale(square));
    gram.eliminate(&mut [], x).ok()
}
