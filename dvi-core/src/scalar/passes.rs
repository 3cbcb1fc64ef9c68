//! Passes over vectors.

use core::ops::Range;
use core::sync::atomic::{Ordering, compiler_fence};

use crate::scalar::pack::Pack;
use crate::{Real, Scalar};

/// What an iteration over coordinates begins with where these may be packs: the optimiser takes each by
/// itself. Else it gathers equal lanes of different coordinates, and eight runs of four vortices take 2.4
/// times as long (`cargo bench -p dvi-benches --bench lanes`). It is no instruction.
#[inline]
pub(crate) fn lanes_stay_together<T: Scalar>() {
    if T::Pack::WIDTH == 1 {
        compiler_fence(Ordering::SeqCst);
    }
}

/// How many coordinates a block has: eight vectors of so many numbers are half of a first cache of 32 KiB.
const BLOCK: usize = 256;

/// The blocks of `n` coordinates, for what passes over them several times: what they are read for stays in
/// the first cache meanwhile.
#[inline]
pub(crate) fn blocks(n: usize) -> impl Iterator<Item = Range<usize>> {
    (0..n).step_by(BLOCK).map(move |start| start..n.min(start + BLOCK))
}

/// Sets `sum` to x + Δ.
#[inline]
pub(crate) fn add<T: Real>(x: &[T], delta: &[T], sum: &mut [T]) {
    for ((sum, &x), &delta) in sum.iter_mut().zip(x).zip(delta) {
        *sum = x + delta;
    }
}

/// A kick of the momentum, p ← p + a F, or a drift of the point, q ← q + a v.
#[inline]
pub(crate) fn kick<T: Real>(p: &mut [T], a: T, force: &[T]) {
    for (p, &force) in p.iter_mut().zip(force) {
        *p += a * force;
    }
}

/// Multiplies the entries of `x` by a number.
#[inline]
pub(crate) fn multiply<T: Real>(x: &mut [T], by: T) {
    for x in x {
        *x *= by;
    }
}

/// Divides the entries of `x` by a number.
#[inline]
pub(crate) fn divide<T: Real>(x: &mut [T], by: T) {
    for x in x {
        *x /= by;
    }
}

/// Takes `change` from `x`.
#[inline]
pub(crate) fn subtract<T: Real>(x: &mut [T], change: &[T]) {
    for (x, &change) in x.iter_mut().zip(change) {
        *x -= change;
    }
}

/// Changes the signs of the entries of `x`.
#[inline]
pub(crate) fn negate<T: Real>(x: &mut [T]) {
    for x in x {
        *x = -*x;
    }
}

/// x·y.
pub(crate) fn dot<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::lift(0.0), |sum, (&x, &y)| sum + x * y)
}
