//! Gaussian elimination with partial pivoting, in place on a row-major slice: [`factor`] keeps PA = LU for
//! many right-hand sides, [`eliminate`] serves one and is faster. Two equations are solved by determinants
//! where these lose nothing.
//!
//! A pivot counts as zero when it is no larger than the rounding errors of the numbers that were
//! subtracted to form its column: |pivot| ≤ n ε maxᵢ |uᵢₖ|, i < k. The test does not change when the
//! matrix is multiplied by a constant, unless pivots become so small that their reciprocals overflow.
//! [`factor_in_any_units`] holds it against those that were subtracted to form it alone, n ε Σⱼ |lₖⱼ uⱼₖ|,
//! which does not change either when rows and columns are multiplied by constants of their own, as they are
//! where coordinates have units; but it sees less of what rounding has left over of rows that depend on each
//! other. [`factor_with_care`] sees that too, and takes longer: it holds each pivot against what errors of
//! n ε in all entries make of it. Where rows have units of their own, [`eliminate`] compares pivots in
//! scales of the rows, and changes no number by them.
//! Source: Golub & Van Loan, *Matrix Computations* (2013), algorithm 3.4.1.

use core::ops::Deref;

use crate::error::StepFailure;
use crate::scalar::norm::{finite, is_pivot, larger, singular};
use crate::space::linear::set_scales;
use crate::space::lines;
use crate::{Real, Scalar};

/// What a pivot is compared with at least: n ε times this still has a finite reciprocal.
pub(crate) const LEAST: f64 = 1e-290;

/// Overwrites the n×n `matrix` with L (unit diagonal, not stored) and U, and `permutation` with the row
/// that was exchanged with row k at stage k. n is the length of `permutation`.
///
/// # Errors
/// [`StepFailure::Singular`] with the column and the largest candidate for its pivot.
#[inline]
pub(crate) fn factor<T: Real>(matrix: &mut [T], permutation: &mut [usize]) -> Result<(), StepFailure> {
    factor_by(matrix, permutation, &mut [], pivot_row)
}

/// The same of a matrix whose rows and columns may have units of very different size. Rows are compared in
/// their `scales`, as by [`eliminate`].
#[inline]
pub(crate) fn factor_in_any_units<T: Real>(
    matrix: &mut [T],
    permutation: &mut [usize],
    scales: &mut [T],
) -> Result<(), StepFailure> {
    factor_by(matrix, permutation, scales, |matrix, scales, [n, k], rounding| {
        let (row, _) = largest_below(matrix, scales, [n, k]);
        let pivot = Scalar::abs(matrix[row * n + k]);
        let terms = (0..k).map(|j| Scalar::abs(matrix[row * n + j] * matrix[j * n + k]));
        let subtracted = terms.fold(T::lift(LEAST), |sum, term| sum + term);
        if is_pivot(pivot, rounding * subtracted) { Ok(row) } else { Err(singular(pivot, k)) }
    })
}

/// The same, which also finds singular what errors of n ε in the entries of |L||U| could make singular.
/// `work` has two vectors of n entries.
///
/// To first order, errors δA change pivot k by x·δA y, where x is row k of L⁻¹ and y solves U y = uₖₖ eₖ
/// within the first k columns: that is the derivative of uₖₖ = det Aₖ / det Aₖ₋₁ with respect to the
/// entries, for the leading minors Aₖ of PA.
pub(crate) fn factor_with_care<T: Real>(
    matrix: &mut [T],
    permutation: &mut [usize],
    work: [&mut [T]; 2],
) -> Result<(), StepFailure> {
    factor_by(matrix, permutation, &mut [], |matrix, scales, [n, k], rounding| {
        let (row, pivot) = largest_below(matrix, scales, [n, k]);
        if is_pivot(pivot, rounding * T::lift(LEAST)) { Ok(row) } else { Err(singular(pivot, k)) }
    })?;
    let (n, [x, y]) = (permutation.len(), work);
    let rounding = T::default_epsilon() * T::lift(n as f64);
    for k in 0..n {
        (x[k], y[k]) = (T::lift(1.0), T::lift(1.0));
        let mut change = Scalar::abs(matrix[k * n + k]);
        for j in (0..k).rev() {
            let [mut left, mut right] = [T::lift(0.0); 2];
            let [mut left_size, mut right_size] = [left; 2];
            for i in j + 1..=k {
                let [below, beside] = [x[i] * matrix[i * n + j], matrix[j * n + i] * y[i]];
                (left, right) = (left - below, right - beside);
                (left_size, right_size) = (left_size + Scalar::abs(below), right_size + Scalar::abs(beside));
            }
            let pivot = matrix[j * n + j];
            (x[j], y[j]) = (left, right / pivot);
            change += (left_size + Scalar::abs(left)) * (right_size + Scalar::abs(right));
        }
        let pivot = Scalar::abs(matrix[k * n + k]);
        if !is_pivot(pivot, rounding * change) {
            return Err(singular(pivot, k));
        }
    }
    Ok(())
}

