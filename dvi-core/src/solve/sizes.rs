//! The size of each coordinate in a step, |q| + |Δ|, in which its corrections are judged.
//!
//! Sizes go with the units of coordinates, and what is judged in them does not: units do not matter. They are those of
//! the guess; where a correction is as large as its coordinate, they are taken again. They are kept as weights, one over
//! the size of each coordinate.

use core::ops::DerefMut;

use crate::scalar::norm::{MANY, larger, largest_number};
use crate::scalar::{Lanes, smallest_normal};
use crate::{Real, Scalar};

/// What an iteration does first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Due {
    Nothing,
    /// It takes sizes.
    Sizes,
    /// It moves the unknowns.
    Shake,
}

/// One over `size`. Rounding errors of numbers below the smallest normal one are absolute.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn weight_of<T: Real>(size: T) -> T {
    T::lift(1.0) / (size + smallest_normal::<T>() / T::default_epsilon())
}

/// By so many times its size an unknown is moved.
const SHAKE: f64 = 1.0 / 65536.0;

impl Due {
    /// Prepares an iteration that improves the increment `delta` of `q`; whether that has been moved.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare<T: Real>(&mut self, weights: &mut [T], q: &[T], delta: &mut [T]) -> bool {
        let due = core::mem::replace(self, Self::Nothing);
        match due {
            Self::Nothing => {}
            Self::Sizes => {
                for ((weight, &q), &delta) in weights.iter_mut().zip(q).zip(delta.iter()) {
                    *weight = weight_of(Scalar::abs(q) + Scalar::abs(delta));
                }
            }
            Self::Shake => shake(weights, delta),
        }
        due == Self::Shake
    }

    /// The same where the unknown is `q1`, and Δ = q1 − q.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_end<T: Real>(&mut self, weights: &mut [T], q: &[T], q1: &mut [T]) {
        match core::mem::replace(self, Self::Nothing) {
            Self::Nothing => {}
            Self::Sizes => {
                for ((weight, &q), &q1) in weights.iter_mut().zip(q).zip(q1.iter()) {
                    *weight = weight_of(Scalar::abs(q) + Scalar::abs(q1 - q));
                }
            }
            Self::Shake => shake(weights, q1),
        }
    }

    /// The same where `x` is the unknown, and no increment.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_alone<T: Real>(&mut self, weights: &mut [T], x: &mut [T]) {
        match core::mem::replace(self, Self::Nothing) {
            Self::Nothing => {}
            Self::Sizes => {
                for (weight, &x) in weights.iter_mut().zip(x.iter()) {
                    *weight = weight_of(Scalar::abs(x));
                }
            }
            Self::Shake => shake(weights, x),
        }
    }

    /// The same of several unknowns for each coordinate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_all<T: Real, V: DerefMut<Target = [T]>>(
        &mut self,
        weights: &mut [T],
        q: &[T],
        unknowns: &mut [V],
    ) {
        match core::mem::replace(self, Self::Nothing) {
            Self::Nothing => {}
            Self::Sizes => {
                for (k, (weight, &q)) in weights.iter_mut().zip(q).enumerate() {
                    let sizes = unknowns.iter().map(|unknown| Scalar::abs(unknown[k]));
                    *weight = weight_of(Scalar::abs(q) + sizes.fold(T::lift(0.0), larger));
                }
            }
            Self::Shake => unknowns.iter_mut().for_each(|unknown| shake(weights, unknown)),
        }
    }
}

