//! The impulses of the constraints in a step, and their multipliers.

use crate::mechanics::constraints::Multipliers;
use crate::memory::{Memory, lasting};
use crate::{ConstrainedSystem, Real, Space};

/// The impulses of the constraints at both ends of a step.
#[derive(Debug)]
pub(super) struct Impulses<S: ConstrainedSystem, T: Real> {
    pub(super) first: Multipliers<S, T>,
    pub(super) last: Multipliers<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Impulses<S, T> {
    pub(super) fn new(system: &S) -> Self {
        Self { first: system.multipliers().vector(), last: system.multipliers().vector() }
    }

    /// λ of a step of length `h`, zero before the first, which has none.
    pub(super) fn over(&self, h: T) -> impl Iterator<Item = T> + '_ {
        let zero = T::lift(0.0);
        let impulses = self.first.iter().zip(self.last.iter());
        impulses.map(move |(&first, &last)| if h == zero { zero } else { (first + last) / h })
    }
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Impulses<S, T> {
    lasting!(T; numbers first, numbers last);
}
