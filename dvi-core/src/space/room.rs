//! Where the numbers of a space of fixed size are kept.
//!
//! What lives in a value is as large as the value, and is copied with it from frame to frame where a run
//! begins: with a matrix of n² numbers in each, a hundred coordinates are more than the stack of a thread
//! has. The length of an array in stable Rust is a parameter and no expression of one, so that a type cannot
//! choose by its size; it has room for a few numbers, and the heap for more.

use core::fmt::Debug;

/// Up to how many numbers are kept in the value itself.
pub trait Room: Copy + Debug + Default + PartialEq {
    /// The largest dimension of which vectors, and matrices, are kept in the value.
    const LARGEST: usize;
    /// One entry for each of `BLOCKS` times `N` coordinates, or fewer.
    type Vector<E: Clone + Debug, const BLOCKS: usize, const N: usize>: Store<E>;
    /// The square of as many.
    type Matrix<E: Clone + Debug, const BLOCKS: usize, const N: usize>: Store<E>;
    /// A vector in the value, if there is room for it there.
    type Local<E: Clone + Debug, const BLOCKS: usize, const N: usize>: Store<E>;
}

/// Entries, in the value or on the heap. How many there are is known where they are asked for.
pub trait Store<E>: Clone + Debug {
    /// So many entries, all the same.
    fn new(count: usize, entry: E) -> Self;
    /// All of them.
    fn entries(&self, count: usize) -> &[E];
    /// All of them.
    fn entries_mut(&mut self, count: usize) -> &mut [E];
}

/// All in the value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InPlace;

impl Room for InPlace {
    const LARGEST: usize = usize::MAX;
    type Vector<E: Clone + Debug, const BLOCKS: usize, const N: usize> = [[E; N]; BLOCKS];
    type Matrix<E: Clone + Debug, const BLOCKS: usize, const N: usize> = [[[[E; N]; BLOCKS]; N]; BLOCKS];
    type Local<E: Clone + Debug, const BLOCKS: usize, const N: usize> = Self::Vector<E, BLOCKS, N>;
}

impl<E: Clone + Debug, const BLOCKS: usize, const N: usize> Store<E> for [[E; N]; BLOCKS] {
    #[inline]
    fn new(_count: usize, entry: E) -> Self {
        core::array::from_fn(|_| core::array::from_fn(|_| entry.clone()))
    }
    #[inline]
    fn entries(&self, count: usize) -> &[E] {
        &self.as_flattened()[..count]
    }
    #[inline]
    fn entries_mut(&mut self, count: usize) -> &mut [E] {
        &mut self.as_flattened_mut()[..count]
    }
}

impl<E: Clone + Debug, const BLOCKS: usize, const N: usize> Store<E> for [[[[E; N]; BLOCKS]; N]; BLOCKS] {
    #[inline]
    fn new(count: usize, entry: E) -> Self {
        core::array::from_fn(|_| core::array::from_fn(|_| Store::new(count, entry.clone())))
    }
    #[inline]
    fn entries(&self, count: usize) -> &[E] {
        &self.as_flattened().as_flattened().as_flattened()[..count]
    }
    #[inline]
    fn entries_mut(&mut self, count: usize) -> &mut [E] {
        &mut self.as_flattened_mut().as_flattened_mut().as_flattened_mut()[..count]
    }
}

/// Up to eight coordinates and their matrices in the value, and more on the heap: for sizes that are
/// parameters.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FewInPlace;

/// Without a heap there is no other place.
#[cfg(not(feature = "alloc"))]
pub type FewInPlace = InPlace;

#[cfg(feature = "alloc")]
const FEW: usize = 8;

#[cfg(feature = "alloc")]
impl Room for FewInPlace {
    const LARGEST: usize = FEW;
    type Vector<E: Clone + Debug, const BLOCKS: usize, const N: usize> = FewOrHeap<E, FEW>;
    type Matrix<E: Clone + Debug, const BLOCKS: usize, const N: usize> = FewOrHeap<E, { FEW * FEW }>;
    type Local<E: Clone + Debug, const BLOCKS: usize, const N: usize> = [[E; FEW]; 1];
}

/// The store of [`FewInPlace`].
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct FewOrHeap<E, const FEW: usize> {
    few: [E; FEW],
    /// Empty if there are no more than those.
    heap: alloc::boxed::Box<[E]>,
}

#[cfg(feature = "alloc")]
impl<E: Clone + Debug, const FEW: usize> Store<E> for FewOrHeap<E, FEW> {
    #[inline]
    fn new(count: usize, entry: E) -> Self {
        let few = core::array::from_fn(|_| entry.clone());
        let more = if count <= FEW { 0 } else { count };
        Self { few, heap: alloc::vec![entry; more].into() }
    }
    #[inline]
    fn entries(&self, count: usize) -> &[E] {
        if count <= FEW { &self.few[..count] } else { &self.heap[..count] }
    }
    #[inline]
    fn entries_mut(&mut self, count: usize) -> &mut [E] {
        if count <= FEW { &mut self.few[..count] } else { &mut self.heap[..count] }
    }
}
