//! Gaussian elimination of a sparse matrix with partial pivoting, front by front.
//!
//! The rows of a front stand in a dense rectangle: those of A that begin here, and those that earlier fronts
//! have handed on. As every row with an entry in the columns that it eliminates is among them, the largest
//! entry of a column is the pivot, as in a dense elimination. Which columns make a front is found once, when
//! the matrix is made ([`fronts`](super::fronts)). A pivot counts as zero when it is no larger than the
//! rounding errors of the entries above it, |pivot| ≤ n ε maxᵢ |uᵢₖ|, i < k, and of what was subtracted in
//! its front to form it. Sources: Duff & Reid 1983 (fronts), George & Ng 1985 (room for all pivots).

use alloc::vec;
use alloc::vec::Vec;

use super::SquareMatrix;
use super::exchanges::Exchanges;
use super::fronts::{Front, storage};
use crate::error::StepFailure;
use crate::scalar::norm::{is_pivot, larger, singular};
use crate::space::elimination::LEAST;
use crate::space::rows::{RowMatrix, SparseRows};
use crate::{Real, Scalar};

/// A sparse matrix.
#[derive(Clone, Debug)]
pub struct Sparse<T> {
    pub(super) entries: SparseRows<T>,
    fronts: Vec<Front>,
    /// Front by front, row by row: in the rows of pivots U, and before the pivot its multipliers; in the
    /// others multipliers, and what is handed on.
    numbers: Vec<T>,
    /// Front by front: which rows of A it has, first the pivots.
    rows: Vec<u32>,
    /// The row of A that is the pivot of each column.
    pivot: Vec<u32>,
    /// Brings numbers from the rows of pivots to their columns.
    exchanges: Exchanges,
    /// Whether the product of the pivots is positive.
    is_positive: bool,
    /// The place of a column in the front at hand.
    place: Vec<u32>,
    /// The largest entry of U so far in each column.
    largest: Vec<T>,
}

impl<T: Scalar> Sparse<T> {
    /// Of a matrix whose rows have entries in these columns, ascending, and that has these fronts.
    pub(super) fn new(rows: &[Vec<u32>], fronts: Vec<Front>) -> Self {
        let n = rows.len();
        let zeros = |count: usize| vec![T::lift(0.0); count];
        Self {
            entries: SparseRows::with_columns(rows),
            numbers: zeros(storage(&fronts)),
            rows: vec![0; fronts.last().map_or(0, |front| front.rows.end)],
            pivot: vec![0; n],
            exchanges: Exchanges::new(n),
            is_positive: true,
            place: vec![0; n],
            largest: zeros(n),
            fronts,
        }
    }
}

impl<T: Real> SquareMatrix<T> for Sparse<T> {
    type Entries = SparseRows<T>;

    fn cleared(&mut self) -> &mut SparseRows<T> {
        self.entries.clear();
        &mut self.entries
    }

    fn multiply_add(&self, factor: T, x: &[T], sum: &mut [T]) {
        sum.iter_mut().enumerate().for_each(|(row, sum)| *sum += factor * self.entries.times(row, x));
    }

    fn scale_rows(&mut self, scales: &[T]) {
        scales.iter().enumerate().for_each(|(row, &scale)| self.entries.scale(row, scale));
    }

    fn factor(&mut self) -> Result<(), StepFailure> {
        if let Some((row, column)) = self.entries.outside {
            return Err(StepFailure::Pattern { row, column });
        }
        self.largest.fill(T::lift(LEAST));
        self.is_positive = true;
        for front in 0..self.fronts.len() {
            self.assemble(front);
            self.eliminate_front(front)?;
        }
        self.exchanges.set(&self.pivot);
        Ok(())
    }

    fn is_positive(&self) -> bool {
        self.is_positive ^ self.exchanges.is_odd()
    }