/// With the row that `pivot_row` chooses in each column.
#[cfg_attr(not(debug_assertions), inline(always))]
fn factor_by<T: Real>(
    matrix: &mut [T],
    permutation: &mut [usize],
    scales: &mut [T],
    pivot_row: impl Fn(&[T], &[T], [usize; 2], T) -> Result<usize, StepFailure>,
) -> Result<(), StepFailure> {
    let n = permutation.len();
    let rounding = T::default_epsilon() * T::lift(n as f64);
    for k in 0..n {
        let row = pivot_row(matrix, scales, [n, k], rounding)?;
        permutation[k] = row;
        let (upper, lower) = matrix.split_at_mut((k + 1) * n);
        let upper = &mut upper[k * n..];
        if row > k {
            upper.swap_with_slice(&mut lower[(row - k - 1) * n..(row - k) * n]);
            if !scales.is_empty() {
                scales.swap(k, row);
            }
        }
        let reciprocal = T::lift(1.0) / upper[k];
        for line in lower.chunks_exact_mut(n) {
            let factor = line[k] * reciprocal;
            line[k] = factor;
            for (a, &u) in line[k + 1..].iter_mut().zip(&upper[k + 1..]) {
                *a -= factor * u;
            }
        }
    }
    Ok(())
}

/// The size of an entry in a row, times its scale if rows have one.
#[inline]
fn scaled<T: Real>(entry: T, row: usize, scales: &[T]) -> T {
    Scalar::abs(scales.get(row).map_or(entry, |&scale| entry * scale))
}

/// The row at or below `k` with the largest entry in column `k`, and its size.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest_below<T: Real>(matrix: &[T], scales: &[T], [n, k]: [usize; 2]) -> (usize, T) {
    let size = |row: usize| scaled(matrix[row * n + k], row, scales);
    let (mut best, mut largest) = (k, size(k));
    for row in k + 1..n {
        let size = size(row);
        // The same comparison twice, which compiles to a maximum: a pair takes twice as many instructions.
        if size > largest {
            best = row;
        }
        largest = larger(largest, size);
    }
    (best, largest)
}

/// The row at or below `k` with the largest entry in column `k`, if that is more than rounding errors of
/// those above.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pivot_row<T: Real>(
    matrix: &[T],
    scales: &[T],
    [n, k]: [usize; 2],
    rounding: T,
) -> Result<usize, StepFailure> {
    let (row, pivot) = largest_below(matrix, scales, [n, k]);
    let above = (0..k).fold(T::lift(LEAST), |m, i| larger(m, scaled(matrix[i * n + k], i, scales)));
    if is_pivot(pivot, rounding * above) { Ok(row) } else { Err(singular(pivot, k)) }
}

/// Overwrites `x` with the solution of A y = x, A as left behind by [`factor`]. It sees the storage, and
/// with it a number of equations that is fixed.
#[inline]
pub(crate) fn solve<T: Real>(
    matrix: &impl Deref<Target = [T]>,
    permutation: &impl Deref<Target = [usize]>,
    x: &mut [T],
) {
    let n = permutation.len();
    let x = &mut x[..n];
    for k in 0..n {
        x.swap(k, permutation[k]);
    }
    for i in 1..n {
        let sum = matrix[i * n..i * n + i].iter().zip(&x[..i]).fold(x[i], |s, (&l, &x)| s - l * x);
        x[i] = sum;
    }
    for i in (0..n).rev() {
        let line = &matrix[i * n..(i + 1) * n];
        let sum = line[i + 1..].iter().zip(&x[i + 1..]).fold(x[i], |s, (&u, &x)| s - u * x);
        x[i] = sum / line[i];
    }
}

/// The length of a row below which its end is not worth a loop of its own.
const SHORT: usize = 8;

