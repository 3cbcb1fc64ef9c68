//! What the error of a step may be, and the error that a method estimates in these units.

use crate::error::StartError;
use crate::scalar::norm::{larger, reported};
use crate::{Real, Scalar};

/// The error that a step may have: in a coordinate qⱼ absolute + relative |qⱼ|, and in a momentum relative ·
/// max|p|.
///
/// Momenta are small where masses are, and have other units than coordinates; so their error is compared
/// with the largest momentum of the last steps, with that which the step adds; from rest, with that which
/// its force would make in a step of the usual length.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let end = |relative| -> Result<PendulumState, Box<dyn std::error::Error>> {
///     let tolerance = Tolerance { relative, absolute: 1e-3 * relative };
///     let control = ErrorControl { tolerance, ..ErrorControl::new(1e-9, 0.1) };
///     let mut run = Integrator::controlled(&Pendulum, Gauss::<4>::new(), control, start.clone())?;
///     run.advance_to(10.0)?;
///     Ok(run.state())
/// };
/// let [coarse, fine] = [end(1e-8)?, end(1e-12)?];
/// assert!((coarse.angle - fine.angle).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// In units of the numbers, and no less than their rounding, 2.3 · 10⁻¹⁶ in double precision.
    pub relative: f64,
    /// In the units of the coordinates; zero or positive. Zero asks for the digits of a coordinate that is
    /// zero but for rounding errors, which no step gives.
    pub absolute: f64,
}

impl Tolerance {
    /// Whether both are in range.
    pub(crate) fn validate<T: Real>(self) -> Result<(), StartError> {
        let Self { relative, absolute } = self;
        let in_range = relative >= reported(T::default_epsilon()) && relative.is_finite();
        let range = "finite, and at least the rounding of the numbers";
        StartError::unless(in_range, "relative", relative, range)?;
        let in_range = absolute >= 0.0 && absolute.is_finite();
        StartError::unless(in_range, "absolute", absolute, "zero or positive, and finite")
    }

    /// What is allowed in a coordinate of this size.
    pub(crate) fn of_coordinate<T: Real>(self, size: T) -> T {
        T::lift(self.absolute) + T::lift(self.relative) * size
    }
}

/// |x|/w, where `allowed` = w; no error is within every tolerance, also that of zero.
pub(crate) fn in_units_of<T: Real>(error: T, allowed: T) -> T {
    let (zero, size) = (T::lift(0.0), Scalar::abs(error));
    if size > zero { larger(zero, size / allowed) } else { zero }
}
