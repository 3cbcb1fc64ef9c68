//! The search for events in a step: by the signs of a condition at its ends, and by its slopes there.

use super::Conditions;
use crate::error::StepFailure;
use crate::run::Run;
use crate::run::dense::{Dense, StateOf, are_one};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{larger, reported, smaller};
use crate::solve::crossing::{Sample, Zero, dip, zero};
use crate::{Real, Scalar};

/// The part of a step between places at which a condition is looked at for its slope; more of it in numbers
/// of few digits, and where the time has few digits in a step.
const CHORD: f64 = 1e-5;
const SOME: f64 = 16.0;
const MANY: f64 = 64.0;

/// Looks at the turn of a condition whose slopes at the ends of a step point to zero and away from it.
const SURE: usize = 6;
/// Iterations for the derivatives of a time, of numbers that carry some.
const POLISHED: usize = 3;
/// What they change the time itself by, at most: a condition that jumps across zero has no slope.
const SLIGHT: f64 = 1e-9;

/// The crossings that count as events.
///
/// ```
#[doc = include_str!("../../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Gauss::<4>::new(), 0.1, start)?;
/// let falls = run.events([Direction::Falling], |_, state| [state.angle])?.next_until(20.0)?;
/// assert!(falls.ok_or("it swings")?.state.dot_angle < 0.0);
/// let rises = run.events([Direction::Rising], |_, state| [state.angle])?.next_until(20.0)?;
/// assert!(rises.ok_or("it swings")?.state.dot_angle > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// g increases along the run.
    Rising,
    /// g decreases.
    Falling,
    /// Both.
    Either,
}

impl Direction {
    /// Whether a function that goes from `a` to `b` crosses zero in this direction.
    pub(super) fn crosses<T: Real>(self, a: T, b: T) -> bool {
        let zero = T::lift(0.0);
        match self {
            Self::Rising => a < zero && b >= zero,
            Self::Falling => a > zero && b <= zero,
            Self::Either => (a < zero && b >= zero) || (a > zero && b <= zero),
        }
    }
}

