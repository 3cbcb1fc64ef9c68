//! Where a run was before a step that may be taken back.

use core::ops::DerefMut;

use crate::memory::Memory;

/// A point of a run with coordinates `q`, and what its method carried there.
#[derive(Debug)]
pub(crate) struct Before<I, V> {
    pub(crate) inner: I,
    pub(crate) q: V,
}

impl<I, V> Before<I, V> {
    /// Takes over the present point.
    pub(crate) fn keep<T: Copy>(&mut self, inner: &I, q: &[T])
    where
        I: Memory<T>,
        V: DerefMut<Target = [T]>,
    {
        self.inner.restore(inner);
        self.q.copy_from_slice(q);
    }

    /// Makes the present point that one again.
    pub(crate) fn go_back<T: Copy>(&self, inner: &mut I, q: &mut [T])
    where
        I: Memory<T>,
        V: DerefMut<Target = [T]>,
    {
        inner.restore(&self.inner);
        q.copy_from_slice(&self.q);
    }
}
