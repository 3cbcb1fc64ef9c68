//! The table that a spline goes through: a value for each point of a grid.

use alloc::vec::Vec;

use thiserror::Error;

use super::Axis;

crate::error::said!(SplineError);

/// The number of points of a grid.
pub(super) fn points(axes: &[Axis]) -> Result<usize, SplineError> {
    let product = |points: usize, axis: &Axis| points.checked_mul(axis.points().len());
    axes.iter().try_fold(1, product).ok_or(SplineError::Size)
}

pub(super) fn sampled<const D: usize>(
    axes: &[Axis; D],
    mut function: impl FnMut([f64; D]) -> f64,
) -> Result<Vec<f64>, SplineError> {
    let count = points(axes)?;
    let mut values = Vec::new();
    values.try_reserve(count).map_err(|_| SplineError::Size)?;
    values.extend((0..count).map(|index| function(point(axes, index))));
    Ok(values)
}

/// The point of the grid at which a value of the table stands.
fn point<const D: usize>(axes: &[Axis; D], mut index: usize) -> [f64; D] {
    let mut point = [0.0; D];
    for (x, axis) in point.iter_mut().zip(axes).rev() {
        *x = axis.points()[index % axis.points().len()];
        index /= axis.points().len();
    }
    point
}

/// An axis, or a table, that no spline can be made of.
///
/// ```
/// use dvi_core::field::{Axis, Spline, SplineError};
///
/// let few = Axis::uniform([0.0, 1.0], 3)?;
/// let Err(error) = Spline::<1>::new([few], &[0.0, 1.0, 0.0]) else { panic!("a cubic takes four points") };
/// assert!(matches!(error, SplineError::TooFewPoints { found: 3, expected: 4, .. }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SplineError {
    /// A point is infinite or not a number.
    #[error("point {index} of the axis is {value}, and a finite number is expected")]
    Point {
        /// The point, counted from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A point is not larger than the one before it.
    #[error(
        "point {index} of the axis is {after} and the one before it is {before}, and an increase is expected"
    )]
    NotIncreasing {
        /// The second of the two points, counted from 0.
        index: usize,
        /// The first of them.
        before: f64,
        /// The second.
        after: f64,
    },
    /// Two points are so close to each other or so far apart that the square of their distance, or its
    /// reciprocal, cannot be represented.
    #[error(
        "point {index} of the axis is {after:e} after {before:e}, a distance whose square is out of range"
    )]
    Distance {
        /// The second of the two points, counted from 0.
        index: usize,
        /// The first of them.
        before: f64,
        /// The second.
        after: f64,
    },
    /// The points are not those of one period.
    #[error(
        "the period {period} does not go with points from {first} to {last}: the last point is expected clearly before \
         the first one plus the period, which is left out"
    )]
    Period {
        /// The period.
        period: f64,
        /// The first point.
        first: f64,
        /// The last point.
        last: f64,
    },
    /// An axis has fewer points than the degree asks for.
    #[error("axis {axis} has {found} points, and at least {expected} are expected")]
    TooFewPoints {
        /// The axis, counted from 0.
        axis: usize,
        /// Its points.
        found: usize,
        /// The degree plus one.
        expected: usize,
    },
    /// There is not one value for each point of the grid.
    #[error("the table has {found} values, and the grid has {expected} points")]
    Count {
        /// The values.
        found: usize,
        /// The points of the grid.
        expected: usize,
    },
    /// A value is infinite or not a number.
    #[error("value {index} of the table is {value}, and a finite number is expected")]
    NotFinite {
        /// Where it stands in the table, counted from 0.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Distances on the axes differ so much that rounding errors of the values would be enlarged more than
    /// 10⁸ times.
    #[error(
        "points {} and {index} of axis {axis}, {before:e} and {after:e}, are too close beside their \
         neighbours: rounding errors of the values would be enlarged {growth:.1e} times, and 1e8 times is \
         allowed; leave out one of them",
        .index - 1
    )]
    Unequal {
        /// The axis, counted from 0.
        axis: usize,
        /// The second of the two points on it whose distance is the smallest part of one beside it, counted
        /// from 0.
        index: usize,
        /// The first of them.
        before: f64,
        /// The second.
        after: f64,
        /// The factor, of all axes together.
        growth: f64,
    },
    /// A coefficient became infinite or not a number: the values are too large, or the distances on an axis
    /// too unequal.
    #[error(
        "a coefficient of the spline is not finite: the values are too large or the distances on an axis too unequal"
    )]
    Overflow,
    /// The grid has more points than there can be memory for.
    #[error("the grid has more points than there can be memory for")]
    Size,
}
