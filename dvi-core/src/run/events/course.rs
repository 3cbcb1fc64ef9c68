//! How a condition has changed from step to step: whether a step may have led to zero and back.

use crate::scalar::norm::{larger, reported};
use crate::{Real, Scalar};

/// Of the rate at which g changes, what is kept from step to step.
const FORGETTING: f64 = 0.9;
/// The largest rate within a step in units of the mean rates of the last steps, and between places within
/// a step.
const STEEPER: [f64; 2] = [16.0, 4.0];
/// An unknown bend in units of what bends have changed by, at most.
const MARGIN: f64 = 32.0;

/// What is known of a condition.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watched<T> {
    pub(super) g: T,
    /// How it has changed, once there is a step.
    pub(super) course: Option<Course<T>>,
}

/// How a condition has changed in steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<T> {
    /// The mean rate in the last step.
    slope: T,
    /// By how much that differs from the one before, once there is one.
    pub(super) bend: Option<T>,
    /// How fast it has changed in the last steps, at most.
    pub(super) rate: T,
}

impl<T: Real> Course<T> {
    /// After a step in which the mean rate is `slope`.
    pub(super) fn after(before: Option<Self>, slope: T) -> Self {
        let zero = T::lift(0.0);
        // From a pole it comes at no rate.
        let slope = if reported(slope).is_finite() { slope } else { zero };
        let rate = before.map_or(zero, |before| T::lift(FORGETTING) * before.rate);
        Self {
            slope,
            bend: before.map(|before| slope - before.slope),
            rate: larger(Scalar::abs(slope), rate),
        }
    }

    /// Where the motion goes on as another one: what it has bent by says nothing any more.
    pub(super) fn of_another(self) -> Self {
        Self { bend: None, ..self }
    }

    /// Whether a condition may have come to zero and back in a step of length `h` from `a` to `b`, which
    /// are on one side, where its course was another before: if it falls at the beginning and rises at the
    /// end. The rates there are those of a parabola, but for what the course has bent otherwise in the step
    /// before.
    pub(super) fn may_turn(&self, before: &Self, [a, b]: [T; 2], h: T, is_staged: bool) -> bool {
        let [whole, part] = STEEPER;
        let steeper = if is_staged { part } else { whole };
        if Scalar::abs(a) + Scalar::abs(b) > T::lift(steeper) * self.rate * h {
            return false;
        }
        let (Some(bend), Some(bent)) = (self.bend, before.bend) else { return true };
        let (zero, half) = (T::lift(0.0), T::lift(0.5));
        let away = |slope: T| if a < zero { -slope } else { slope };
        let unknown = T::lift(MARGIN) * Scalar::abs(bend - bent);
        away(self.slope - half * bend) < unknown && away(self.slope + half * bend) > -unknown
    }
}
