//! A function x ↦ x in the formulas of some systems that is no number in the `count`-th of its
//! evaluations from now, whichever stage or iteration of a step that falls in, and in the next ones.

use core::cell::Cell;

use dvi_core::Scalar;

thread_local! {
    static LEFT: Cell<Option<[u64; 2]>> = const { Cell::new(None) };
}

/// Blows in the `count`-th evaluation from now on this thread, counted from 0, and in as many as
/// `lasting` after it.
pub fn set(count: u64, lasting: u64) {
    LEFT.set(Some([count, lasting]));
}

/// Takes the fuse out; whether it had not blown.
pub fn take() -> bool {
    LEFT.take().is_some_and(|[count, _]| count > 0)
}

/// x, or no number.
pub(super) fn value<T: Scalar>(x: T) -> T {
    match LEFT.get() {
        Some([0, lasting]) => {
            LEFT.set(lasting.checked_sub(1).map(|lasting| [0, lasting]));
            T::lift(f64::NAN)
        }
        Some([count, lasting]) => {
            LEFT.set(Some([count - 1, lasting]));
            x
        }
        None => x,
    }
}

/// 1, or no number.
pub(super) fn slope<T: Scalar>(_x: T) -> T {
    value(T::lift(1.0))
}

/// 0, or no number.
pub(super) fn curvature<T: Scalar>(_x: T) -> T {
    value(T::lift(0.0))
}
