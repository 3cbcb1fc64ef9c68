//! Passes over vectors.

use core::sync::atomic::{Ordering, compiler_fence};

use crate::scalar::pack::Pack;
use crate::{Real, Scalar};

/// What an iteration over coordinates begins with where these may be packs: the optimiser takes each by
/// itself. Else it gathers equal lanes of different coordinates, and eight runs of four vortices take 2.4
/// times as long (`cargo bench -p dvi-benches --bench lanes`). It is no instruction.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lanes_stay_together<T: Scalar>() {
    if T::Pack::WIDTH == 1 {
        compiler_fence(Ordering::SeqCst);
    }
}

/// Sets `sum` to x + Δ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add<T: Real>(x: &[T], delta: &[T], sum: &mut [T]) {
    for ((sum, &x), &delta) in sum.iter_mut().zip(x).zip(delta) {
        *sum = x + delta;
    }
}

/// A kick of the momentum, p ← p + a F, or a drift of the point, q ← q + a v.
pub(crate) fn kick<T: Real>(p: &mut [T], a: T, force: &[T]) {
    for (p, &force) in p.iter_mut().zip(force) {
        *p += a * force;
    }
}
