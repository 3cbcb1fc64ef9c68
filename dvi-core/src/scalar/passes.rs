//! Passes over vectors.

use crate::Real;

/// Sets `sum` to x + Δ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add<T: Real>(x: &[T], delta: &[T], sum: &mut [T]) {
    for ((sum, &x), &delta) in sum.iter_mut().zip(x).zip(delta) {
        *sum = x + delta;
    }
}
