//! Several bodies, or several cubes, in lanes; and products with matrices.

use crate::scalar::Lanes;

/// Bodies, or cubes, that are computed at once.
pub(super) const LANES: usize = 8;
pub(super) type Pack = Lanes<LANES>;

/// Some numbers.
#[inline(always)]
pub(super) fn load(from: &[f64], first: usize) -> Pack {
    let mut pack = [0.0; LANES];
    pack.copy_from_slice(&from[first..first + LANES]);
    Lanes(pack)
}

/// Some numbers, zero from `past` on.
#[inline(always)]
pub(super) fn load_before(past: usize, from: &[f64], first: usize) -> Pack {
    let mut pack = load(from, first);
    for lane in 0..LANES {
        if first + lane >= past {
            pack.0[lane] = 0.0;
        }
    }
    pack
}

/// Adds the components of what was found for some bodies, those before `past`.
#[inline(always)]
pub(super) fn add_before<const D: usize>(
    past: usize,
    sums: &mut [&mut [f64]; D],
    first: usize,
    found: &[Pack],
) {
    let count = LANES.min(past - first);
    for (sums, found) in sums.iter_mut().zip(found) {
        for (sum, found) in sums[first..first + count].iter_mut().zip(&found.0) {
            *sum += found;
        }
    }
}

/// Rows or columns of a matrix that are multiplied at once.
const FOUR: usize = 4;

/// Adds the product of a matrix, given column by column, with a vector.
#[inline(always)]
pub(super) fn add_product(to: &mut [f64], columns: &[f64], vector: &[f64]) {
    let size = to.len();
    let (fours, rest) = vector.split_at(vector.len() / FOUR * FOUR);
    let (columns, last) = columns.split_at(fours.len() * size);
    for (columns, factors) in columns.chunks_exact(FOUR * size).zip(fours.chunks_exact(FOUR)) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|column| &columns[column * size..(column + 1) * size]);
        for row in 0..size {
            to[row] +=
                (a[row] * factors[0] + b[row] * factors[1]) + (c[row] * factors[2] + d[row] * factors[3]);
        }
    }
    for (column, factor) in last.chunks_exact(to.len()).zip(rest) {
        for (to, entry) in to.iter_mut().zip(column) {
            *to += entry * factor;
        }
    }
}

/// Columns that are multiplied before others are fetched.
const BLOCK: usize = 64;

/// Where a vector begins that a matrix is multiplied with, and where its product is added.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    pub(super) from: usize,
    pub(super) to: usize,
}

/// Adds the products of a square matrix, given row by row, with several vectors, in lanes.
#[inline(always)]
pub(super) fn add_products(matrix: &[f64], size: usize, ends: &[Ends], from: &[f64], to: &mut [f64]) {
    let [mut vectors, mut products] = [[Pack::all(0.0); BLOCK]; 2];
    for first in (0..size).step_by(BLOCK) {
        let columns = BLOCK.min(size - first);
        for (lane, Ends { from: start, .. }) in ends.iter().enumerate() {
            let entries = &from[start + first..start + first + columns];
            for (vector, entry) in vectors.iter_mut().zip(entries) {
                vector.0[lane] = *entry;
            }
        }
        for top in (0..size).step_by(BLOCK) {
            let products = &mut products[..BLOCK.min(size - top)];
            multiply(&matrix[first..], [top, size], &vectors[..columns], products);
            for (lane, Ends { to: start, .. }) in ends.iter().enumerate() {
                let sums = &mut to[start + top..];
                for (sum, product) in sums.iter_mut().zip(&*products) {
                    *sum += product.0[lane];
                }
            }
        }
    }
}

/// Sets `products` to those of some rows of a matrix, from `top` on, each of `size` entries, with some vectors.
#[inline(always)]
fn multiply(matrix: &[f64], [top, size]: [usize; 2], vectors: &[Pack], products: &mut [Pack]) {
    for (four, out) in products.chunks_mut(FOUR).enumerate() {
        let row = |row: usize| {
            // The last row again where there are fewer.
            let start = (top + four * FOUR + row.min(out.len() - 1)) * size;
            &matrix[start..start + vectors.len()]
        };
        let rows: [&[f64]; FOUR] = [row(0), row(1), row(2), row(3)];
        let mut sums = [Pack::all(0.0); FOUR];
        for (column, vector) in vectors.iter().enumerate() {
            for row in 0..FOUR {
                sums[row] += Pack::all(rows[row][column]) * *vector;
            }
        }
        out.copy_from_slice(&sums[..out.len()]);
    }
}
