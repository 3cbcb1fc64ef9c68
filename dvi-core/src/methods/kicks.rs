//! What explicit schemes are made of.

use crate::Real;

/// A kick of the momentum, p ← p + a F, or a drift of the point, q ← q + a v.
pub(super) fn kick<T: Real>(p: &mut [T], a: T, force: &[T]) {
    for (p, &force) in p.iter_mut().zip(force) {
        *p += a * force;
    }
}
