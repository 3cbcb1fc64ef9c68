//! What becomes of the entries of a matrix.
//!
//! Generated second derivatives go entry by entry to a [`Sink`]: into a matrix of this crate
//! ([`Space`](crate::Space)), into a slice ([`Dense`]), into the product with a vector, for which no matrix
//! is stored (`Product`, `TransposedProduct`), or, for the pattern, to a function that is told where
//! they stand (`Places`). An entry may come in several parts, which a sink adds.

use crate::Scalar;

/// What takes the entries of a matrix.
pub trait Sink<T> {
    /// Adds `entry` to the entry in `row` and `column`, both counted from 0.
    fn add(&mut self, row: usize, column: usize, entry: T);
}

/// A row-major matrix in a slice of the caller's.
#[derive(Debug)]
pub struct Dense<'a, T> {
    entries: &'a mut [T],
    columns: usize,
}

impl<'a, T> Dense<'a, T> {
    /// The matrix with this number of columns whose rows follow each other in `entries`.
    pub fn new(entries: &'a mut [T], columns: usize) -> Self {
        Self { entries, columns }
    }
}

impl<T: Scalar> Sink<T> for Dense<'_, T> {
    /// # Panics
    /// If the slice ends before this entry.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.entries[row * self.columns + column] += entry;
    }
}

/// Adds A x to a vector.
#[derive(Debug)]
pub(crate) struct Product<'a, T> {
    /// x
    pub(crate) x: &'a [T],
    /// What A x is added to.
    pub(crate) sum: &'a mut [T],
}

impl<T: Scalar> Sink<T> for Product<'_, T> {
    /// # Panics
    /// If one of the vectors ends before this row or column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.sum[row] += entry * self.x[column];
    }
}

/// Adds Aᵀ x to a vector.
#[derive(Debug)]
pub(crate) struct TransposedProduct<'a, T> {
    /// x
    pub(crate) x: &'a [T],
    /// What Aᵀ x is added to.
    pub(crate) sum: &'a mut [T],
}

impl<T: Scalar> Sink<T> for TransposedProduct<'_, T> {
    /// # Panics
    /// If one of the vectors ends before this row or column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.sum[column] += entry * self.x[row];
    }
}

/// Calls a function with row, column and entry: to find the pattern of a matrix, for instance.
#[derive(Debug)]
pub(crate) struct Places<F>(
    /// The function.
    pub(crate) F,
);

impl<T, F: FnMut(usize, usize, T)> Sink<T> for Places<F> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        (self.0)(row, column, entry);
    }
}

/// Passes the entries on with factors.
#[derive(Debug)]
pub(crate) struct Scaled<'a, K, F> {
    pub(crate) sink: &'a mut K,
    /// The factor of the entry in this row and column.
    pub(crate) factor: F,
}

impl<T: Scalar, K: Sink<T>, F: Fn(usize, usize) -> T> Sink<T> for Scaled<'_, K, F> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.sink.add(row, column, (self.factor)(row, column) * entry);
    }
}
