//! How many eigenvalues of a symmetric matrix are negative, from A = P L D Lᵀ Pᵀ with pivots of one or two
//! rows.
//!
//! L does not change the numbers of positive and negative eigenvalues (Sylvester's law of inertia), so that
//! those of the blocks of D count. Source: Bunch & Kaufman 1977, Math. Comp. 31, 163–179.

use crate::error::StepFailure;
use crate::memory::lasting;
use crate::scalar::norm::{is_pivot, larger, singular};
use crate::{Real, Scalar};

/// The signs of the eigenvalues of a symmetric matrix that is not singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inertia<T> {
    /// The number of negative eigenvalues.
    pub(crate) negative: usize,
    /// The positive and the negative pivot that are nearest to zero, zero if there is none.
    pub(crate) least: [T; 2],
}

impl<T: Real> Inertia<T> {
    fn none() -> Self {
        Self { negative: 0, least: [T::lift(0.0); 2] }
    }

    /// Of a diagonal matrix.
    pub(crate) fn of_diagonal(entries: &[T]) -> Result<Self, StepFailure> {
        let mut found = Self::none();
        for (column, &entry) in entries.iter().enumerate() {
            let usable = entry != T::lift(0.0) && entry.is_finite();
            if !usable {
                return Err(singular(entry, column).of(StepFailure::MASS));
            }
            found.count(entry);
        }
        Ok(found)
    }

    fn count(&mut self, pivot: T) {
        let zero = T::lift(0.0);
        let sign = usize::from(pivot < zero);
        self.negative += sign;
        let least = &mut self.least[sign];
        if *least == zero || Scalar::abs(pivot) < Scalar::abs(*least) {
            *least = pivot;
        }
    }
}

lasting!([T: Real] Inertia<T>, T; count negative, numbers least);

/// Of the row-major n×n `matrix`, which is overwritten; `removed` has n entries of storage. A pivot counts
/// as zero when it is no larger than n ε times the largest number that was subtracted to form it.
///
/// # Errors
/// [`StepFailure::Singular`] with the row of the pivot and its size.
pub(crate) fn inertia<T: Real>(matrix: &mut [T], removed: &mut [T]) -> Result<Inertia<T>, StepFailure> {
    let (n, zero) = (removed.len(), T::lift(0.0));
    removed.fill(zero);
    let rounding = T::default_epsilon() * T::lift(n as f64);
    let mut found = Inertia::none();
    let mut k = 0;
    while k < n {
        let rows = choose_pivot(matrix, removed, k);
        let block = eigenvalues(matrix, n, k, rows);
        let subtracted = (k..k + rows).fold(zero, |largest, i| larger(largest, removed[i]));
        for &pivot in &block[..rows] {
            if !is_pivot(Scalar::abs(pivot), rounding * subtracted) {
                return Err(singular(pivot, k).of(StepFailure::MASS));
            }
            found.count(pivot);
        }
        eliminate(matrix, removed, k, rows);
        k += rows;
    }
    Ok(found)
}

/// Brings the next pivot to row k and returns its number of rows, one or two.
fn choose_pivot<T: Real>(a: &mut [T], removed: &mut [T], k: usize) -> usize {
    let n = removed.len();
    let growth = T::lift((1.0 + Scalar::sqrt(17.0)) / 8.0);
    let size = |a: &[T], i: usize, j: usize| Scalar::abs(a[i * n + j]);
    let largest_beside = |a: &[T], row: usize| {
        (k..n).filter(|&i| i != row).fold((k, T::lift(0.0)), |best, i| {
            if size(a, i, row) > best.1 { (i, size(a, i, row)) } else { best }
        })
    };
    let (row, beside) = largest_beside(a, k);
    if size(a, k, k) >= growth * beside {
        return 1;
    }
    let (_, beside_row) = largest_beside(a, row);
    if size(a, k, k) * beside_row >= growth * beside * beside {
        return 1;
    }
    let rows = if size(a, row, row) >= growth * beside_row { 1 } else { 2 };
    let place = k + rows - 1;
    for j in 0..n {
        a.swap(row * n + j, place * n + j);
    }
    for i in 0..n {
        a.swap(i * n + row, i * n + place);
    }
    removed.swap(row, place);
    rows
}