impl Due {
    /// The same of positions of several stages, in the lanes of packs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_places<const W: usize, T: Real>(
        &mut self,
        weights: &mut [T],
        q: &[T],
        places: &mut [Lanes<W, T>],
    ) {
        match core::mem::replace(self, Self::Nothing) {
            Self::Nothing => {}
            Self::Sizes => {
                for ((weight, &q), place) in weights.iter_mut().zip(q).zip(places.iter()) {
                    let ways = place.0.map(|place| place - q);
                    *weight = weight_of(Scalar::abs(q) + largest_number(&ways));
                }
            }
            Self::Shake => shake_packs(weights, places),
        }
    }

    /// The same of velocities of several stages, in a step of length `h`; weights are those of velocities then. Whether they have been moved.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_slopes<const W: usize, T: Real>(
        &mut self,
        weights: &mut [T],
        (q, h): (&[T], T),
        slopes: &mut [Lanes<W, T>],
    ) -> bool {
        let due = core::mem::replace(self, Self::Nothing);
        match due {
            Self::Nothing => {}
            Self::Sizes => {
                let h = Scalar::abs(h);
                for ((weight, &q), slope) in weights.iter_mut().zip(q).zip(slopes.iter()) {
                    *weight = h * weight_of(Scalar::abs(q) + h * largest_number(&slope.0));
                }
            }
            Self::Shake => shake_packs(weights, slopes),
        }
        due == Self::Shake
    }
}

#[cold]
fn shake_packs<const W: usize, T: Real>(weights: &[T], packs: &mut [Lanes<W, T>]) {
    for (k, (pack, &weight)) in packs.iter_mut().zip(weights).enumerate() {
        pack.0.iter_mut().enumerate().for_each(|(stage, x)| *x += shaken(W * k + stage, weight));
    }
}

/// Moves unknowns to and fro, without a pattern that an equation could have.
#[cold]
fn shake<T: Real>(weights: &[T], unknowns: &mut [T]) {
    unknowns.iter_mut().zip(weights).enumerate().for_each(|(k, (x, &weight))| *x += shaken(k, weight));
}

/// Sets changes of the unknowns to those by which they are moved.
#[cold]
pub(crate) fn set_shaken<T: Real>(weights: &[T], changes: &mut [T]) {
    changes
        .iter_mut()
        .zip(weights)
        .enumerate()
        .for_each(|(k, (change, &weight))| *change = shaken(k, weight));
}

/// By how much unknown `k` is moved: up or down by the leading bit of its multiple by the golden ratio (Knuth 1998, section 6.4).
fn shaken<T: Real>(k: usize, weight: T) -> T {
    let by = T::lift(SHAKE) / weight;
    if (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 63 == 0 { by } else { -by }
}

/// The size of the largest of several changes, one for each coordinate; one that is not a number does not count.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn largest<T: Real>(weights: &[T], changes: &[T]) -> T {
    let sizes = changes.iter().zip(weights);
    sizes.fold(T::lift(0.0), |largest, (&change, &weight)| larger(largest, Scalar::abs(change) * weight))
}

/// Takes `change` from the unknown `x`, and returns its size.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn reduce<T: Real>(weights: &[T], x: &mut [T], change: &[T]) -> T {
    for (x, &change) in x.iter_mut().zip(change) {
        *x -= change;
    }
    largest(weights, change)
}

/// Sets the unknown `x` to `new`, and returns the size of the largest change; one that is not a number does not count.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn renew<T: Real>(weights: &[T], x: &mut [T], new: &[T]) -> T {
    let one_by_one = |weights: &[T], x: &mut [T], new: &[T]| {
        x.iter_mut().zip(new).zip(weights).fold(T::lift(0.0), |largest, ((x, &new), &weight)| {
            let size = Scalar::abs(new - *x) * weight;
            *x = new;
            larger(largest, size)
        })
    };
    if x.len() < MANY {
        return one_by_one(weights, x, new);
    }
    let ((chunks, rest), (new_chunks, new_rest)) = (x.as_chunks_mut::<8>(), new.as_chunks::<8>());
    let (weight_chunks, weight_rest) = weights.as_chunks::<8>();
    let mut partial = [T::lift(0.0); 8];
    for ((chunk, new), weights) in chunks.iter_mut().zip(new_chunks).zip(weight_chunks) {
        for (lane, partial) in partial.iter_mut().enumerate() {
            *partial = larger(*partial, Scalar::abs(new[lane] - chunk[lane]) * weights[lane]);
            chunk[lane] = new[lane];
        }
    }
    partial.into_iter().fold(one_by_one(weight_rest, rest, new_rest), larger)
}
