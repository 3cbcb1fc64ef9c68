//! One axis of a grid: the points at which a table has values.

use alloc::vec::Vec;

use super::SplineError;

/// A last point of a periodic axis that is closer to the end of the period than this part of the mean
/// distance of the points is refused.
const CLOSE: f64 = 1e-2;

/// The points of a grid along one variable, strictly increasing, and the period of a variable in which the
/// table is periodic.
///
/// ```
/// use dvi_core::field::Axis;
///
/// let radius = Axis::new(&[1.0, 1.5, 2.5, 4.0])?;
/// let height = Axis::uniform([-1.0, 1.0], 5)?;
/// let angle = Axis::periodic(&[0.0, 90.0, 180.0, 270.0], 360.0)?;
/// assert_eq!(height.points(), [-1.0, -0.5, 0.0, 0.5, 1.0]);
/// assert_eq!((radius.period(), angle.period()), (None, Some(360.0)));
/// # Ok::<(), dvi_core::field::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    points: Vec<f64>,
    period: Option<f64>,
}

impl Axis {
    /// An axis with these points, from the first to the last.
    ///
    /// # Errors
    /// [`SplineError::Point`], [`SplineError::NotIncreasing`] and [`SplineError::Distance`]. How many points
    /// there must be is asked by the spline that is made on them.
    pub fn new(points: &[f64]) -> Result<Self, SplineError> {
        if let Some(index) = points.iter().position(|x| !x.is_finite()) {
            return Err(SplineError::Point { index, value: points[index] });
        }
        for (i, pair) in points.windows(2).enumerate() {
            let (before, after) = (pair[0], pair[1]);
            if before >= after {
                return Err(SplineError::NotIncreasing { index: i + 1, before, after });
            }
            if !is_usable(after - before) {
                return Err(SplineError::Distance { index: i + 1, before, after });
            }
        }
        if let (Some(&before), Some(&after)) = (points.first(), points.last())
            && !(after - before).is_finite()
        {
            return Err(SplineError::Distance { index: points.len() - 1, before, after });
        }
        Ok(Self { points: points.to_vec(), period: None })
    }

    /// An axis of `count` points at equal distances, with both ends.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn uniform([from, to]: [f64; 2], count: usize) -> Result<Self, SplineError> {
        let last = count.saturating_sub(1).max(1);
        // The ends are met exactly, and halves of large numbers do not overflow.
        let (start, length) = (0.5 * from, 0.5 * to - 0.5 * from);
        let point = |i: usize| match i {
            0 => from,
            _ if i == last => to,
            _ => 2.0 * (start + i as f64 / last as f64 * length),
        };
        Self::new(&(0..count).map(point).collect::<Vec<f64>>())
    }

    /// An axis on which the table repeats itself with the given period.
    ///
    /// The points are those of one period, without its end, where the table has the values of the first
    /// point again: the last one is at least a hundredth of the mean distance away from the end.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and [`SplineError::Period`].
    pub fn periodic(points: &[f64], period: f64) -> Result<Self, SplineError> {
        let axis = Self::new(points)?;
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
            return Ok(Self { period: Some(period), ..axis });
        };
        // The splines continue the points by less than one period on either side.
        let is_length = period > 0.0 && (first - period).is_finite() && (first + 2.0 * period).is_finite();
        let (steps, gap) = (points.len() - 1, first + period - last);
        let mean = if steps == 0 { period } else { (last - first) / steps as f64 };
        if is_length && gap >= CLOSE * mean && is_usable(gap) {
            Ok(Self { period: Some(period), ..axis })
        } else {
            Err(SplineError::Period { period, first, last })
        }
    }

    /// The points: a table has a value at each of them.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// The period, if the axis has one.
    pub fn period(&self) -> Option<f64> {
        self.period
    }
}

/// Whether second derivatives over a distance can be represented.
fn is_usable(distance: f64) -> bool {
    let curvature = 1.0 / (distance * distance);
    distance.is_finite() && curvature.is_finite() && curvature > 0.0
}
