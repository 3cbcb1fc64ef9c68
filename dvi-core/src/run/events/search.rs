//! The search for events in a step: by the signs of conditions at its ends, and by their slopes there.

use super::conditions::Conditions;
use super::course::{Course, Turn, Watched};
use super::{Events, LEFT};
use crate::error::StepFailure;
use crate::run::Run;
use crate::scalar::carries_derivatives;
use crate::scalar::norm::reported;
use crate::solve::crossing::{Sample, dip, zero};
use crate::{Real, Scalar};

/// The part of a step between places at which a condition is looked at for its slope.
const CHORD: f64 = 1e-5;

/// Looks at the turn of a condition whose slopes at the ends of a step point to zero and away from it.
const SURE: usize = 6;
/// Iterations for the derivatives of a time, of numbers that carry some.
const POLISHED: usize = 3;

/// The crossings that count as events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// g increases along the run.
    #[default]
    Rising,
    /// g decreases.
    Falling,
    /// Both.
    Either,
}

impl Direction {
    /// Whether a function that goes from `a` to `b` crosses zero in this direction.
    pub fn crosses<T: Real>(self, a: T, b: T) -> bool {
        let zero = T::lift(0.0);
        match self {
            Self::Rising => a < zero && b >= zero,
            Self::Falling => a > zero && b <= zero,
            Self::Either => (a < zero && b >= zero) || (a > zero && b <= zero),
        }
    }
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Events<R, G, N> {
    /// The conditions where the run is.
    ///
    /// # Errors
    /// [`StepFailure::UndefinedEvent`].
    pub(super) fn at_end(&mut self) -> Result<[R::Scalar; N], StepFailure> {
        let t = self.dense.time();
        numbers(self.g.values(t, self.dense.at_end()?, &mut self.state))
    }

    /// Finds the events of the last step.
    ///
    /// # Errors
    /// [`StepFailure::UndefinedEvent`], and those of parts of the step.
    pub(super) fn search(&mut self) -> Result<(), StepFailure> {
        let end = self.at_end()?;
        let (zero, h) = (R::Scalar::lift(0.0), Scalar::abs(self.dense.step_size()));
        for (index, b) in end.into_iter().enumerate() {
            let Watched { g: a, course } = self.watched[index];
            // Of another motion, before the state was set.
            let before = course.filter(|_| self.steps != 1);
            let course = Course::after(before, (b - a) / h);
            // What lies at the end of a step but for rounding has no derivative in the next one.
            let is_at_end = carries_derivatives::<R::Scalar>()
                && Scalar::abs(b) <= R::Scalar::lift(LEFT) * course.rate * h;
            let b = if is_at_end { zero } else { b };
            self.watched[index] = Watched { g: b, course: Some(course) };
            let stays = (a > zero && b > zero) || (a < zero && b < zero);
            let turn = match before {
                Some(before) if stays => course.turns(&before, [a, b], h),
                _ => Turn::Likely,
            };
            if turn == Turn::No {
                continue;
            }
            self.dense.settle()?;
            if turn == Turn::Likely || self.is_turned(index, [a, b])? {
                self.search_near(index, [a, b])?;
            }
        }
        Ok(())
    }

    /// Whether a condition comes nearer to zero at the beginning of a step, and goes away from it at the
    /// end.
    fn is_turned(&mut self, index: usize, [a, b]: [R::Scalar; 2]) -> Result<bool, StepFailure> {
        let [one, chord] = [1.0, CHORD].map(R::Scalar::lift);
        Ok(Scalar::abs(self.look(index, chord)?) < Scalar::abs(a)
            && Scalar::abs(self.look(index, one - chord)?) < Scalar::abs(b))
    }

    /// The events of a condition in a step, from its values at both ends.
    fn search_near(&mut self, index: usize, [mut a, b]: [R::Scalar; 2]) -> Result<(), StepFailure> {
        let [zero, one, chord] = [0.0, 1.0, CHORD].map(R::Scalar::lift);
        let (mut begin, mut hop) = (zero, None);
        if a == zero {
            // The side to which it leads, or from which it comes back at once.
            (begin, a) = (chord, self.look(index, chord)?);
            let slope = self.sample(index, one, [zero, zero])?.slope;
            if a != zero && slope != zero && (a < zero) != (slope < zero) {
                let top = R::Scalar::lift(0.5) * slope * chord * chord / (slope * chord - a);
                let at_top = self.look(index, top)?;
                hop = self.locate(index, [[top, at_top], [chord, a]])?;
            }
        }
        let side = if a < zero { -one } else { one };
        if b == zero || (b < zero) != (a < zero) || hop.is_some() {
            self.found[index] = [hop, self.locate(index, [[begin, a], [one, b]])?];
            return Ok(());
        }
        let [from, to] = [self.sample(index, side, [begin, a])?, self.sample(index, side, [one, b])?];
        let low = dip([from, to], SURE, |place| {
            let value = self.look(index, place)?;
            self.sample(index, side, [place, value])
        })?;
        if let Some(low) = low {
            let middle = [low, self.look(index, low)?];
            let first = self.locate(index, [[begin, a], middle])?;
            self.found[index] = [first, self.locate(index, [middle, [one, b]])?];
        }
        Ok(())
    }

    /// The part of the step at which a condition crosses zero between two others, if it does so in its
    /// direction.
    fn locate(&mut self, index: usize, ends: [[R::Scalar; 2]; 2]) -> Result<Option<R::Scalar>, StepFailure> {
        if !self.directions[index].crosses(ends[0][1], ends[1][1]) {
            return Ok(None);
        }
        let mut place = zero(ends, |part| self.look(index, part))?.place;
        if carries_derivatives::<R::Scalar>() {
            // That values have converged says nothing of the derivatives.
            for _ in 0..POLISHED {
                let value = self.look(index, place)?;
                place -= value / self.sample(index, R::Scalar::lift(1.0), [place, value])?.slope;
            }
        }
        Ok(Some(place))
    }

    /// The distance of a condition from zero at a part of the step, and its slope: that of a parabola
    /// through three places.
    fn sample(
        &mut self,
        index: usize,
        side: R::Scalar,
        [place, value]: [R::Scalar; 2],
    ) -> Result<Sample<R::Scalar>, StepFailure> {
        let [one, two, three, four, chord] = [1.0, 2.0, 3.0, 4.0, CHORD].map(R::Scalar::lift);
        let mut at = |chords| self.look(index, place + chords * chord);
        let change = if place < chord {
            four * at(one)? - three * value - at(two)?
        } else if place > one - chord {
            three * value - four * at(-one)? + at(-two)?
        } else {
            at(one)? - at(-one)?
        };
        Ok(Sample { place, value: side * value, slope: side * change / (two * chord) })
    }

    /// A condition at a part of the step.
    fn look(&mut self, index: usize, part: R::Scalar) -> Result<R::Scalar, StepFailure> {
        self.dense.reach(part * self.dense.step_size())?;
        let t = self.dense.reached_time();
        Ok(numbers(self.g.values(t, self.dense.reached()?, &mut self.state))?[index])
    }
}

/// The values of conditions.
///
/// # Errors
/// [`StepFailure::UndefinedEvent`] for the first that is no number.
pub(super) fn numbers<T: Real, const N: usize>(values: [T; N]) -> Result<[T; N], StepFailure> {
    match values.iter().position(|&value| reported(value).is_nan()) {
        None => Ok(values),
        Some(event) => Err(StepFailure::UndefinedEvent { event }),
    }
}
