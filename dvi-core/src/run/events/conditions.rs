//! What is looked at: closures, and the events that a system declares.

use crate::run::between::Flat;
use crate::{Lagrangian, Real, System};

/// Conditions of which an event is a zero: a closure over the time and the state, or those that are
/// [declared](crate::run::Run::declared_events) in the attribute of the system.
pub trait Conditions<S: System, T: Real, const N: usize> {
    /// Their values at time `t`. What `state` is before does not matter.
    fn values(&mut self, t: T, at: Flat<'_, S, T>, state: &mut S::State<T>) -> [T; N];
}

impl<S: System, T: Real, const N: usize, G: FnMut(T, &S::State<T>) -> [T; N]> Conditions<S, T, N> for G {
    #[inline]
    fn values(&mut self, t: T, at: Flat<'_, S, T>, state: &mut S::State<T>) -> [T; N] {
        at.refill(state);
        self(t, state)
    }
}

/// The events that a system declares, all in their order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Declared;

impl<S: Lagrangian<T>, T: Real, const N: usize> Conditions<S, T, N> for Declared {
    #[inline]
    fn values(&mut self, t: T, at: Flat<'_, S, T>, _: &mut S::State<T>) -> [T; N] {
        core::array::from_fn(|index| at.system.event(index, at.q, at.v, t))
    }
}
