//! Left singular vectors, by rotations of pairs of columns (one-sided Jacobi).
//!
//! The matrices of kernels such as r² have an exact rank far below their size. For such matrices the
//! iteration of a bidiagonal matrix in `nalgebra` was found to lose a direction.

use alloc::vec::Vec;

use nalgebra::DMatrix;

/// Sweeps over all pairs. About ten are needed, and fewer for a low rank.
const SWEEPS: usize = 60;

/// The singular vectors of values above a bound, and these values; none if rotations do not end, as those of
/// what is no number.
pub(super) fn singular(columns: &DMatrix<f64>, least: f64) -> Option<(DMatrix<f64>, Vec<f64>)> {
    singular_within(SWEEPS, columns, least)
}

/// The same, if so many sweeps make columns orthogonal.
fn singular_within(sweeps: usize, columns: &DMatrix<f64>, least: f64) -> Option<(DMatrix<f64>, Vec<f64>)> {
    let mut rotated = as_few(columns);
    rotate(&mut rotated, sweeps, least)?;
    let norms: Vec<f64> = rotated.column_iter().map(|column| column.norm()).collect();
    let mut kept: Vec<usize> = (0..norms.len()).filter(|place| norms[*place] > least).collect();
    kept.sort_by(|one, other| norms[*other].total_cmp(&norms[*one]));
    let values: Vec<f64> = kept.iter().map(|place| norms[*place]).collect();
    let mut vectors = rotated.select_columns(&kept);
    vectors.column_iter_mut().zip(&values).for_each(|(mut vector, value)| vector /= *value);
    Some((vectors, values))
}

/// No more columns than rows, with the same left singular vectors and values: A = P Rᵀ Qᵀ, of which P Rᵀ is
/// returned. Its columns get shorter, for which few rotations do.
fn as_few(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let decomposed = columns.transpose().col_piv_qr();
    let mut few = decomposed.r().transpose();
    decomposed.p().inv_permute_rows(&mut few);
    few
}

/// Makes columns orthogonal to each other, but for pairs that are too short to matter; none if some are not
/// after so many sweeps.
fn rotate(columns: &mut DMatrix<f64>, sweeps: usize, least: f64) -> Option<()> {
    let (size, count) = columns.shape();
    let short = least / count as f64;
    (0..sweeps).find_map(|_| {
        let mut is_done = true;
        for second in 1..count {
            let (before, after) = columns.as_mut_slice().split_at_mut(second * size);
            for first in before.chunks_exact_mut(size) {
                is_done &= !rotate_pair(first, &mut after[..size], short);
            }
        }
        is_done.then_some(())
    })
}

/// Rotates two columns in their plane until they are orthogonal, and returns whether they were not.
fn rotate_pair(one: &mut [f64], other: &mut [f64], short: f64) -> bool {
    let squares = [dot(one, one), dot(other, other)];
    let product = dot(one, other);
    let norms = squares.map(f64::sqrt);
    let is_orthogonal = product.abs() <= 8.0 * f64::EPSILON * norms[0] * norms[1];
    if is_orthogonal || norms.iter().all(|norm| *norm <= short) {
        return false;
    }
    let cotangent = (squares[1] - squares[0]) / (2.0 * product);
    let tangent = cotangent.signum() / (cotangent.abs() + cotangent.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = cosine * tangent;
    for (one, other) in one.iter_mut().zip(other) {
        (*one, *other) = (cosine * *one - sine * *other, sine * *one + cosine * *other);
    }
    true
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::{singular, singular_within};

    /// Matrices of rank 3 with singular values far apart.
    #[test]
    fn directions_of_a_low_rank_are_found() {
        let mut state = 5_u64;
        let mut entry = |_, _| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
        };
        for (rows, columns) in [(10, 5), (5, 10), (40, 90), (3, 3), (1, 4)] {
            let mut factor = DMatrix::from_fn(rows, 3, &mut entry);
            factor.column_mut(1).scale_mut(1e-4);
            factor.column_mut(2).scale_mut(1e-8);
            let matrix = factor * DMatrix::from_fn(3, columns, &mut entry);
            for least in [1e-2, 1e-6, 1e-11] {
                let Some((vectors, values)) = singular(&matrix, least) else {
                    panic!("rotations do not end")
                };
                assert!(values.iter().all(|value| *value > least) && values.is_sorted_by(|a, b| a >= b));
                assert!(values.len() <= rows.min(3), "{rows}×{columns}: {values:?}");
                let gram = vectors.transpose() * &vectors;
                let apart = (gram - DMatrix::identity(values.len(), values.len())).amax();
                assert!(apart < 1e-13, "{rows}×{columns}: {apart:e}");
                let lost = (&matrix - &vectors * (vectors.transpose() * &matrix)).norm();
                assert!(lost < 3.0 * least, "{rows}×{columns}: {lost:e}");
            }
        }
    }

    /// What rotations leave unfinished is not taken for singular vectors.
    #[test]
    fn rotations_that_do_not_end_give_nothing() {
        let matrix = DMatrix::from_fn(4, 6, |i, j| ((i * i + 3 * j) as f64).sin());
        assert!(singular_within(1, &matrix, 1e-9).is_none());
        assert!(singular(&DMatrix::from_element(4, 6, f64::NAN), 1e-9).is_none());
    }
}
