//! The sizes of coordinates in a step, in which their corrections are judged.
//!
//! The coordinates of a block, `x[n]` or `r[n][3]`, have one unit, and one size: the largest |q| + |Δ| among
//! them. So what is next to nothing beside its neighbours, as where a wave has not arrived yet, is no task
//! of its own. Sizes go with the units of blocks, and what is judged in them does not: units do not matter.
//! They are those of the guess; where a correction is as large as its block, they are taken again. They are
//! kept as weights, one over the size of each coordinate.

use core::ops::{DerefMut, Range};

use crate::scalar::norm::{MANY, larger, largest_number};
use crate::scalar::passes::{lanes_stay_together, subtract};
use crate::scalar::{Lanes, smallest_normal};
use crate::{Real, Report, Scalar, System};

/// What an iteration does first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Due {
    Nothing,
    /// It takes sizes.
    Sizes,
    /// It moves the unknowns, and keeps where they were in the place of the weights.
    Shake,
    /// It takes sizes with 2¹⁶ times what the unknowns have responded.
    Response,
    /// It finds the residual, and no correction.
    Residual,
}

/// One over `size`. Rounding errors of numbers below the smallest normal one are absolute.
#[inline]
pub(crate) fn weight_of<T: Real>(size: T) -> T {
    T::lift(1.0) / (size + smallest_normal::<T>())
}

/// The coordinates of each block, all components of vectors together.
#[inline]
pub(crate) fn blocks<S: System>(system: &S) -> Blocks<'_, S> {
    Blocks { system, block: 0, end: 0 }
}

/// Stands before a block, whose first coordinate is `end`.
pub(crate) struct Blocks<'a, S> {
    system: &'a S,
    block: usize,
    end: usize,
}

impl<S: System> Iterator for Blocks<'_, S> {
    type Item = Range<usize>;

    #[inline]
    fn next(&mut self) -> Option<Range<usize>> {
        let (declared, begin) = (S::REPORT.coordinates.get(self.block)?, self.end);
        // The loop over blocks asks for components where there are vectors only.
        let axis = if const { has_vectors(&S::REPORT) } { declared.axis } else { None };
        let components = axis.map_or(1, |axis| usize::from(axis.of));
        self.end += components * self.system.block_len(self.block);
        self.block += components;
        Some(begin..self.end)
    }
}

const fn has_vectors(report: &Report) -> bool {
    let mut block = 0;
    while block < report.coordinates.len() {
        if report.coordinates[block].axis.is_some() {
            return true;
        }
        block += 1;
    }
    false
}

/// Sets the weights of all coordinates of each block to that of the largest `size` in it, times `unit`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn set_weights<S: System, T: Real>(
    system: &S,
    (weights, unit): (&mut [T], T),
    size: impl Fn(usize, T) -> T,
) {
    for block in blocks(system) {
        let weights = &mut weights[block.clone()];
        for (weight, k) in weights.iter_mut().zip(block) {
            *weight = size(k, *weight);
        }
        // Of what is no number the end of a step takes care.
        let largest = largest_number(weights);
        weights.fill(unit * weight_of(largest));
    }
}

/// By so many times its size an unknown is moved.
const SHAKE: f64 = 1.0 / 65536.0;

