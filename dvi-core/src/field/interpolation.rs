//! From the values at the points of an axis to the coefficients of the B-splines that take them.
//!
//! Σⱼ cⱼ Bⱼ(xᵢ) = fᵢ is a banded system. It is solved by elimination without exchanges, which is stable here
//! because the matrix is totally positive (de Boor, *A Practical Guide to Splines*, 2001, chapter XIII).
//! With a period, B-splines at one end are in the equations of the other. The last (p − 1)/2 unknowns and
//! equations stand beside the band then, which has no more such entries, and are eliminated last, without
//! exchanges too:
//!
//! ```text
//! ⎛ B  E ⎞ ⎛ x ⎞   ⎛ f ⎞
//! ⎝ F  G ⎠ ⎝ y ⎠ = ⎝ g ⎠        (G − F B⁻¹ E) y = g − F B⁻¹ f
//! ```

use alloc::vec;
use alloc::vec::Vec;

use super::Axis;
use super::basis::{Basis, Local};

/// The equations of one axis, with their triangular factors in place.
#[derive(Debug)]
pub(super) struct Equations {
    /// The unknowns within the band, and those beside it.
    inner: usize,
    border: usize,
    /// How far from the diagonal the band has entries.
    reach: usize,
    /// Row by row: the entries of the band around the diagonal, then those of the border; below the band all
    /// entries of a row.
    entries: Vec<f64>,
}

impl Equations {
    pub(super) fn new<const P: usize>(axis: &Axis, basis: &Basis<P>) -> Self {
        let points = axis.points();
        let count = points.len();
        let border = if axis.period().is_some() { (P - 1) / 2 } else { 0 };
        let (inner, reach) = (count - border, if border == 0 { P } else { border });
        let mut equations = Self { inner, border, reach, entries: Vec::new() };
        equations.entries = vec![0.0; equations.place(count, 0)];
        for (row, &x) in points.iter().enumerate() {
            // From the first that is not zero on.
            let Local { cell, functions, .. } = basis.at(x);
            let values = functions.iter().map(|&[value, ..]| value).enumerate().take(P + 1);
            for (i, value) in values.filter(|&(_, value)| value != 0.0) {
                // With a period, the function around the point is in the diagonal.
                let place = equations.place(row, (cell as usize + i + count - border) % count);
                equations.entries[place] += value;
            }
        }
        equations.factor();
        equations
    }

    fn count(&self) -> usize {
        self.inner + self.border
    }

    /// Where an entry of the matrix stands, which is one of the band or of its border.
    fn place(&self, row: usize, column: usize) -> usize {
        let width = 2 * self.reach + 1 + self.border;
        if row >= self.inner {
            self.inner * width + (row - self.inner) * self.count() + column
        } else if column >= self.inner {
            row * width + 2 * self.reach + 1 + column - self.inner
        } else {
            row * width + self.reach + column - row
        }
    }

    /// The columns with entries on the right of a pivot, and the rows with entries below it.
    fn after(&self, pivot: usize) -> impl Iterator<Item = usize> + use<> {
        let in_band = pivot + 1..(pivot + self.reach + 1).min(self.inner);
        in_band.chain((pivot + 1).max(self.inner)..self.count())
    }

    fn factor(&mut self) {
        for k in 0..self.count() {
            for row in self.after(k) {
                let below = self.place(row, k);
                let factor = self.entries[below] / self.entries[self.place(k, k)];
                self.entries[below] = factor;
                for column in self.after(k) {
                    let (above, place) = (self.entries[self.place(k, column)], self.place(row, column));
                    self.entries[place] -= factor * above;
                }
            }
        }
    }

    /// The unknowns of the values in `line`, in place.
    fn solve(&self, line: &mut [f64]) {
        let entry = |row: usize, column: usize| self.entries[self.place(row, column)];
        for row in 0..self.count() {
            let first = if row < self.inner { row.saturating_sub(self.reach) } else { 0 };
            for column in first..row {
                line[row] -= entry(row, column) * line[column];
            }
        }
        for row in (0..self.count()).rev() {
            for column in self.after(row) {
                line[row] -= entry(row, column) * line[column];
            }
            line[row] /= entry(row, row);
        }
    }

    /// By how much rounding errors of the values can be larger in the coefficients, and in the spline,
    /// which is no larger than these: the largest sum over a row of |inverse|. The signs in the inverse of
    /// a totally positive matrix alternate, as those of the values do of which this is the solution; with a
    /// period of an odd number of points, but for those around its end.
    pub(super) fn growth(&self) -> f64 {
        let mut line: Vec<f64> = [1.0, -1.0].into_iter().cycle().take(self.count()).collect();
        self.solve(&mut line);
        let larger = |growth: f64, c: &f64| if c.is_nan() { f64::INFINITY } else { growth.max(c.abs()) };
        line.iter().fold(0.0, larger)
    }

    /// From values to coefficients in all lines of an array along one axis. Neighbours on the axis are
    /// `stride` apart.
    ///
    /// With a period of `count` values, the coefficients are repeated until there are `coefficients` of
    /// them.
    pub(super) fn solve_lines(&self, values: &[f64], stride: usize, coefficients: usize) -> Vec<f64> {
        let count = self.count();
        let mut result = vec![0.0; values.len() / count * coefficients];
        let mut line = vec![0.0; count];
        let blocks = values.chunks_exact(count * stride).zip(result.chunks_exact_mut(coefficients * stride));
        for (values, result) in blocks {
            for offset in 0..stride {
                for (entry, value) in line.iter_mut().zip(values[offset..].iter().step_by(stride)) {
                    *entry = *value;
                }
                self.solve(&mut line);
                let cyclic = line.iter().cycle().skip(count - self.border);
                for (entry, value) in result[offset..].iter_mut().step_by(stride).zip(cyclic) {
                    *entry = *value;
                }
            }
        }
        result
    }
}
