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
use super::basis::Basis;

/// The equations of one axis, with their triangular factors in place.
#[derive(Debug)]
pub(super) struct Equations {
    /// The unknowns within the band, and those beside it.
    inner: usize,
    border: usize,
    /// How far from the diagonal the band has entries.
    reach: usize,
    /// Row by row: the entries of the band around the diagonal, then those of the border.
    upper: Vec<f64>,
    /// The rows below the band, all entries.
    lower: Vec<f64>,
}

impl Equations {
    pub(super) fn new<const P: usize>(axis: &Axis, basis: &Basis<P>) -> Self {
        let points = axis.points();
        let count = points.len();
        let border = if basis.is_periodic() { (P - 1) / 2 } else { 0 };
        let (inner, reach) = (count - border, if border == 0 { P } else { border });
        let width = 2 * reach + 1 + border;
        let (upper, lower) = (vec![0.0; inner * width], vec![0.0; border * count]);
        let mut equations = Self { inner, border, reach, upper, lower };
        for (row, &x) in points.iter().enumerate() {
            let (first, values) = basis.at_point(x);
            for (i, &value) in values.iter().enumerate().take(P + 1).filter(|(_, value)| **value != 0.0) {
                // With a period, the function around the point is in the diagonal.
                *equations.entry(row, (first + i + count - border) % count) += value;
            }
        }
        equations.factor();
        equations
    }

    fn count(&self) -> usize {
        self.inner + self.border
    }

    fn width(&self) -> usize {
        2 * self.reach + 1 + self.border
    }

    /// An entry of the matrix, which is one of the band or of its border.
    fn entry(&mut self, row: usize, column: usize) -> &mut f64 {
        let (width, count) = (self.width(), self.count());
        if row >= self.inner {
            &mut self.lower[(row - self.inner) * count + column]
        } else if column >= self.inner {
            &mut self.upper[row * width + 2 * self.reach + 1 + column - self.inner]
        } else {
            &mut self.upper[row * width + self.reach + column - row]
        }
    }

    /// The columns of the band that a pivot has on its right, and the rows that it has below.
    fn after(&self, pivot: usize) -> core::ops::Range<usize> {
        pivot + 1..(pivot + self.reach + 1).min(self.inner)
    }

    fn factor(&mut self) {
        let count = self.count();
        for k in 0..count {
            let rows = if k < self.inner { self.after(k) } else { 0..0 };
            for row in rows.chain((k + 1).max(self.inner)..count) {
                let factor = *self.entry(row, k) / *self.entry(k, k);
                *self.entry(row, k) = factor;
                let columns = if k < self.inner { self.after(k) } else { 0..0 };
                for column in columns.chain((k + 1).max(self.inner)..count) {
                    let above = *self.entry(k, column);
                    *self.entry(row, column) -= factor * above;
                }
            }
        }
    }

    /// The unknowns of the values in `line`, in place.
    fn solve(&self, line: &mut [f64]) {
        let (inner, reach, width, count) = (self.inner, self.reach, self.width(), self.count());
        for row in 0..inner {
            let band = &self.upper[row * width..];
            for column in row.saturating_sub(reach)..row {
                line[row] -= band[reach + column - row] * line[column];
            }
        }
        for row in inner..count {
            let factors = &self.lower[(row - inner) * count..];
            for column in 0..row {
                line[row] -= factors[column] * line[column];
            }
        }
        for row in (inner..count).rev() {
            let factors = &self.lower[(row - inner) * count..];
            for column in row + 1..count {
                line[row] -= factors[column] * line[column];
            }
            line[row] /= factors[row];
        }
        for row in (0..inner).rev() {
            let band = &self.upper[row * width..][..width];
            for column in self.after(row) {
                line[row] -= band[reach + column - row] * line[column];
            }
            for column in inner..count {
                line[row] -= band[2 * reach + 1 + column - inner] * line[column];
            }
            line[row] /= band[reach];
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
