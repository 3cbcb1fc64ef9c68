//! Gaussian elimination of a sparse matrix with partial pivoting, front by front.
//!
//! The rows of a front stand in a dense rectangle: those of A that begin here, and those that earlier fronts
//! have handed on. As every row with an entry in the columns that it eliminates is among them, the largest
//! entry of a column is the pivot, as in a dense elimination. Rows that wait for their front stand on a
//! stack. Which columns make a front is found once, when the matrix is made ([`fronts`](super::fronts)). A
//! pivot counts as zero when it is no larger than the rounding errors of the entries above it, |pivot| ≤ n ε
//! maxᵢ |uᵢₖ|, i < k, and of what was subtracted in its front to form it. Sources: Duff & Reid 1983
//! (fronts), George & Ng 1985 (room for all pivots).

use alloc::vec;
use alloc::vec::Vec;

use super::SquareMatrix;
use super::exchanges::Exchanges;
use super::fronts::{Front, Fronts};
use crate::error::StepFailure;
use crate::scalar::norm::{is_pivot, larger, singular};
use crate::space::Sink;
use crate::space::elimination::LEAST;
use crate::space::rows::{RowMatrix, SparseRows};
use crate::{Real, Scalar};

/// A sparse matrix.
#[derive(Clone, Debug)]
pub(super) struct Sparse<T> {
    entries: SparseRows<T>,
    order: Fronts,
    factors: Factors<T>,
    work: Work<T>,
}

/// What is left of A when it is factored.
#[derive(Clone, Debug)]
struct Factors<T> {
    /// Front by front: the rows of its pivots, row by row, and then the multipliers of the rows that it
    /// hands on, row by row.
    numbers: Vec<T>,
    /// Front by front: which rows of A it has, first the pivots.
    rows: Vec<u32>,
    /// The row of A that is the pivot of each column.
    pivot: Vec<u32>,
    /// Brings numbers from the rows of pivots to their columns.
    exchanges: Exchanges,
    /// Whether the product of the pivots is positive.
    is_positive: bool,
}

/// What is written before it is read.
#[derive(Clone, Debug)]
struct Work<T> {
    /// The front at hand, row by row.
    front: Vec<T>,
    /// The place of a column in the front at hand.
    place: Vec<u32>,
    /// Rows that wait for their front.
    waiting: Vec<T>,
    /// The largest entry of U so far in each column.
    largest: Vec<T>,
}

impl<T: Scalar> Sparse<T> {
    /// Of a matrix whose rows have entries in these columns, ascending, and that has these fronts.
    pub(super) fn new(rows: &[Vec<u32>], order: Fronts) -> Self {
        let n = rows.len();
        let zeros = |count: usize| vec![T::lift(0.0); count];
        Self {
            entries: SparseRows::with_columns(rows),
            factors: Factors {
                numbers: zeros(order.factors()),
                rows: vec![0; order.rows()],
                pivot: vec![0; n],
                exchanges: Exchanges::new(n),
                is_positive: true,
            },
            work: Work {
                front: zeros(order.largest()),
                place: vec![0; n],
                waiting: zeros(order.waiting()),
                largest: zeros(n),
            },
            order,
        }
    }
}

impl<T: Real> Sink<T> for Sparse<T> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.entries.add(row, column, entry);
    }
}

impl<T: Real> SquareMatrix<T> for Sparse<T> {
    type Entries = Self;

    fn cleared(&mut self) -> &mut Self {
        self.entries.clear();
        self
    }

    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        sum.iter_mut().enumerate().for_each(|(row, sum)| *sum += factor * self.entries.times(row, x));
    }

    fn scale_rows(&mut self, scales: &[T]) {
        scales.iter().enumerate().for_each(|(row, &scale)| self.entries.scale(row, scale));
    }

    fn factor(&mut self) -> Result<(), StepFailure> {
        let Self { entries, order, factors, work } = self;
        if let Some((row, column)) = entries.outside {
            return Err(StepFailure::Pattern { row, column });
        }
        work.largest.fill(T::lift(LEAST));
        factors.is_positive = true;
        for front in &order.fronts {
            work.assemble(entries, order, front, &mut factors.rows);
            let rows = &mut factors.rows[front.rows.clone()];
            factors.is_positive ^= work.eliminate(&front.columns, front.pivots, rows)?;
            work.hand_on(front, &mut factors.numbers[front.factors.clone()]);
            for (&column, &row) in front.columns[..front.pivots].iter().zip(&*rows) {
                factors.pivot[column as usize] = row;
            }
        }
        factors.exchanges.set(&factors.pivot);
        Ok(())
    }

    fn is_positive(&self) -> bool {
        self.factors.is_positive ^ self.factors.exchanges.is_odd()
    }

    fn solve(&self, x: &mut [T]) {
        let Factors { numbers, rows, pivot, exchanges, .. } = &self.factors;
        for front in &self.order.fronts {
            let (pivots, rows) = (front.pivots, &rows[front.rows.clone()]);
            let (upper, lower) = numbers[front.factors.clone()].split_at(pivots * front.width());
            for (i, line) in upper.chunks_exact(front.width()).enumerate() {
                take_off(&line[..i], &rows[..i], rows[i], x);
            }
            for (line, &row) in lower.chunks_exact(pivots).zip(&rows[pivots..]) {
                take_off(line, &rows[..pivots], row, x);
            }
        }
        for front in self.order.fronts.iter().rev() {
            let upper = &numbers[front.factors.clone()][..front.pivots * front.width()];
            let columns = &front.columns;
            for (k, line) in upper.chunks_exact(front.width()).enumerate().rev() {
                let right = line[k + 1..].iter().zip(&columns[k + 1..]);
                let row = pivot[columns[k] as usize] as usize;
                let sum = right.fold(x[row], |sum, (&u, &j)| sum - u * x[pivot[j as usize] as usize]);
                x[row] = sum / line[k];
            }
        }
        exchanges.apply(x);
    }
}