/// One of several conditions within the last step of a run.
pub(super) struct Within<'a, R: Run, G, const N: usize> {
    pub(super) run: &'a mut Dense<R>,
    pub(super) g: &'a mut G,
    /// Where states that are looked at are read to.
    pub(super) state: &'a mut StateOf<R>,
    pub(super) index: usize,
    pub(super) direction: Direction,
    /// The part of the step in which the motion is one: it is another before and behind.
    pub(super) motion: [R::Scalar; 2],
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Within<'_, R, G, N> {
    /// Where in a part of the step the condition is met, from its values at both ends.
    pub(super) fn events(
        &mut self,
        [[from, mut a], [to, mut b]]: [[R::Scalar; 2]; 2],
    ) -> Result<[Option<R::Scalar>; 3], StepFailure> {
        let ([zero, one], chord) = ([0.0, 1.0].map(R::Scalar::lift), self.chord());
        let (mut begin, mut hop, mut end, mut last) = (from, None, to, None);
        if a == zero {
            // The side to which it leads, or from which it comes back at once.
            (begin, a) = (from + chord, self.look(from + chord)?);
            let slope = self.sample(one, [from, zero])?.slope;
            if a != zero && slope != zero && (a < zero) != (slope < zero) {
                let top = from + R::Scalar::lift(0.5) * slope * chord * chord / (slope * chord - a);
                let at_top = self.look(top)?;
                hop = self.locate([[top, at_top], [begin, a]])?;
            }
        }
        if b == zero && begin < to - chord {
            // The side from which it comes; one that stays at zero is looked for from the other end.
            let before = [to - chord, self.look(to - chord)?];
            if before[1] != zero {
                last = self.locate([before, [to, b]])?;
                [end, b] = before;
            }
        }
        let side = if a < zero { -one } else { one };
        if b == zero || (b < zero) != (a < zero) || hop.is_some() {
            return Ok([hop, self.locate([[begin, a], [end, b]])?, last]);
        }
        let [from, to] = [self.sample(side, [begin, a])?, self.sample(side, [end, b])?];
        let low = dip([from, to], SURE, &mut |place| {
            let value = self.look(place)?;
            self.sample(side, [place, value])
        })?;
        let Some(low) = low else { return Ok([None, None, last]) };
        let middle = [low, self.look(low)?];
        Ok([self.locate([[begin, a], middle])?, self.locate([middle, [end, b]])?, last])
    }

    /// The part of the step at which the condition crosses zero between two others, if it does so in its
    /// direction.
    fn locate(&mut self, ends: [[R::Scalar; 2]; 2]) -> Result<Option<R::Scalar>, StepFailure> {
        if !self.direction.crosses(ends[0][1], ends[1][1]) {
            return Ok(None);
        }
        let found = self.zero(ends)?;
        let [before, behind] = if found.across > found.place {
            [found.place, found.across]
        } else {
            [found.across, found.place]
        };
        // Behind a jump of the condition: a run that begins there does not meet it again.
        let mut place = if are_one(before, behind) { behind } else { found.place };
        // That values have converged says nothing of the derivatives.
        let polished = if carries_derivatives::<R::Scalar>() { POLISHED } else { 0 };
        for _ in 0..polished {
            let value = self.look(place)?;
            let change = value / self.sample(R::Scalar::lift(1.0), [place, value])?.slope;
            if Scalar::abs(change) <= above_rounding(SLIGHT) {
                place -= change;
            }
        }
        Ok(Some(place))
    }

    /// A zero of the condition between two parts of the step: the first one, where it has come to zero and
    /// stays there.
    fn zero(&mut self, [[from, a], [to, b]]: [[R::Scalar; 2]; 2]) -> Result<Zero<R::Scalar>, StepFailure> {
        let ([nothing, one], chord) = ([0.0, 1.0].map(R::Scalar::lift), self.chord());
        let before = larger(from, to - chord);
        if b != nothing || before == from || self.look(before)? != nothing {
            return zero([[from, a], [to, b]], &mut |part| self.look(part));
        }
        // By signs: to where values end in a corner no secant leads.
        let sign = if a < nothing { -one } else { one };
        zero([[from, sign], [before, -sign]], &mut |part| {
            Ok(if self.look(part)? * sign > nothing { sign } else { -sign })
        })
    }

    /// The distance of the condition from zero at a part of the step, and its slope: that of a parabola
    /// through three places.
    pub(super) fn sample(
        &mut self,
        side: R::Scalar,
        [place, value]: [R::Scalar; 2],
    ) -> Result<Sample<R::Scalar>, StepFailure> {
        let [one, two, three, four] = [1.0, 2.0, 3.0, 4.0].map(R::Scalar::lift);
        let ([from, to], chord) = (self.motion, self.chord());
        let mut at = |chords| self.look(place + chords * chord);
        let change = if place < from + chord {
            four * at(one)? - three * value - at(two)?
        } else if place > to - chord {
            three * value - four * at(-one)? + at(-two)?
        } else {
            at(one)? - at(-one)?
        };
        Ok(Sample { place, value: side * value, slope: side * change / (two * chord) })
    }

    /// The part of the step between places at which a condition is looked at for its slope.
    fn chord(&self) -> R::Scalar {
        chord(self.motion, self.run.time() / self.run.step_size())
    }

    /// The condition at a part of the step.
    pub(super) fn look(&mut self, part: R::Scalar) -> Result<R::Scalar, StepFailure> {
        let (t, at) = self.run.reach(part * self.run.step_size())?;
        Ok(numbers(self.g.values(t, at, self.state))?[self.index])
    }
}

/// The same of a motion within a step that ends at time `t`, in units of its length.
fn chord<T: Real>([from, to]: [T; 2], t: T) -> T {
    let (rounding, [chord, some, many, most]) =
        (T::default_epsilon(), [CHORD, SOME, MANY, 0.25].map(T::lift));
    let least = larger(some * Scalar::sqrt(rounding), many * rounding * Scalar::abs(t));
    smaller(larger(chord, least), most * (to - from))
}

/// A part of a step that is more than some roundings, also in numbers of few digits.
pub(super) fn above_rounding<T: Real>(part: f64) -> T {
    larger(T::lift(part), T::lift(SOME) * T::default_epsilon())
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