    fn solve(&self, x: &mut [T]) {
        let Self { fronts, numbers, rows, pivot, exchanges, .. } = self;
        for front in fronts {
            let (pivots, rows) = (front.pivots, &rows[front.rows.clone()]);
            let lines = numbers[front.numbers.clone()].chunks_exact(front.width());
            for (i, (line, &row)) in lines.zip(rows).enumerate() {
                let done = i.min(pivots);
                let terms = line[..done].iter().zip(&rows[..done]);
                x[row as usize] = terms.fold(x[row as usize], |sum, (&l, &i)| sum - l * x[i as usize]);
            }
        }
        for front in fronts.iter().rev() {
            let columns = &front.columns;
            let upper = &numbers[front.numbers.clone()][..front.pivots * front.width()];
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

impl<T: Real> Sparse<T> {
    /// Puts a front together, of the rows that others hand on to it and those of A that begin there, and
    /// lists which these are.
    fn assemble(&mut self, front: usize) {
        let Self { entries, fronts, numbers, rows, place, .. } = self;
        let front = &fronts[front];
        let (before, table) = numbers.split_at_mut(front.numbers.start);
        let table = &mut table[..front.numbers.len()];
        table.fill(T::lift(0.0));
        for (at, &column) in front.columns.iter().enumerate() {
            place[column as usize] = at as u32;
        }
        let mut lines = table.chunks_exact_mut(front.width()).zip(front.rows.clone());
        for child in front.children.iter().map(|&child| &fronts[child as usize]) {
            let from = before[child.numbers.clone()].chunks_exact(child.width()).skip(child.pivots);
            for ((from, row), (line, at)) in from.zip(child.rows_left()).zip(&mut lines) {
                rows[at] = rows[row];
                for (&column, &value) in child.columns.iter().zip(from).skip(child.pivots) {
                    line[place[column as usize] as usize] = value;
                }
            }
        }
        for (&row, (line, at)) in front.own.iter().zip(&mut lines) {
            rows[at] = row;
            entries.row(row as usize, |column, value| line[place[column] as usize] = value);
        }
    }

    /// Eliminates the columns of a front from its rows, which it brings into the order of the pivots.
    fn eliminate_front(&mut self, front: usize) -> Result<(), StepFailure> {
        let Self { fronts, numbers, rows, pivot: pivot_of, is_positive, largest, .. } = self;
        let front = &fronts[front];
        let (width, columns, rows) = (front.width(), &front.columns, &mut rows[front.rows.clone()]);
        let rounding = T::default_epsilon() * T::lift(largest.len() as f64);
        let table = &mut numbers[front.numbers.clone()];
        for (k, &column) in columns[..front.pivots].iter().enumerate() {
            let size = |row: usize| Scalar::abs(table[row * width + k]);
            let (mut row, mut pivot) = (k, size(k));
            for other in k + 1..rows.len() {
                if size(other) > pivot {
                    (row, pivot) = (other, size(other));
                }
            }
            let is_usable = is_pivot(pivot, rounding * largest[column as usize])
                || is_pivot(pivot, rounding * subtracted(table, width, row, k));
            if !is_usable {
                return Err(singular(pivot, column as usize));
            }
            rows.swap(k, row);
            pivot_of[column as usize] = rows[k];
            let (upper, lower) = table.split_at_mut((k + 1) * width);
            let upper = &mut upper[k * width..];
            if row > k {
                upper.swap_with_slice(&mut lower[(row - k - 1) * width..][..width]);
            }
            *is_positive ^= upper[k] < T::lift(0.0);
            let reciprocal = T::lift(1.0) / upper[k];
            for line in lower.chunks_exact_mut(width) {
                let factor = line[k] * reciprocal;
                line[k] = factor;
                for (a, &u) in line[k + 1..].iter_mut().zip(&upper[k + 1..]) {
                    *a -= factor * u;
                }
            }
            for (&u, &column) in upper[k + 1..].iter().zip(&columns[k + 1..]) {
                let largest = &mut largest[column as usize];
                *largest = larger(*largest, Scalar::abs(u));
            }
        }
        Ok(())
    }
}

/// What was subtracted in a front to form the entry in this row and column.
#[cold]
fn subtracted<T: Real>(table: &[T], width: usize, row: usize, column: usize) -> T {
    let terms = (0..column).map(|j| Scalar::abs(table[row * width + j] * table[j * width + column]));
    terms.fold(T::lift(LEAST), |sum, term| sum + term)
}