/// Takes the multiples of the entries `of` of a vector off the entry `row`.
#[inline]
fn take_off<T: Real>(factors: &[T], of: &[u32], row: u32, x: &mut [T]) {
    let terms = factors.iter().zip(of);
    x[row as usize] = terms.fold(x[row as usize], |sum, (&l, &i)| sum - l * x[i as usize]);
}

impl<T: Real> Work<T> {
    /// Puts a front together, of the rows that wait for it and those of A that begin there, and lists which
    /// these are.
    fn assemble(&mut self, entries: &SparseRows<T>, order: &Fronts, front: &Front, rows: &mut [u32]) {
        let width = front.width();
        let table = &mut self.front[..front.rows.len() * width];
        table.fill(T::lift(0.0));
        for (place, &column) in front.columns.iter().enumerate() {
            self.place[column as usize] = place as u32;
        }
        let mut lines = table.chunks_exact_mut(width).zip(front.rows.clone());
        for child in order.children(front) {
            let columns = &child.columns[child.pivots..];
            let from = self.waiting[child.waiting.clone()].chunks_exact(child.width_left());
            for ((from, row), (line, at)) in from.zip(child.rows_left()).zip(&mut lines) {
                rows[at] = rows[row];
                for (&column, &value) in columns.iter().zip(from) {
                    line[self.place[column as usize] as usize] = value;
                }
            }
        }
        for (&row, (line, at)) in front.own.iter().zip(&mut lines) {
            rows[at] = row;
            entries.row(row as usize, |column, value| line[self.place[column] as usize] = value);
        }
    }

    /// Eliminates the first `pivots` of the columns of a front from its rows, which it brings into the order
    /// of the pivots. Returns whether the product of these is negative.
    fn eliminate(&mut self, columns: &[u32], pivots: usize, rows: &mut [u32]) -> Result<bool, StepFailure> {
        let (width, n) = (columns.len(), self.place.len());
        let rounding = T::default_epsilon() * T::lift(n as f64);
        let table = &mut self.front[..rows.len() * width];
        let mut is_negative = false;
        for (k, &column) in columns[..pivots].iter().enumerate() {
            let size = |row: usize| Scalar::abs(table[row * width + k]);
            let (mut row, mut pivot) = (k, size(k));
            for other in k + 1..rows.len() {
                if size(other) > pivot {
                    (row, pivot) = (other, size(other));
                }
            }
            let is_usable = is_pivot(pivot, rounding * self.largest[column as usize])
                || is_pivot(pivot, rounding * subtracted(table, width, row, k));
            if !is_usable {
                return Err(singular(pivot, column as usize));
            }
            rows.swap(k, row);
            let (upper, lower) = table.split_at_mut((k + 1) * width);
            let upper = &mut upper[k * width..];
            if row > k {
                upper.swap_with_slice(&mut lower[(row - k - 1) * width..][..width]);
            }
            is_negative ^= upper[k] < T::lift(0.0);
            let reciprocal = T::lift(1.0) / upper[k];
            for line in lower.chunks_exact_mut(width) {
                let factor = line[k] * reciprocal;
                line[k] = factor;
                for (a, &u) in line[k + 1..].iter_mut().zip(&upper[k + 1..]) {
                    *a -= factor * u;
                }
            }
            for (&u, &column) in upper[k + 1..].iter().zip(&columns[k + 1..]) {
                let largest = &mut self.largest[column as usize];
                *largest = larger(*largest, Scalar::abs(u));
            }
        }
        Ok(is_negative)
    }

    /// Keeps what solves with a front that has been eliminated, and lets the rest of its rows wait.
    fn hand_on(&mut self, front: &Front, factors: &mut [T]) {
        let (width, pivots) = (front.width(), front.pivots);
        let (upper, lower) = self.front[..front.rows.len() * width].split_at(pivots * width);
        let (kept, multipliers) = factors.split_at_mut(upper.len());
        kept.copy_from_slice(upper);
        if front.width_left() == 0 {
            return;
        }
        let lines = lower.chunks_exact(width).map(|line| line.split_at(pivots));
        let waiting = self.waiting[front.waiting.clone()].chunks_exact_mut(front.width_left());
        for ((done, left), (kept, waiting)) in lines.zip(multipliers.chunks_exact_mut(pivots).zip(waiting)) {
            kept.copy_from_slice(done);
            waiting.copy_from_slice(left);
        }
    }
}

/// What was subtracted in a front to form the entry in this row and column.
#[cold]
fn subtracted<T: Real>(table: &[T], width: usize, row: usize, column: usize) -> T {
    let terms = (0..column).map(|j| Scalar::abs(table[row * width + j] * table[j * width + column]));
    terms.fold(T::lift(LEAST), |sum, term| sum + term)
}
