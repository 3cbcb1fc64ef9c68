//! What a velocity leaves of its constraints, A v + b or G v + ∂g/∂t, and how much of that may be rounding.
//!
//! Velocities are rounded relative to the largest of those that a constraint couples, in the
//! [units](super::scales) in which they have about the same weight in it. Coordinates are rounded too: those
//! of a system far from the origin of its coordinates have few digits for its shape. What changes if
//! coordinates and the time change by a few rounding errors is rounding too. All coordinates are changed at
//! once, with the signs that the digits of their numbers have in base two, so that the changes of no two of
//! them cancel in all cases.

use super::{At, ConstrainedLagrangian, Constraints, Multipliers};
use crate::scalar::norm::{larger, largest, reported};
use crate::scalar::smallest_normal;
use crate::{ConstrainedSystem, Real, Scalar, Space, Vector};

/// A state may be off the constraints by so many rounding errors.
pub(super) const ROUNDINGS: f64 = 1e4;

/// The constraint whose value is farthest from zero, of those that are by more than `limit` times their size,
/// and the value.
pub(super) fn farthest<T: Real>(values: &[T], sizes: &[T], limit: f64) -> Option<(usize, f64)> {
    let values =
        values.iter().zip(sizes).map(|(&value, &size)| (reported(value), reported(size))).enumerate();
    let off = values.map(|(constraint, (value, size))| {
        (constraint, value, if value.is_finite() { value.abs() / size } else { f64::INFINITY })
    });
    // The first of several.
    let farther =
        |known: (usize, f64, f64), other: (usize, f64, f64)| if other.2 > known.2 { other } else { known };
    off.filter(|(_, _, off)| *off > limit).reduce(farther).map(|(constraint, value, _)| (constraint, value))
}

/// What is left of the constraints of a velocity.
#[derive(Debug)]
pub(crate) struct Residuals<S: ConstrainedSystem, T: Real> {
    values: Multipliers<S, T>,
    /// What rounding errors are relative to.
    sizes: Multipliers<S, T>,
    /// The values near by, or the largest velocities.
    others: Multipliers<S, T>,
    point: Vector<S, T>,
    /// The largest value before the last correction.
    before: Option<T>,
}

/// A velocity that leaves no more than so many rounding errors of its constraints keeps them.
const KEPT: f64 = 16.0;

impl<S: ConstrainedLagrangian<T>, T: Real> Residuals<S, T> {
    pub(crate) fn new(system: &S) -> Self {
        let [values, sizes, others] = system.multipliers().vectors();
        Self { values, sizes, others, point: system.space().vector(), before: None }
    }

    /// Looks at a velocity, in units D of the coordinates. Its entries are rounded relative to `scale`, or
    /// to the smallest normal number.
    pub(crate) fn evaluate(
        &mut self,
        system: &S,
        At { q, t }: At<'_, T>,
        v: &[T],
        units: &[T],
        scale: impl Fn(usize) -> T,
    ) {
        let Self { values, sizes, others: speeds, .. } = self;
        sizes.fill(T::lift(0.0));
        speeds.fill(T::lift(0.0));
        let mut terms = |k: usize, j: usize, entry: T| {
            sizes[k] += Scalar::abs(entry) * units[j];
            speeds[k] = larger(speeds[k], (scale(j) + smallest_normal()) / units[j]);
        };
        S::Kind::of_velocity(system, q, v, t, values, &mut terms);
        for (size, &speed) in sizes.iter_mut().zip(speeds.iter()) {
            *size *= speed;
        }
    }

    /// Whether all are at most so many rounding errors of the terms.
    fn are_within(&self, roundings: f64) -> bool {
        let rounding = T::lift(roundings) * T::default_epsilon();
        self.values
            .iter()
            .zip(self.sizes.iter())
            .all(|(&value, &size)| Scalar::abs(value) <= rounding * size)
    }

    /// Whether there is nothing left to correct: the constraints are kept, or a correction has not even
    /// halved what is left.
    pub(crate) fn are_settled(&mut self) -> bool {
        let size = largest(&self.values);
        let shrinks = self.before.is_none_or(|before| size < T::lift(0.5) * before);
        let is_settled = self.are_within(KEPT) || !shrinks;
        self.before = if is_settled { None } else { Some(size) };
        is_settled
    }

    /// The constraint that is farthest from being kept, of those that are off by more than rounding errors,
    /// and its value.
    pub(crate) fn worst(&mut self, system: &S, at: At<'_, T>, v: &[T]) -> Option<(usize, f64)> {
        if self.are_within(ROUNDINGS) {
            return None;
        }
        self.widen(system, at, v);
        farthest(&self.values, &self.sizes, ROUNDINGS * reported(T::default_epsilon()))
    }

    /// Lets sizes know of the rounding of coordinates and of the time.
    #[cold]
    fn widen(&mut self, system: &S, At { q, t }: At<'_, T>, v: &[T]) {
        let Self { values, sizes, others, point, .. } = self;
        let rounding = T::lift(ROUNDINGS) * T::default_epsilon();
        let digits = usize::BITS - q.len().leading_zeros();
        // The time, all coordinates, and each digit of their numbers.
        for change in 0..digits + 2 {
            let is_time = change == digits + 1;
            for (j, (point, &q)) in point.iter_mut().zip(q).enumerate() {
                let is_set = change == digits || j >> change & 1 == 1;
                let by = if is_set { rounding } else { -rounding };
                *point = if is_time { q } else { q + q * by };
            }
            let time = if is_time { t + t * rounding } else { t };
            S::Kind::of_velocity(system, point, v, time, others, &mut |_, _, _: T| ());
            for ((size, &other), &value) in sizes.iter_mut().zip(others.iter()).zip(values.iter()) {
                *size = larger(*size, Scalar::abs(other - value) / rounding);
            }
        }
    }
}
