//! Where a run was before steps that may be taken back.

use core::ops::DerefMut;

use crate::memory::Memory;

/// A point of a run with coordinates `Q`, and what its method carries there.
#[derive(Debug)]
pub(crate) struct Kept<Q, K> {
    pub(crate) q: Q,
    pub(crate) memory: K,
}

impl<Q, K> Kept<Q, K> {
    /// Takes over where a run is.
    #[inline]
    pub(crate) fn take<T: Copy>(&mut self, q: &Q, memory: &K)
    where
        Q: DerefMut<Target = [T]>,
        K: Memory<T>,
    {
        self.q.copy_from_slice(q);
        self.memory.restore(memory);
    }

    /// Takes a run back there.
    pub(crate) fn go_back<T: Copy>(&self, q: &mut Q, memory: &mut K)
    where
        Q: DerefMut<Target = [T]>,
        K: Memory<T>,
    {
        q.copy_from_slice(&self.q);
        memory.restore(&self.memory);
    }
}
