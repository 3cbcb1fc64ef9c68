//! An interval of the motion of a system, and its two ends.

use crate::Real;

/// The time from t to t + h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T = f64> {
    /// The time at which it begins.
    pub t: T,
    /// Its length, which may be negative.
    pub h: T,
}

impl<T: Real> Interval<T> {
    /// t + ch.
    #[inline]
    pub fn time(&self, c: T) -> T {
        self.t + c * self.h
    }
}

/// An interval of the motion of a system, with its two ends: q0, and Δ = q1 − q0.
#[derive(Debug)]
pub struct Span<'a, S, T> {
    /// The system.
    pub system: &'a S,
    /// The time.
    pub interval: Interval<T>,
    /// The coordinates where it begins.
    pub q0: &'a [T],
    /// The difference of the two points.
    pub delta: &'a [T],
}

impl<S, T: Copy> Clone for Span<'_, S, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, T: Copy> Copy for Span<'_, S, T> {}
