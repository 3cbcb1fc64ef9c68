//! A space whose dimension is known at run time only.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt::Debug;
use core::ops::{Deref, DerefMut};

use super::linear::{RunTimeCoupled, RunTimeSolver, Storing};
use super::rows::SparseRows;
use super::square::RunTimeSquare;
use super::{Sink, Space};
use crate::{Real, Scalar};

/// A space whose dimension is known at run time only; its storage is on the heap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunTime {
    /// The number of coordinates.
    pub dimension: usize,
}

/// The matrix of a [`RunTime`] space.
#[derive(Clone, Debug, PartialEq)]
pub struct RunTimeMatrix<T> {
    entries: Vec<T>,
    dimension: usize,
}

impl<T> Deref for RunTimeMatrix<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.entries
    }
}

impl<T> DerefMut for RunTimeMatrix<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }
}

impl<T: Scalar> Sink<T> for RunTimeMatrix<T> {
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self.entries[row * self.dimension + column] += entry;
    }
}

impl RunTime {
    /// Fills an array of a state, whose length the run knows, again; generated code does.
    #[doc(hidden)]
    pub fn refill<E>(entries: &mut Vec<E>, len: usize, entry: impl Fn(usize) -> E) {
        entries.clear();
        entries.extend((0..len).map(entry));
    }

    /// The same for the rows of an array with two indices.
    #[doc(hidden)]
    pub fn refill_rows<T: Copy, R: AsMut<[T]>>(
        rows: &mut Vec<R>,
        from: core::slice::ChunksExact<'_, T>,
        read: impl Fn(&[T]) -> R,
    ) {
        let count = rows.len();
        let mut places = rows.iter_mut().zip(from.clone());
        if count == from.len() && places.all(|(row, from)| row.as_mut().len() == from.len()) {
            rows.iter_mut().zip(from).for_each(|(row, from)| row.as_mut().copy_from_slice(from));
        } else {
            *rows = from.map(read).collect();
        }
    }
}

impl Space for RunTime {
    const ON_STACK: bool = false;
    type Vector<E: Clone + Debug> = Vec<E>;
    // There is none.
    type Local<T: Scalar> = [[T; 0]; 0];
    type Matrix<T: Scalar> = RunTimeMatrix<T>;
    type Square<T: Real> = RunTimeSquare<T>;
    type Linear<T: Real> = RunTimeSolver<T>;
    type Coupled<const NODES: usize, T: Real> = RunTimeCoupled<T>;
    type Rows<C: Space, T: Scalar> = SparseRows<T>;

    fn dimension(self) -> usize {
        self.dimension
    }
    fn array<E: Clone + Debug>(self, entry: E) -> Vec<E> {
        vec![entry; self.dimension]
    }
    fn rows<C: Space, T: Scalar>(
        self,
        over: C,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> SparseRows<T> {
        SparseRows::new(over.dimension(), entries)
    }
    fn matrix<T: Scalar>(self) -> Self::Matrix<T> {
        let Self { dimension } = self;
        RunTimeMatrix { entries: vec![T::lift(0.0); dimension * dimension], dimension }
    }
    fn square<T: Real>(self, entries: impl FnOnce(&mut dyn FnMut(usize, usize))) -> Self::Square<T> {
        RunTimeSquare::new(self, entries)
    }
    fn linear<T: Real>(
        self,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Linear<T> {
        RunTimeSolver::new(self, storing, entries)
    }
    fn coupled<const NODES: usize, T: Real>(
        self,
        unknown: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T> {
        RunTimeCoupled::new(self, unknown, storing, entries)
    }
}