/// The eigenvalues of the pivot, of which the second counts if it has two rows.
fn eigenvalues<T: Real>(a: &[T], n: usize, k: usize, rows: usize) -> [T; 2] {
    let first = a[k * n + k];
    if rows == 1 {
        return [first, T::lift(0.0)];
    }
    let (off, last, half) = (a[k * n + k + 1], a[(k + 1) * n + k + 1], T::lift(0.5));
    let mean = half * (first + last);
    let radius = Scalar::hypot(half * (first - last), off);
    [mean - radius, mean + radius]
}

/// Subtracts what the pivot of row k contributes to the rows below.
fn eliminate<T: Real>(a: &mut [T], removed: &mut [T], k: usize, rows: usize) {
    let n = removed.len();
    for i in k + rows..n {
        // The row of L: row i times the inverse of the pivot.
        let (x, y) = (a[i * n + k], if rows == 1 { T::lift(0.0) } else { a[i * n + k + 1] });
        let [l, m] = if rows == 1 {
            [x / a[k * n + k], y]
        } else {
            // Divided by the entry beside the diagonal, which is the largest of the pivot.
            let off = a[k * n + k + 1];
            let (first, last) = (a[k * n + k] / off, a[(k + 1) * n + k + 1] / off);
            let determinant = first * last - T::lift(1.0);
            [(last * x - y) / determinant / off, (first * y - x) / determinant / off]
        };
        for j in k + rows..n {
            let below = if rows == 1 { T::lift(0.0) } else { a[(k + 1) * n + j] };
            let update = l * a[k * n + j] + m * below;
            a[i * n + j] -= update;
            if i == j {
                removed[i] = larger(removed[i], Scalar::abs(update));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::inertia;
    use crate::error::StepFailure;
    use nalgebra::DMatrix;

    /// Symmetric matrices of small integers, with zeros on the diagonal in every third.
    fn symmetric(n: usize, seed: usize) -> DMatrix<f64> {
        DMatrix::from_fn(n, n, |i, j| {
            let (low, high) = (i.min(j), i.max(j));
            let entry = (seed * 31 + low * 17 + high * 5 + seed * low * high) % 13;
            if i == j && seed.is_multiple_of(3) { 0.0 } else { entry as f64 - 6.0 }
        })
    }

    #[test]
    fn the_signs_are_those_of_the_eigenvalues() {
        let mut seen = [0; 6];
        for n in 1..=5 {
            for seed in 0..60 {
                let matrix = symmetric(n, seed);
                let eigenvalues = matrix.symmetric_eigenvalues();
                let mut entries = matrix.as_slice().to_vec();
                let found = inertia(&mut entries, &mut alloc::vec![0.0; n]);
                if eigenvalues.amin() < 1e-12 {
                    assert!(matches!(found, Err(StepFailure::Singular { .. })), "n = {n}, seed {seed}");
                    continue;
                }
                let negative = eigenvalues.iter().filter(|&&value| value < 0.0).count();
                assert_eq!(found.map(|found| found.negative), Ok(negative), "n = {n}, seed {seed}");
                seen[negative] += 1;
            }
        }
        assert!(seen[..4].iter().all(|&count| count > 3), "{seen:?}");
    }

    #[test]
    fn a_matrix_of_unequal_scales_is_not_singular() {
        let found = inertia(&mut [1e20, 0.0, 0.0, -1e-20], &mut [0.0; 2]);
        assert_eq!(found.map(|found| (found.negative, found.least)), Ok((1, [1e20, -1e-20])));
    }
}
