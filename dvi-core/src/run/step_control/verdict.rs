//! What [`ErrorControl`] says of a step that has been taken.

use super::seams::{AtSeam, Seams};
use super::{ControlledRun, ErrorControl, breaks};
use crate::error::StepFailure;
use crate::methods::Method;
use crate::scalar::norm::{larger, reported};
use crate::{Lagrangian, Real, Scalar};

/// a: the part of the tolerance that the next step aims at, for each number of stages the same.
const AIM: f64 = 0.02;
/// A step is at least and at most so many times as long as the one before.
pub(super) const FACTORS: [f64; 2] = [0.2, 2.0];
/// A step that comes out behind a seam at another solution than before it is tried again with this part of
/// its length.
const AGAIN: f64 = 0.5;

/// What is said of a step that has been taken.
pub(super) enum Verdict<T> {
    Accepted {
        error: T,
        at_seam: Option<AtSeam<T>>,
    },
    /// A step of the length times `factor` is tried next. Where that ends with steps that are too short,
    /// `failure` tells why, or the failure before it.
    TooLong {
        factor: T,
        failure: Option<StepFailure>,
    },
}

impl ErrorControl<'_> {
    /// A step of length `h`, or the longest there may be.
    pub(super) fn at_most_longest<T: Real>(&self, h: T) -> T {
        let longest = T::lift(self.longest_step);
        larger(-longest, -larger(-longest, -h))
    }

    /// What is to be said of the step from time `t` of length `h`, where steps usually have another. One
    /// that is accepted at a seam ends behind it.
    pub(super) fn judge<S: Lagrangian<T>, M: Method<S, T>, T: Real>(
        &self,
        run: &mut ControlledRun<'_, S, M, T>,
        seams: &mut Option<&mut Seams<S, T>>,
        t: T,
        [h, usual]: [T; 2],
    ) -> Result<Verdict<T>, StepFailure> {
        let at_seam = seams
            .as_mut()
            .map_or(Ok(None), |seams| seams.end(run, h, breaks::between(self.breaks, [t, h])[0] != t))?;
        let judged = at_seam.map_or(h, |AtSeam { before, .. }| before);
        if let Some(seams) = seams
            && t + judged != t
            && let Some(part) = seams.second_turn(run, judged)
        {
            return Ok(Verdict::TooLong { factor: part * (judged / h), failure: None });
        }
        let [start, length] = breaks::between(self.breaks, [t, judged]);
        let error = match at_seam {
            // A step that begins there and crosses it is too short to have one.
            Some(AtSeam { before, .. }) if t + before == t => T::lift(0.0),
            _ => run.local_error(start, [length, usual], self.tolerance)?,
        };
        if error <= T::lift(1.0) {
            let goes_on =
                seams.as_mut().map_or(Ok(true), |seams| seams.cross(run, at_seam, self.tolerance))?;
            return Ok(if goes_on {
                Verdict::Accepted { error, at_seam }
            } else {
                Verdict::TooLong { factor: T::lift(AGAIN) * (judged / h), failure: None }
            });
        }
        let factor = within(T::lift(1.0) / excess(run, error), 1.0);
        let failure = StepFailure::Tolerance { h: reported(judged), error: reported(error) };
        let factor = if at_seam.is_some() { factor * (judged / h) } else { factor };
        Ok(Verdict::TooLong { factor, failure: Some(failure) })
    }
}

/// e of a step of the method of `run` with this error.
pub(super) fn excess<S: Lagrangian<T>, M: Method<S, T>, T: Real>(
    run: &ControlledRun<'_, S, M, T>,
    error: T,
) -> T {
    let order = (run.stepper.method.order() + 1) as f64;
    Scalar::powf(error / T::lift(AIM), T::lift(1.0 / order))
}

/// A factor for the length of a step, at most `most`; the least one where it is not a number.
pub(super) fn within<T: Real>(factor: T, most: f64) -> T {
    let [least, most] = [FACTORS[0], most].map(T::lift);
    if factor > most { most } else { larger(least, factor) }
}
