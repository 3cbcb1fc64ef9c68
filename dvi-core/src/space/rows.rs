//! The rows of a matrix that has one for each constraint, or coordinate, and a column for each coordinate.
//!
//! With sizes that are fixed at compile time the rows are full and on the stack. With one that is known at
//! run time only, they keep the entries that their pattern has.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::fmt::Debug;
use core::ops::DerefMut;

use crate::Scalar;
use crate::memory::{Memory, lasting};
use crate::space::Sink;

/// Rows that are filled entry by entry.
pub trait RowMatrix<T>: Sink<T> + Memory<T> + Debug {
    /// Sets all entries to zero.
    fn clear(&mut self);
    /// Σⱼ wⱼ aₖⱼ bₖⱼ over row `k` of this matrix and of another one with the same pattern, with `weights` w.
    fn dot(&self, k: usize, other: &Self, weights: &[T]) -> T;
    /// The entries of row `k` that may differ from zero, each with its column.
    fn row(&self, k: usize, each: impl FnMut(usize, T));
    /// Σⱼ aₖⱼ xⱼ over row `k`.
    fn times(&self, k: usize, x: &[T]) -> T;
}

/// Full rows `V`, in an array `A` of them.
#[derive(Clone, Debug)]
pub struct FullRows<A>(pub(crate) A);

impl<T: Scalar, V: DerefMut<Target = [T]>, A: DerefMut<Target = [V]>> Sink<T> for FullRows<A> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.0[row][column] += entry;
    }
}

lasting!([T: Copy, V: DerefMut<Target = [T]>, A: DerefMut<Target = [V]>] FullRows<A>, T; vectors 0);

impl<T: Scalar, V: DerefMut<Target = [T]> + Debug, A: DerefMut<Target = [V]> + Debug> RowMatrix<T>
    for FullRows<A>
{
    #[inline]
    fn clear(&mut self) {
        self.0.iter_mut().for_each(|row| row.fill(T::lift(0.0)));
    }
    #[inline]
    fn dot(&self, k: usize, other: &Self, weights: &[T]) -> T {
        weighted(&self.0[k], &other.0[k], weights.iter().copied())
    }
    #[inline]
    fn row(&self, k: usize, mut each: impl FnMut(usize, T)) {
        self.0[k].iter().enumerate().for_each(|(column, &entry)| each(column, entry));
    }
    #[inline]
    fn times(&self, k: usize, x: &[T]) -> T {
        self.0[k].iter().zip(x).fold(T::lift(0.0), |sum, (&a, &x)| sum + a * x)
    }
}

#[inline]
fn weighted<T: Scalar>(a: &[T], b: &[T], weights: impl Iterator<Item = T>) -> T {
    a.iter().zip(b).zip(weights).fold(T::lift(0.0), |sum, ((&a, &b), w)| sum + w * a * b)
}

/// Rows of the entries that a pattern has.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct SparseRows<T> {
    /// Where each row begins, and where the last one ends.
    begins: Vec<usize>,
    columns: Vec<u32>,
    entries: Vec<T>,
    /// Row and column of an entry that was added and has no place: no product is a number then.
    pub(super) outside: Option<(usize, usize)>,
}

#[cfg(feature = "alloc")]
impl<T: Scalar> SparseRows<T> {
    /// So many rows with room for the entries that `entries` visits.
    pub(crate) fn new(rows: usize, entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self {
        let mut columns: Vec<Vec<u32>> = alloc::vec![Vec::new(); rows];
        entries(&mut |row, column| {
            let column = column as u32;
            if !columns[row].contains(&column) {
                columns[row].push(column);
            }
        });
        Self::with_columns(&columns)
    }

    /// Rows with entries in these columns.
    pub(super) fn with_columns(columns: &[Vec<u32>]) -> Self {
        let begins = core::iter::once(0).chain(columns.iter().scan(0, |end, row| {
            *end += row.len();
            Some(*end)
        }));
        let begins = begins.collect();
        let columns: Vec<u32> = columns.concat();
        let entries = alloc::vec![T::lift(0.0); columns.len()];
        Self { begins, columns, entries, outside: None }
    }

    fn places(&self, row: usize) -> core::ops::Range<usize> {
        self.begins[row]..self.begins[row + 1]
    }

    /// Multiplies row `k` by `scale`.
    pub(super) fn scale(&mut self, k: usize, scale: T) {
        let places = self.places(k);
        self.entries[places].iter_mut().for_each(|entry| *entry = *entry * scale);
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Sink<T> for SparseRows<T> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        let places = self.places(row);
        let found = self.columns[places.clone()].iter().position(|&known| known as usize == column);
        match found {
            Some(place) => self.entries[places.start + place] += entry,
            None => self.outside = Some((row, column)),
        }
    }
}

#[cfg(feature = "alloc")]
lasting!([T: Copy] SparseRows<T>, T; numbers entries);

#[cfg(feature = "alloc")]
impl<T: Scalar> RowMatrix<T> for SparseRows<T> {
    #[inline]
    fn clear(&mut self) {
        self.entries.fill(T::lift(0.0));
        self.outside = None;
    }
    #[inline]
    fn dot(&self, k: usize, other: &Self, weights: &[T]) -> T {
        if self.outside.is_some() || other.outside.is_some() {
            return T::lift(f64::NAN);
        }
        let places = self.places(k);
        let of_columns = self.columns[places.clone()].iter().map(|&column| weights[column as usize]);
        weighted(&self.entries[places.clone()], &other.entries[places], of_columns)
    }
    #[inline]
    fn row(&self, k: usize, mut each: impl FnMut(usize, T)) {
        let places = self.places(k);
        let columns = self.columns[places.clone()].iter();
        columns.zip(&self.entries[places]).for_each(|(&column, &entry)| each(column as usize, entry));
    }
    #[inline]
    fn times(&self, k: usize, x: &[T]) -> T {
        let places = self.places(k);
        let of_columns = self.columns[places.clone()].iter().map(|&column| x[column as usize]);
        self.entries[places].iter().zip(of_columns).fold(T::lift(0.0), |sum, (&a, x)| sum + a * x)
    }
}
