//! Times at which steps end, as a list in ascending order.

use crate::{Real, Scalar};

/// How many of `breaks` are before `t`, and how many are no more than rounding after it.
fn around<T: Real>(breaks: &[f64], t: T) -> [usize; 2] {
    let near = T::lift(2.0) * T::default_epsilon() * Scalar::abs(t);
    let before = breaks.partition_point(|&time| T::lift(time) < t - near);
    [before, breaks.partition_point(|&time| T::lift(time) <= t + near)]
}

/// The first time of `breaks` behind `t`, in the direction of `h`. One that is nearer than rounding has been
/// reached.
pub(super) fn next<T: Real>(breaks: &[f64], t: T, h: T) -> Option<T> {
    let [before, until] = around(breaks, t);
    let next = if h > T::lift(0.0) { until } else { before.checked_sub(1)? };
    breaks.get(next).map(|&time| T::lift(time))
}

/// A step from time `t` of length `h` that is shorter by rounding where it begins or ends at one of
/// `breaks`, so that it sees one side of it.
pub(super) fn between<T: Real>(breaks: &[f64], [t, h]: [T; 2]) -> [T; 2] {
    let inset = |time: T| {
        let [before, until] = around(breaks, time);
        let rounding = T::lift(8.0) * T::default_epsilon() * (Scalar::abs(time / h) + T::lift(1.0));
        let part = if before == until { T::lift(0.0) } else { rounding };
        h * if part < T::lift(0.125) { part } else { T::lift(0.125) }
    };
    let [first, last] = [inset(t), inset(t + h)];
    [t + first, h - (first + last)]
}

/// The first time that is not finite, or before the one before it.
pub(super) fn misplaced(breaks: &[f64]) -> Option<f64> {
    let mut before = f64::MIN;
    breaks.iter().copied().find(|&time| {
        let is_misplaced = !(time >= before && time.is_finite());
        before = time;
        is_misplaced
    })
}
