//! Elimination of a matrix of blocks, one block row for each unknown vector of a step.
//!
//! The pivots are a part of the rows; what is left of the other rows and columns is their Schur complement.
//! Each block is stored transposed, so that the columns that a solve works on lie together. Pivots are
//! sought within the diagonal blocks, and blocks are never exchanged: up to terms of order h² the matrix is
//! (K ⊗ M)/h, and the part of K that belongs to the displacements is the Gram matrix Σ w a a of derivatives
//! of polynomials that vanish at both ends, positive definite; so the pivot blocks are positive multiples of
//! M. The last one is ∂²L_d/∂q0∂q1, without which there is no step.

use crate::Real;
use crate::error::StepFailure;
use crate::space::linear::set_scales;
use crate::space::{elimination, lines, lines_mut};
use core::ops::{DerefMut, Range};

/// Of unknowns with these `weights`, and with room for their scales, overwrites the entries `pivots` of `x`
/// with the solution of A y = x in these rows and columns, and A with nothing of use but the Schur
/// complement of the later rows and columns.
///
/// # Errors
/// [`StepFailure::Singular`] with the column of the block that has no pivot.
pub(crate) fn eliminate<const NODES: usize, T: Real, M, V>(
    rows: &mut [[M; NODES]; NODES],
    permutation: &mut [usize],
    (weights, scales): (&[T], &mut [T]),
    x: &mut [V; NODES],
    pivots: Range<usize>,
) -> Result<(), StepFailure>
where
    M: DerefMut<Target = [T]>,
    V: DerefMut<Target = [T]>,
{
    let n = permutation.len();
    for k in pivots.clone() {
        let (done, rest) = rows.split_at_mut(k + 1);
        let (left, right) = done[k].split_at_mut(k + 1);
        let pivot = &mut left[k];
        transpose(pivot, n);
        set_scales(scales, weights);
        elimination::factor_in_any_units(pivot, permutation, scales)?;
        for block in right.iter_mut() {
            for column in lines_mut(block, n) {
                elimination::solve(pivot, &permutation, column);
            }
        }
        let (x_done, x_rest) = x.split_at_mut(k + 1);
        elimination::solve(pivot, &permutation, &mut x_done[k]);
        for (row, x) in rest.iter_mut().zip(x_rest) {
            let (factors, targets) = row.split_at_mut(k + 1);
            subtract_product(&factors[k], &x_done[k], x);
            for (target, block) in targets.iter_mut().zip(right.iter()) {
                for (target, column) in lines_mut(target, n).zip(lines(block, n)) {
                    subtract_product(&factors[k], column, target);
                }
            }
        }
    }
    let end = pivots.end;
    for k in pivots.rev() {
        let (unknown, known) = x.split_at_mut(k + 1);
        for (block, known) in rows[k][k + 1..end].iter().zip(known.iter()) {
            subtract_product(block, known, &mut unknown[k]);
        }
    }
    Ok(())
}

/// Subtracts A x from `out`, for an A that is stored transposed.
#[inline]
fn subtract_product<T: Real>(transposed: &[T], x: &[T], out: &mut [T]) {
    for (column, &x) in lines(transposed, x.len()).zip(x) {
        for (out, &a) in out.iter_mut().zip(column) {
            *out -= a * x;
        }
    }
}

fn transpose<T>(matrix: &mut [T], n: usize) {
    for i in 1..n {
        for j in 0..i {
            matrix.swap(i * n + j, j * n + i);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::eliminate;
    use crate::space::numbers;
    use alloc::vec::Vec;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn solutions_agree_with_nalgebra() {
        for n in 1..=4 {
            let mut entry = numbers(n as u64);
            let dense = DMatrix::from_fn(3 * n, 3 * n, |i, j| entry() + if i == j { 3.0 } else { 0.0 });
            let rhs = DVector::from_fn(3 * n, |_, _| entry());
            let block = |r: usize, k: usize| -> Vec<f64> {
                let entries = (0..n * n).map(|m| (m % n, m / n));
                entries
                    .map(|(i, j)| if r * k == 0 { 0.0 } else { dense[((r - 1) * n + i, (k - 1) * n + j)] })
                    .collect()
            };
            let mut rows: [[Vec<f64>; 4]; 4] =
                core::array::from_fn(|r| core::array::from_fn(|k| block(r, k)));
            let mut x: [Vec<f64>; 4] = core::array::from_fn(|r| {
                (0..n).map(|i| if r == 0 { 0.0 } else { rhs[(r - 1) * n + i] }).collect()
            });
            assert_eq!(eliminate(&mut rows, &mut alloc::vec![0; n], (&[], &mut []), &mut x, 1..4), Ok(()));
            let Some(expected) = dense.clone().lu().solve(&rhs) else {
                panic!("nalgebra found no solution")
            };
            let found = DVector::from_vec(x[1..].concat());
            assert!((found - &expected).amax() < 1e-13 * expected.amax(), "n = {n}");
        }
    }
}
