//! Permutations of a vector in its own storage.

use alloc::vec;
use alloc::vec::Vec;

/// With which entry each is exchanged, one after the other, so that entry k becomes the one that was at
/// `order[k]`.
#[derive(Clone, Debug)]
pub(super) struct Exchanges {
    with: Vec<u32>,
    /// What stands where while the exchanges are made, and where each entry has got to.
    holds: Vec<u32>,
    at: Vec<u32>,
}

impl Exchanges {
    /// Of `n` entries, each in its place.
    pub(super) fn new(n: usize) -> Self {
        let identity: Vec<u32> = (0..n as u32).collect();
        Self { with: identity.clone(), holds: vec![0; n], at: identity }
    }

    pub(super) fn set(&mut self, order: &[u32]) {
        let Self { with, holds, at } = self;
        for (k, (holds, at)) in holds.iter_mut().zip(&mut *at).enumerate() {
            (*holds, *at) = (k as u32, k as u32);
        }
        for (k, (with, &i)) in with.iter_mut().zip(order).enumerate() {
            *with = at[i as usize];
            at[holds[k] as usize] = *with;
            holds.swap(k, *with as usize);
        }
    }

    pub(super) fn apply<T>(&self, x: &mut [T]) {
        for (k, &with) in self.with.iter().enumerate() {
            x.swap(k, with as usize);
        }
    }

    pub(super) fn revert<T>(&self, x: &mut [T]) {
        for (k, &with) in self.with.iter().enumerate().rev() {
            x.swap(k, with as usize);
        }
    }

    /// Whether their number is odd, exchanges of an entry with itself not counted.
    pub(super) fn is_odd(&self) -> bool {
        self.with.iter().enumerate().fold(false, |is_odd, (k, &with)| is_odd ^ (with as usize != k))
    }
}