impl Due {
    /// Prepares an iteration that improves the increment `delta` of `q`, or its end q + Δ in the place of
    /// `delta`; whether that has been moved.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare<S: System, T: Real>(
        &mut self,
        system: &S,
        weights: &mut [T],
        q: &[T],
        delta: &mut [T],
    ) -> bool {
        let q = &q[..delta.len()];
        let size = |k: usize, &delta: &T| Scalar::abs(q[k]) + Scalar::abs(delta);
        self.carry_out(system, (weights, T::lift(1.0)), size, delta)
    }

    /// The same where `x` is the unknown, and no increment.
    #[inline]
    pub(crate) fn prepare_alone<S: System, T: Real>(&mut self, system: &S, weights: &mut [T], x: &mut [T]) {
        self.carry_out(system, (weights, T::lift(1.0)), |_, &x: &T| Scalar::abs(x), x);
    }

    /// The same of several unknowns for each coordinate, of which the last is the one that responds.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn prepare_all<S: System, T: Real, V: DerefMut<Target = [T]>>(
        &mut self,
        system: &S,
        weights: &mut [T],
        q: &[T],
        unknowns: &mut [V],
    ) {
        let Some((last, others)) = unknowns.split_last_mut() else { return };
        if *self == Self::Shake {
            for unknown in others.iter_mut() {
                unknown
                    .iter_mut()
                    .zip(weights.iter())
                    .enumerate()
                    .for_each(|(k, (x, &weight))| *x += shaken(k, weight));
            }
        }
        let size = |k: usize, &last: &T| {
            let sizes = others.iter().map(|unknown| Scalar::abs(unknown[k]));
            Scalar::abs(q[k]) + sizes.fold(Scalar::abs(last), larger)
        };
        self.carry_out(system, (weights, T::lift(1.0)), size, last);
    }

    /// The same of positions of several stages, in the lanes of packs.
    #[inline]
    pub(crate) fn prepare_places<const W: usize, S: System, T: Real>(
        &mut self,
        system: &S,
        weights: &mut [T],
        q: &[T],
        places: &mut [Lanes<W, T>],
    ) {
        let size = |k: usize, place: &Lanes<W, T>| {
            lanes_stay_together::<Lanes<W, T>>();
            Scalar::abs(q[k]) + Scalar::abs(*place - Lanes::all(q[k])).largest()
        };
        self.carry_out(system, (weights, T::lift(1.0)), size, places);
    }

    /// The same of velocities of several stages, in a step of length `h`; weights are those of velocities
    /// then. Whether they have been moved.
    #[inline]
    pub(crate) fn prepare_slopes<const W: usize, S: System, T: Real>(
        &mut self,
        system: &S,
        weights: &mut [T],
        (q, h): (&[T], T),
        slopes: &mut [Lanes<W, T>],
    ) -> bool {
        let h = Scalar::abs(h);
        let size = |k: usize, slope: &Lanes<W, T>| {
            lanes_stay_together::<Lanes<W, T>>();
            Scalar::abs(q[k]) + h * Scalar::abs(*slope).largest()
        };
        self.carry_out(system, (weights, h), size, slopes)
    }

    /// Does what is due with the unknowns of each coordinate, whose `size` is that of coordinate k where
    /// they have these values, in units of coordinates over `unit`; whether it moves them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn carry_out<S: System, T: Real, X: Unknowns<T>>(
        &mut self,
        system: &S,
        (weights, unit): (&mut [T], T),
        size: impl Fn(usize, &X) -> T,
        x: &mut [X],
    ) -> bool {
        if *self != Self::Sizes {
            return *self != Self::Nothing && self.test(system, (weights, unit), size, x);
        }
        set_weights(system, (&mut weights[..x.len()], unit), |k, _| size(k, &x[k]));
        *self = Self::Nothing;
        false
    }

    /// The same where the iterate is put to the test.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn test<S: System, T: Real, X: Unknowns<T>>(
        &mut self,
        system: &S,
        (weights, unit): (&mut [T], T),
        size: impl Fn(usize, &X) -> T,
        x: &mut [X],
    ) -> bool {
        match *self {
            // The iteration itself answers that.
            Self::Residual => return false,
            Self::Nothing | Self::Sizes => {}
            Self::Shake => {
                for (k, (x, weight)) in x.iter_mut().zip(weights).enumerate() {
                    let kept = x.last();
                    x.add(|lane| shaken(X::COUNT * k + lane, *weight));
                    *weight = kept;
                }
            }
            Self::Response => set_weights(system, (weights, unit), |k, kept| {
                size(k, &x[k]) + unit * Scalar::abs(x[k].last() - kept) / T::lift(SHAKE)
            }),
        }
        core::mem::replace(self, Self::Nothing) == Self::Shake
    }
}

/// The unknowns of a coordinate: a number, or one in each lane of a pack.
trait Unknowns<T> {
    const COUNT: usize;
    /// The one that responds where they are moved.
    fn last(&self) -> T;
    fn add(&mut self, by: impl Fn(usize) -> T);
}

