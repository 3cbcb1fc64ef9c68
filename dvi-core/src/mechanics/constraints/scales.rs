//! Units in which the equations with multipliers have rows of about the same size.
//!
//! D = 1/√|Mⱼⱼ| for each coordinate and S = 1/|GD| for each constraint take away the units of coordinates
//! and of constraints. But a coordinate that is light against the others dominates all rows of G then, and
//! what these say of the others is lost in rounding. So D and S are balanced (Sinkhorn 1964):
//!
//! ```text
//! |Mⱼⱼ| Dⱼ² + Σₖ |Sₖ Gₖⱼ Dⱼ| = 1,   Σⱼ |Sₖ Gₖⱼ Dⱼ| = 1
//! ```
//!
//! The coordinate of a vanishing mass has the size that the constraints give it.

use super::{At, ConstrainedLagrangian, Constraints, Multipliers};
use crate::mechanics::pattern::mass_entries;
use crate::scalar::norm::reported;
use crate::{Real, Scalar, Space, Vector};

/// A scale that changes by no more than this factor is balanced.
const BALANCED: f64 = 1.25;

/// How often the scales are improved at most: in each round they change by a factor of two or so, and masses
/// differ by less than 10⁶⁰.
const ROUNDS: usize = 200;

/// Sets D and S, near (`q`, `v`, `t`).
pub(crate) fn balance<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    At { q, t }: At<'_, T>,
    v: &[T],
    (of_coordinates, of_constraints): (&mut [T], &mut [T]),
) {
    scale_coordinates(system, [q, v], t, of_coordinates);
    let mut values: Multipliers<S, T> = system.multipliers().vector();
    let mut squares = |k: usize, j: usize, entry: T| {
        let entry = entry * of_coordinates[j];
        of_constraints[k] += entry * entry;
    };
    S::Kind::forces(system, q, t, &mut values, &mut squares);
    of_constraints.iter_mut().for_each(|square| *square = scale(*square));
    // In units in which the mass is one.
    let [mut unit, mut sums]: [Vector<S, T>; 2] = system.space().vectors();
    unit.copy_from_slice(of_coordinates);
    let mut totals: Multipliers<S, T> = system.multipliers().vector();
    for _ in 0..ROUNDS {
        sums.fill(T::lift(0.0));
        let mut columns = |k: usize, j: usize, entry: T| {
            sums[j] += Scalar::abs(entry) * of_constraints[k] * unit[j];
        };
        S::Kind::forces(system, q, t, &mut values, &mut columns);
        let mut is_balanced = true;
        for ((scale, &unit), &sum) in of_coordinates.iter_mut().zip(unit.iter()).zip(sums.iter()) {
            // x² + x Σ = 1
            let root = Scalar::sqrt(sum * sum + T::lift(4.0));
            is_balanced &= change(scale, unit * T::lift(2.0) / (sum + root));
        }
        totals.fill(T::lift(0.0));
        let mut rows = |k: usize, j: usize, entry: T| {
            totals[k] += Scalar::abs(entry) * of_coordinates[j];
        };
        S::Kind::forces(system, q, t, &mut values, &mut rows);
        for (scale, &total) in of_constraints.iter_mut().zip(totals.iter()) {
            is_balanced &= change(scale, T::lift(1.0) / total);
        }
        if is_balanced {
            break;
        }
    }
}

/// Sets a scale to another one, if that is a positive number, without derivatives; whether it was about the
/// same.
fn change<T: Real>(scale: &mut T, other: T) -> bool {
    let other = T::lift(reported(other));
    if !(other > T::lift(0.0) && other.is_finite()) {
        return true;
    }
    let ratio = reported(other / *scale);
    *scale = other;
    ratio < BALANCED && ratio * BALANCED > 1.0
}

/// Sets `scales` to 1/√|Mⱼⱼ|.
pub(crate) fn scale_coordinates<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    at: [&[T]; 2],
    t: T,
    scales: &mut [T],
) {
    mass_entries(system, at, t, |i, j, entry| {
        if i == j {
            scales[i] += entry;
        }
    });
    scales.iter_mut().for_each(|mass| *mass = scale(Scalar::abs(*mass)));
}

/// 1/√`square`; one where that is no positive number, which says nothing of units. It carries no
/// derivatives.
fn scale<T: Real>(square: T) -> T {
    let scale = T::lift(1.0) / Scalar::sqrt(T::lift(reported(square)));
    let is_usable = scale > T::lift(0.0) && scale.is_finite();
    if is_usable { scale } else { T::lift(1.0) }
}