/// Overwrites `x` with the solution of A y = x, and the row-major A with nothing of use. Rows are compared
/// in their `scales`, which come to lie as the rows do in the end, or as they are if there are no scales.
///
/// As no multipliers are kept, a row operation may run over columns that are already done: over all of
/// them in short rows, which are then straight vector code of known length, and elsewhere over those that
/// fill up the first four.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn eliminate<T: Real>(
    matrix: &mut [T],
    scales: &mut [T],
    x: &mut [T],
) -> Result<(), StepFailure> {
    let n = x.len();
    let rounding = T::default_epsilon() * T::lift(n as f64);
    for k in 0..n {
        let row = pivot_row(matrix, scales, [n, k], rounding)?;
        let begin = if n <= SHORT { 0 } else { (k + 1) & !3 };
        let (upper, lower) = matrix.split_at_mut((k + 1) * n);
        let upper = &mut upper[k * n..];
        if row > k {
            upper.swap_with_slice(&mut lower[(row - k - 1) * n..(row - k) * n]);
            x.swap(k, row);
            if !scales.is_empty() {
                scales.swap(k, row);
            }
        }
        let reciprocal = T::lift(1.0) / upper[k];
        // The diagonal keeps 1/u for the substitution.
        let (head, x_tail) = x.split_at_mut(k + 1);
        let x_k = head[k];
        for (line, x) in lower.chunks_exact_mut(n).zip(x_tail) {
            let factor = line[k] * reciprocal;
            *x -= factor * x_k;
            let (wide, rest) = line[begin..].as_chunks_mut::<4>();
            let (upper_wide, upper_rest) = upper[begin..].as_chunks::<4>();
            for (a, u) in wide.iter_mut().zip(upper_wide) {
                *a = [0, 1, 2, 3].map(|j| a[j] - factor * u[j]);
            }
            for (a, &u) in rest.iter_mut().zip(upper_rest) {
                *a -= factor * u;
            }
        }
        upper[k] = reciprocal;
    }
    for k in (0..n).rev() {
        let value = x[k] * matrix[k * n + k];
        x[k] = value;
        for i in 0..k {
            x[i] -= matrix[i * n + k] * value;
        }
    }
    Ok(())
}

/// Two equations for unknowns with these `weights`: overwrites `x` with the solution of A y = x, or there
/// are not two.
///
/// Cramer's rule needs no choice of rows. It is taken where the determinant loses at most two bits to
/// cancellation and products stay far from the ends of the range of numbers; its errors are then those of
/// elimination (Higham, *Accuracy and Stability of Numerical Algorithms*, 2002, section 1.10.1), which
/// solves the others.
///
/// # Errors
/// As [`factor`]; [`StepFailure::NotFinite`] if A is singular and `x` is no number.
#[inline]
pub(crate) fn eliminate_two<T: Real>(
    matrix: &[T],
    weights: &[T],
    x: &mut [T],
) -> Option<Result<(), StepFailure>> {
    let (&[a, b, c, d], &[of_x, of_y], [x, y]) = (matrix, weights, x) else { return None };
    let across = b * c;
    let determinant = a * d - across;
    let size = Scalar::abs(determinant);
    // What is not a number is neither.
    let is_safe =
        size >= larger(T::lift(1e-200), T::lift(0.5) * Scalar::abs(across)) && size <= T::lift(1e200);
    if is_safe {
        let reciprocal = T::lift(1.0) / determinant;
        [*x, *y] = [(d * *x - b * *y) * reciprocal, (a * *y - c * *x) * reciprocal];
        return Some(Ok(()));
    }
    Some(by_elimination([a, b, c, d], [of_x, of_y], [*x, *y]).map(|solution| [*x, *y] = solution))
}

/// The same by elimination. It gets copies: what another function sees has no place in registers.
#[cold]
#[inline(never)]
fn by_elimination<T: Real>(
    mut matrix: [T; 4],
    weights: [T; 2],
    mut x: [T; 2],
) -> Result<[T; 2], StepFailure> {
    let (finite, mut scales) = (finite(&x), weights);
    set_scales(&mut scales, &weights);
    eliminate(&mut matrix, &mut scales, &mut x).map_err(|singular| finite.err().unwrap_or(singular))?;
    Ok(x)
}

/// Adds `factor` A x to `sum`, for a row-major A that has not been factored.
#[inline]
pub(crate) fn multiply_add<T: Real>(matrix: &[T], factor: T, x: &[T], sum: &mut [T]) {
    for (sum, line) in sum.iter_mut().zip(lines(matrix, x.len())) {
        let product = line.iter().zip(x).fold(T::lift(0.0), |sum, (&a, &x)| sum + a * x);
        *sum += factor * product;
    }
}

#[cfg(test)]
mod tests;
