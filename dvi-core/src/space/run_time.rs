//! A space whose dimension is known at run time only.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt::Debug;
use core::ops::{Deref, DerefMut};

use super::linear::{RunTimeCoupled, RunTimeSolver, Storing};
use super::rows::SparseRows;
use super::square::RunTimeSquare;
use super::{Sink, Space};
use crate::scalar::spinor;
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
    /// Reads a block of a state whose length the run knows; generated code does.
    #[doc(hidden)]
    pub fn read_block<T: Scalar>(len: usize, at: &mut usize, flat: &[T]) -> Vec<T> {
        let start = *at;
        *at += len;
        flat[start..*at].to_vec()
    }

    /// Reads vectors of a state, all first components before all second ones.
    #[doc(hidden)]
    pub fn read_vectors<T: Scalar, const D: usize>(len: usize, at: &mut usize, flat: &[T]) -> Vec<[T; D]> {
        let mut vectors = Vec::with_capacity(len);
        Self::refill_vectors(len, at, flat, &mut vectors);
        vectors
    }

    /// The same, into the storage of such vectors.
    #[doc(hidden)]
    pub fn refill_vectors<T: Scalar, const D: usize>(
        len: usize,
        at: &mut usize,
        flat: &[T],
        vectors: &mut Vec<[T; D]>,
    ) {
        let start = *at;
        *at += D * len;
        vectors.clear();
        vectors.extend((0..len).map(|i| core::array::from_fn(|axis| flat[start + axis * len + i])));
    }

    /// Reads unit vectors of a state, of which spinors are carried.
    #[doc(hidden)]
    pub fn read_spinors<T: Scalar>(len: usize, at: &mut usize, flat: &[T]) -> Vec<[T; 3]> {
        let mut vectors = Vec::with_capacity(len);
        Self::refill_spinors(len, at, flat, &mut vectors);
        vectors
    }

    /// The same, into the storage of such vectors.
    #[doc(hidden)]
    pub fn refill_spinors<T: Scalar>(len: usize, at: &mut usize, flat: &[T], vectors: &mut Vec<[T; 3]>) {
        vectors.clear();
        vectors.extend((0..len).map(spinor::read(len, at, flat)));
    }

    /// Reads the rows of an array with two indices: of so many entries, so many in each.
    #[doc(hidden)]
    pub fn read_rows<T, R>(
        [all, length]: [usize; 2],
        at: &mut usize,
        flat: &[T],
        read: impl Fn(usize, &mut usize, &[T]) -> R,
    ) -> Vec<R> {
        let rows = all.checked_div(length).unwrap_or(0);
        (0..rows).map(|_| read(length, at, flat)).collect()
    }

    /// The same, into the storage of such rows.
    #[doc(hidden)]
    pub fn refill_rows<T: Copy, R: AsMut<[T]>>(
        lengths: [usize; 2],
        at: &mut usize,
        flat: &[T],
        read: impl Fn(usize, &mut usize, &[T]) -> R,
        rows: &mut Vec<R>,
    ) {
        let [all, length] = lengths;
        let fits = length * rows.len() == all && rows.iter_mut().all(|row| row.as_mut().len() == length);
        if !fits {
            *rows = Self::read_rows(lengths, at, flat, read);
            return;
        }
        for row in rows {
            let start = *at;
            *at += length;
            row.as_mut().copy_from_slice(&flat[start..*at]);
        }
    }

    /// The same as [`read_block`](Self::read_block), into the storage of such a block.
    #[doc(hidden)]
    pub fn refill_block<T: Scalar>(len: usize, at: &mut usize, flat: &[T], block: &mut Vec<T>) {
        let start = *at;
        *at += len;
        block.clear();
        block.extend_from_slice(&flat[start..*at]);
    }
}

impl Space for RunTime {
    const ON_STACK: bool = false;
    type Vector<T: Scalar> = Vec<T>;
    type Local<T: Scalar> = Vec<T>;
    type Matrix<T: Scalar> = RunTimeMatrix<T>;
    type Square<T: Real> = RunTimeSquare<T>;
    type Linear<T: Real> = RunTimeSolver<T>;
    type Coupled<const NODES: usize, T: Real> = RunTimeCoupled<T>;
    type Array<E: Clone + Debug> = Vec<E>;
    type Rows<C: Space, T: Scalar> = SparseRows<T>;
    type Permutation = Vec<usize>;

    fn dimension(self) -> usize {
        self.dimension
    }
    fn vector<T: Scalar>(self) -> Self::Vector<T> {
        vec![T::lift(0.0); self.dimension]
    }
    fn array<E: Clone + Debug>(self, mut of: impl FnMut() -> E) -> Vec<E> {
        (0..self.dimension).map(|_| of()).collect()
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
        RunTimeSolver::new(self.dimension, storing, entries)
    }
    fn coupled<const NODES: usize, T: Real>(
        self,
        unknown: usize,
        storing: Storing,
        entries: impl FnOnce(&mut dyn FnMut(usize, usize)),
    ) -> Self::Coupled<NODES, T> {
        RunTimeCoupled::new(self, unknown, storing, entries)
    }
    fn permutation(self) -> Self::Permutation {
        vec![0; self.dimension]
    }
}
