//! Gaussian elimination with partial pivoting within a band, in place.
//!
//! With entries at most b from the diagonal, U has them at most 2b to its right, and a row of storage is the
//! 3b + 1 entries from b left of the diagonal to 2b right of it. The multipliers of a column are those of
//! its stage, and the rows that were exchanged later are not exchanged in them. A pivot counts as zero when
//! it is no larger than the rounding errors of what was subtracted to form it, in any units of rows and
//! columns. Source: Golub & Van Loan, *Matrix Computations* (2013), section 4.3.3.

use alloc::vec;
use alloc::vec::Vec;

use super::SquareMatrix;
use super::exchanges::Exchanges;
use super::ordering::Order;
use crate::error::StepFailure;
use crate::scalar::norm::{is_pivot, singular};
use crate::scalar::passes::multiply;
use crate::space::elimination::LEAST;
use crate::space::{Sink, lines_mut};
use crate::{Real, Scalar};

/// A banded matrix, in an order of its own.
#[derive(Clone, Debug)]
pub struct Banded<T> {
    order: Order,
    /// The coordinate of each place.
    coordinate: Vec<u32>,
    /// Brings a vector into this order.
    exchanges: Exchanges,
    /// Row by row.
    entries: Vec<T>,
    /// The row that was exchanged with row k at stage k.
    pivots: Vec<u32>,
    /// Row and column of an entry that was added outside of the band.
    outside: Option<(usize, usize)>,
}

impl<T: Scalar> Banded<T> {
    pub(super) fn new(order: Order) -> Self {
        let n = order.place.len();
        let mut coordinate = vec![0; n];
        for (i, &at) in order.place.iter().enumerate() {
            coordinate[at as usize] = i as u32;
        }
        let mut exchanges = Exchanges::new(n);
        exchanges.set(&coordinate);
        let entries = vec![T::lift(0.0); n * order.width()];
        Self { order, coordinate, exchanges, entries, pivots: vec![0; n], outside: None }
    }

    /// The places of the entries of a row of A.
    fn columns(&self, row: usize) -> core::ops::Range<usize> {
        row.saturating_sub(self.order.bandwidth)
            ..(row + self.order.bandwidth + 1).min(self.order.place.len())
    }
}

impl<T: Real> Sink<T> for Banded<T> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        let (i, j) = (self.order.place[row] as usize, self.order.place[column] as usize);
        if i.abs_diff(j) > self.order.bandwidth {
            self.outside = Some((row, column));
            return;
        }
        let at = i * self.order.width() + self.order.bandwidth + j - i;
        self.entries[at] += entry;
    }
}

impl<T: Real> SquareMatrix<T> for Banded<T> {
    type Entries = Self;

    fn cleared(&mut self) -> &mut Self {
        self.entries.fill(T::lift(0.0));
        self.outside = None;
        self
    }

    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        for (row, &i) in self.coordinate.iter().enumerate() {
            let line = &self.entries[row * self.order.width()..];
            let terms = self.columns(row).map(|column| {
                line[self.order.bandwidth + column - row] * x[self.coordinate[column] as usize]
            });
            sum[i as usize] += factor * terms.fold(T::lift(0.0), |sum, term| sum + term);
        }
    }

    fn scale_rows(&mut self, scales: &[T]) {
        let (width, bandwidth) = (self.order.width(), self.order.bandwidth);
        for (line, &i) in lines_mut(&mut self.entries, width).zip(&self.coordinate) {
            multiply(&mut line[..=2 * bandwidth], scales[i as usize]);
        }
    }

    fn factor(&mut self) -> Result<(), StepFailure> {
        if let Some((row, column)) = self.outside {
            return Err(StepFailure::Pattern { row, column });
        }
        let (n, b, width) = (self.order.place.len(), self.order.bandwidth, self.order.width());
        let rounding = T::default_epsilon() * T::lift(n as f64);
        let entries = &mut self.entries;
        let at = |row: usize, column: usize| row * width + b + column - row;
        for k in 0..n {
            let below = k + 1..(k + b + 1).min(n);
            let (mut row, mut pivot) = (k, Scalar::abs(entries[at(k, k)]));
            for i in below.clone() {
                let size = Scalar::abs(entries[at(i, k)]);
                if size > pivot {
                    (row, pivot) = (i, size);
                }
            }
            // Multipliers are no larger than one but for rounding, so that most pivots need no closer look.
            let reach = k.min(2 * b);
            let above = entries[at(k - reach, k)..].iter().step_by((width - 1).max(1)).take(reach);
            let most = above.fold(T::lift(LEAST), |sum, &entry| sum + Scalar::abs(entry));
            if !is_pivot(pivot, T::lift(2.0) * rounding * most) {
                // The multipliers of the row stand where it was before later exchanges.
                let (mut subtracted, mut place) = (T::lift(LEAST), row);
                for j in (k - reach..k).rev() {
                    if place <= j + b {
                        subtracted += Scalar::abs(entries[at(place, j)] * entries[at(j, k)]);
                    }
                    if place == self.pivots[j] as usize {
                        place = j;
                    }
                }
                if !is_pivot(pivot, rounding * subtracted) {
                    return Err(singular(pivot, self.coordinate[k] as usize));
                }
            }
            self.pivots[k] = row as u32;
            let columns = (k + 2 * b + 1).min(n) - k;
            let (upper, lower) = entries.split_at_mut((k + 1) * width);
            let upper = &mut upper[k * width + b..k * width + b + columns];
            if row > k {
                // Column k stands `row − k` further left there.
                let begin = (row - k - 1) * width + b + k - row;
                upper.swap_with_slice(&mut lower[begin..begin + columns]);
            }
            let reciprocal = T::lift(1.0) / upper[0];
            for i in below {
                let begin = (i - k - 1) * width + b + k - i;
                let line = &mut lower[begin..begin + columns];
                let factor = line[0] * reciprocal;
                line[0] = factor;
                for (a, &u) in line[1..].iter_mut().zip(&upper[1..]) {
                    *a -= factor * u;
                }
            }
        }
        Ok(())
    }

    /// The order of the coordinates is that of rows and of columns and does not count.
    fn is_positive(&self) -> bool {
        let is_negative =
            |k: usize| self.entries[k * self.order.width() + self.order.bandwidth] < T::lift(0.0);
        let pivots = self.pivots.iter().enumerate();
        pivots.fold(true, |positive, (k, &row)| positive ^ is_negative(k) ^ (row as usize != k))
    }

    fn solve(&self, x: &mut [T]) {
        let (n, b, width) = (self.order.place.len(), self.order.bandwidth, self.order.width());
        self.exchanges.apply(x);
        for k in 0..n {
            x.swap(k, self.pivots[k] as usize);
            let value = x[k];
            for i in k + 1..(k + b + 1).min(n) {
                x[i] -= self.entries[i * width + b + k - i] * value;
            }
        }
        for k in (0..n).rev() {
            let columns = (k + 2 * b + 1).min(n) - k;
            let line = &self.entries[k * width + b..k * width + b + columns];
            let sum = line[1..].iter().zip(&x[k + 1..]).fold(x[k], |sum, (&u, &x)| sum - u * x);
            x[k] = sum / line[0];
        }
        self.exchanges.revert(x);
    }
}
