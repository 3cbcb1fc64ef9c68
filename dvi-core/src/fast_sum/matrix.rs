//! Products of matrices with the coefficients of many cubes.

use alloc::vec::Vec;
use core::ops::Range;

use nalgebra::DMatrix;

use super::packs::{LANES, Pack, load};

/// A matrix, column by column, of which each has zeros behind it up to a whole number of packs.
#[derive(Clone, Debug, Default)]
pub(super) struct Matrix {
    /// With the zeros.
    rows: usize,
    entries: Vec<f64>,
}

/// Where a vector begins that a matrix is multiplied with, and where its product is added.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    pub(super) from: usize,
    pub(super) to: usize,
}

/// The least whole number of packs.
pub(super) fn padded(entries: usize) -> usize {
    entries.next_multiple_of(LANES)
}

/// Products that are collected before they are computed.
const BATCH: usize = 64;
/// Vectors that are multiplied at once.
pub(super) const VECTORS: usize = 4;
/// Packs of rows that are computed at once with several vectors, and with one: as many as there are
/// registers for.
const ROWS: usize = 5;
const ROWS_OF_ONE: usize = 8;

impl Matrix {
    pub(super) fn new(matrix: &DMatrix<f64>) -> Self {
        let rows = padded(matrix.nrows());
        let mut entries = Vec::with_capacity(rows * matrix.ncols());
        for column in matrix.column_iter() {
            entries.extend(column.iter());
            entries.resize(entries.len().next_multiple_of(LANES), 0.0);
        }
        Self { rows, entries }
    }

    /// Adds the products with all of these vectors, of which some are collected at a time.
    pub(super) fn add_all(&self, mut ends: impl Iterator<Item = Ends>, from: &[f64], to: &mut [f64]) {
        let mut batch = [Ends::default(); BATCH];
        loop {
            let mut count = 0;
            for (place, ends) in batch.iter_mut().zip(&mut ends) {
                *place = ends;
                count += 1;
            }
            self.add_products(&batch[..count], from, to);
            if count < BATCH {
                return;
            }
        }
    }

    /// Adds the products with several vectors. Each product is the same in whatever company it is computed.
    #[inline(never)]
    pub(super) fn add_products(&self, ends: &[Ends], from: &[f64], to: &mut [f64]) {
        if self.entries.is_empty() {
            return;
        }
        widest!({
            let mut fours = ends.chunks_exact(VECTORS);
            for four in &mut fours {
                self.add_several([four[0], four[1], four[2], four[3]], ROWS, from, to);
            }
            for one in fours.remainder() {
                self.add_several([*one], ROWS_OF_ONE, from, to);
            }
        });
    }

    /// Adds the products with `V` vectors, so many packs of rows at once at most.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_several<const V: usize>(&self, ends: [Ends; V], most: usize, from: &[f64], to: &mut [f64]) {
        for Range { start, end } in parts(self.rows / LANES, most) {
            match end - start {
                1 => self.add_rows::<V, 1>(start, ends, from, to),
                2 => self.add_rows::<V, 2>(start, ends, from, to),
                3 => self.add_rows::<V, 3>(start, ends, from, to),
                4 => self.add_rows::<V, 4>(start, ends, from, to),
                5 => self.add_rows::<V, 5>(start, ends, from, to),
                6 => self.add_rows::<V, 6>(start, ends, from, to),
                7 => self.add_rows::<V, 7>(start, ends, from, to),
                _ => self.add_rows::<V, ROWS_OF_ONE>(start, ends, from, to),
            }
        }
    }

    /// Adds `P` packs of the products, from `first` on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_rows<const V: usize, const P: usize>(
        &self,
        first: usize,
        ends: [Ends; V],
        from: &[f64],
        to: &mut [f64],
    ) {
        let columns = self.entries.len() / self.rows;
        let vectors: [&[f64]; V] = ends.map(|ends| &from[ends.from..ends.from + columns]);
        let mut sums = [[Pack::all(0.0); P]; V];
        for (number, column) in self.entries.chunks_exact(self.rows).enumerate() {
            let column = &column[first * LANES..(first + P) * LANES];
            let mut packs = [Pack::all(0.0); P];
            for pack in 0..P {
                packs[pack] = load(column, pack * LANES);
            }
            // Loops over numbers: else the compiler keeps the sums in memory.
            for vector in 0..V {
                let factor = Pack::all(vectors[vector][number]);
                for pack in 0..P {
                    sums[vector][pack] += packs[pack] * factor;
                }
            }
        }
        for vector in 0..V {
            let start = ends[vector].to + first * LANES;
            let to = &mut to[start..start + P * LANES];
            for pack in 0..P {
                let sum = load(to, pack * LANES) + sums[vector][pack];
                to[pack * LANES..(pack + 1) * LANES].copy_from_slice(&sum.0);
            }
        }
    }
}

/// Cuts packs into as few parts as are not longer than `most`, all of about one length.
#[inline]
fn parts(packs: usize, most: usize) -> impl Iterator<Item = Range<usize>> {
    let count = packs.div_ceil(most);
    (0..count).map(move |part| packs * part / count..packs * (part + 1) / count)
}