impl<T: Real> Unknowns<T> for T {
    const COUNT: usize = 1;
    #[inline]
    fn last(&self) -> T {
        *self
    }
    #[inline]
    fn add(&mut self, by: impl Fn(usize) -> T) {
        *self += by(0);
    }
}

impl<const W: usize, T: Real> Unknowns<T> for Lanes<W, T> {
    const COUNT: usize = W;
    #[inline]
    fn last(&self) -> T {
        self.0[W - 1]
    }
    #[inline]
    fn add(&mut self, by: impl Fn(usize) -> T) {
        self.0.iter_mut().enumerate().for_each(|(lane, x)| *x += by(lane));
    }
}

/// By how much unknown `k` is moved: up or down by the leading bit of its multiple by the golden ratio
/// (Knuth 1998, section 6.4).
fn shaken<T: Real>(k: usize, weight: T) -> T {
    let by = T::lift(SHAKE) / weight;
    if (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 63 == 0 { by } else { -by }
}

/// The size of the largest of several changes, one for each coordinate; one that is not a number does not
/// count.
#[inline]
pub(crate) fn largest<T: Real>(weights: &[T], changes: &[T]) -> T {
    let sizes = changes.iter().zip(weights);
    sizes.fold(T::lift(0.0), |largest, (&change, &weight)| larger(largest, Scalar::abs(change) * weight))
}

/// Takes `change` from the unknown `x`, and returns its size.
#[inline]
pub(crate) fn reduce<S: System, T: Real>(system: &S, weights: &[T], x: &mut [T], change: &[T]) -> T {
    subtract(x, change);
    larger(T::lift(0.0), size_of(system, weights, change))
}

/// The size of a change of all coordinates, of which those of a block have one weight. No zero is among what
/// is compared, which saves RATTLE 2 of 279 instructions; so a first change that is not a number counts.
#[inline]
pub(crate) fn size_of<S: System, T: Real>(system: &S, weights: &[T], change: &[T]) -> T {
    let mut largest = None;
    for block in blocks(system) {
        if let Some(&weight) = weights.get(block.start) {
            let size = weight * largest_number(&change[block]);
            largest = Some(match largest {
                None => size,
                Some(largest) => larger(largest, size),
            });
        }
    }
    largest.unwrap_or(T::lift(0.0))
}

/// By which [`improve`] adds a change.
#[inline]
pub(crate) fn added<T: Real>(x: &mut T, change: T) -> T {
    *x += change;
    change
}

/// By which [`improve`] takes a new number.
#[inline]
pub(crate) fn replaced<T: Real>(x: &mut T, new: T) -> T {
    new - core::mem::replace(x, new)
}

/// Improves each unknown by a number, and returns the size of the largest change: eight that do not wait for
/// one another if there are many. A change that is not a number does not count.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn improve<T: Real>(weights: &[T], x: &mut [T], by: &[T], one: impl Fn(&mut T, T) -> T) -> T {
    let one_by_one = |weights: &[T], x: &mut [T], by: &[T]| {
        x.iter_mut().zip(by).zip(weights).fold(T::lift(0.0), |largest, ((x, &by), &weight)| {
            larger(largest, Scalar::abs(one(x, by)) * weight)
        })
    };
    if x.len() < MANY {
        return one_by_one(weights, x, by);
    }
    let ((chunks, rest), (by_chunks, by_rest)) = (x.as_chunks_mut::<8>(), by.as_chunks::<8>());
    let (weight_chunks, weight_rest) = weights.as_chunks::<8>();
    let mut partial = [T::lift(0.0); 8];
    for ((chunk, by), weights) in chunks.iter_mut().zip(by_chunks).zip(weight_chunks) {
        // What is read before anything is written is read at once.
        let (mut x, by, weights) = (*chunk, *by, *weights);
        for (lane, partial) in partial.iter_mut().enumerate() {
            *partial = larger(*partial, Scalar::abs(one(&mut x[lane], by[lane])) * weights[lane]);
        }
        *chunk = x;
    }
    partial.into_iter().fold(one_by_one(weight_rest, rest, by_rest), larger)
}
