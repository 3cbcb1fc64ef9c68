//! Conditions that are watched on a run: where they are zero in its last step.

use super::course::{Course, Watched};
use super::found::Found;
use super::search::{Within, above_rounding, numbers};
use super::{Conditions, Direction};
use crate::error::{StartError, StepError, StepFailure};
use crate::methods::JUMPS;
use crate::run::Run;
use crate::run::dense::{Dense, PLACES, StateOf};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::larger;
use crate::{Real, Scalar};

/// The conditions of a run, and their events in its last step.
pub(super) struct Watch<R: Run, G, const N: usize> {
    g: G,
    pub(super) directions: [Direction; N],
    /// Of each condition, at the end of the last step.
    watched: [Watched<R::Scalar>; N],
    /// Events of the last step that have not been handed out.
    pub(super) found: Found<R::Scalar, N>,
    /// Where states that are looked at are read to.
    state: StateOf<R>,
    /// The last event, but for those where the state was set: its condition and its part of a step.
    pub(super) last: Option<(usize, R::Scalar)>,
    /// Steps since the state was set; before it is, more than one.
    pub(super) steps: u64,
    /// Events one after the other that came soon after the state was set.
    pub(super) hops: usize,
    /// Why the events of the last step are not known.
    lost: Option<StepError>,
}

/// Of the change of a condition between two places within a step, what interpolation may be wrong by.
const UNSURE: f64 = 0.05;
/// Where the state is changed a condition is zero if it is no more than what changes in this part of a step,
/// and in so many roundings of the time. A step of no more of these says nothing of the side to which it
/// leads from there.
const LEFT: f64 = 1e-9;
const ROUNDINGS: f64 = 32.0;
/// At a jump of the velocity a condition is zero if it is no more than this part of what changes in a step.
const CLOSED: f64 = 1e-11;
/// A shorter part of a step, as a jump is one, is not looked into: where it begins and ends is no better
/// known.
const SHORT: f64 = 1e-9;

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Watch<R, G, N> {
    /// From the present point of the run on, where each of the conditions `g` crosses zero in its direction.
    /// All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Starter`] if there are no velocities, or a condition is no number, at the present
    /// point.
    pub(super) fn new(run: &mut Dense<R>, directions: [Direction; N], mut g: G) -> Result<Self, StartError> {
        let mut state = run.at_end().map_err(StartError::Starter)?.state();
        let time = run.time();
        let at = run.at_end().map_err(StartError::Starter)?;
        let values = numbers(g.values(time, at, &mut state)).map_err(StartError::Starter)?;
        let watched = values.map(|g| Watched { g, course: None });
        Ok(Self {
            g,
            directions,
            watched,
            found: Found::new(),
            state,
            last: None,
            steps: 2,
            hops: 0,
            lost: None,
        })
    }

    /// Finds the events of the last step: to be called after each step.
    pub(super) fn search(&mut self, run: &mut Dense<R>) -> Result<(), StepError> {
        self.find(run).map_err(|failure| {
            let error = run.error(failure);
            self.lost = Some(error);
            error
        })
    }

    /// The conditions where the run is.
    ///
    /// # Errors
    /// [`StepFailure::UndefinedEvent`].
    fn at_end(&mut self, run: &mut Dense<R>) -> Result<[R::Scalar; N], StepFailure> {
        let t = run.time();
        numbers(self.g.values(t, run.at_end()?, &mut self.state))
    }

    /// Finds the events of the last step, between the places of it that are known.
    ///
    /// # Errors
    /// [`StepFailure::UndefinedEvent`], and those of parts of the step.
    #[inline]
    fn find(&mut self, run: &mut Dense<R>) -> Result<(), StepFailure> {
        self.found.forget();
        self.steps += 1;
        let end = self.at_end(run)?;
        let [mut from, one] = [0.0, 1.0].map(R::Scalar::lift);
        let (begun, h) = (run.last_begun(), run.step_size());
        for place in 0..PLACES {
            let Some((part, [at, _])) = run.at_place(false, place) else { break };
            let values = numbers(self.g.values(begun + part * h, at, &mut self.state))?;
            self.find_between::<true>(run, [from, part], values)?;
            from = part;
        }
        if from > R::Scalar::lift(0.0) {
            return self.find_between::<true>(run, [from, one], end);
        }
        let from = self.find_jumps(run)?;
        self.find_between::<false>(run, [from, one], end)
    }

    /// Finds the events up to the last jump of the velocity in the last step, and returns the part of the
    /// step before it. Each divides the step, and is an event of the conditions that jump across zero with
    /// it.
    fn find_jumps(&mut self, run: &mut Dense<R>) -> Result<R::Scalar, StepFailure> {
        let (mut from, begun, h) = (R::Scalar::lift(0.0), run.last_begun(), run.step_size());
        for jump in 0..JUMPS {
            let Some((part, sides)) = run.at_place(true, jump) else { break };
            let values = |at| numbers(self.g.values(begun + part * h, at, &mut self.state));
            let [before, behind] = sides.map(values);
            let (before, behind) = (before?, behind?);
            let before = self.closed(run, [from, part], (part, before))?;
            let behind = self.closed(run, [part, R::Scalar::lift(1.0)], (part, behind))?;
            self.find_between::<false>(run, [from, part], before)?;
            self.find_between::<false>(run, [part, part], behind)?;
            from = part;
        }
        Ok(from)
    }

    /// The values on one side of a jump, where a motion begins or ends, of which that of a gap that is
    /// closed but for rounding is zero.
    fn closed(
        &mut self,
        run: &mut Dense<R>,
        motion: [R::Scalar; 2],
        (place, mut values): (R::Scalar, [R::Scalar; N]),
    ) -> Result<[R::Scalar; N], StepFailure> {
        let (zero, closed) = (R::Scalar::lift(0.0), above_rounding::<R::Scalar>(CLOSED));
        for (index, value) in values.iter_mut().enumerate() {
            let Watched { g, course } = self.watched[index];
            let rate = course.map_or(zero, |course| course.rate * Scalar::abs(run.step_size()));
            let may_be_zero = Scalar::abs(*value) <= closed * larger(Scalar::abs(*value - g), rate);
            if may_be_zero && self.is_rounding(run, index, motion, [place, *value])? {
                *value = zero;
            }
        }
        Ok(values)
    }

    /// Whether a condition that is small for what it has been, at one end of a motion within the last step,
    /// is so for what it is there too.
    fn is_rounding(
        &mut self,
        run: &mut Dense<R>,
        index: usize,
        motion: [R::Scalar; 2],
        [place, value]: [R::Scalar; 2],
    ) -> Result<bool, StepFailure> {
        let (one, left) = (R::Scalar::lift(1.0), above_rounding::<R::Scalar>(LEFT));
        if motion[1] - motion[0] <= above_rounding(SHORT) {
            return Ok(true);
        }
        run.settle()?;
        let slope = self.within(run, index, motion).sample(one, [place, value])?.slope;
        Ok(Scalar::abs(value) <= left * Scalar::abs(slope))
    }

    /// Finds the events of a part of the last step, or of the whole, with the values of the conditions at its
    /// end; `STAGED` says whether stages divide the step.
    #[inline]
    fn find_between<const STAGED: bool>(
        &mut self,
        run: &mut Dense<R>,
        [from, to]: [R::Scalar; 2],
        end: [R::Scalar; N],
    ) -> Result<(), StepFailure> {
        let [zero, one, unsure] = [0.0, 1.0, UNSURE].map(R::Scalar::lift);
        let [left, short] = [LEFT, SHORT].map(above_rounding::<R::Scalar>);
        let whole = Scalar::abs(run.step_size());
        let (h, instant) = (whole * (to - from), instant(run.time(), whole));
        // Stages divide one motion, a jump begins another.
        let motion = if STAGED { [zero, one] } else { [from, to] };
        for (index, mut b) in end.into_iter().enumerate() {
            let Watched { g: a, course } = self.watched[index];
            if whole <= instant && a == zero {
                let stays = course.is_some_and(|course| Scalar::abs(b) <= course.rate * instant);
                let g = if stays { zero } else { b };
                self.watched[index] = Watched { g, course: course.map(Course::of_another) };
                continue;
            }
            if to - from <= short {
                if self.directions[index].crosses(a, b) {
                    self.found.push(index, to);
                }
                self.watched[index] = Watched { g: b, course: course.map(Course::of_another) };
                continue;
            }
            // Of another motion, before the state was set.
            let before = course.filter(|_| self.steps != 1 || (STAGED && from > zero));
            let course = Course::after(before, (b - a) / h);
            let change = course.rate * h;
            if STAGED && to < one && Scalar::abs(b) <= unsure * change {
                // The polynomial through the stages is less accurate than a step to this place, which
                // decides where the sign is in doubt.
                run.settle()?;
                b = self.within(run, index, motion).look(to)?;
            }
            // What lies at the end of a step but for rounding has no derivative in the next one.
            let may_be_zero = carries_derivatives::<R::Scalar>() && Scalar::abs(b) <= left * change;
            if may_be_zero && self.is_rounding(run, index, motion, [to, b])? {
                b = zero;
            }
            self.watched[index] = Watched { g: b, course: Some(course) };
            let stays = (a > zero && b > zero) || (a < zero && b < zero);
            // The side of what is so near to zero is that of rounding.
            let is_beside = [a, b].iter().any(|&g| Scalar::abs(g) <= left * change);
            let may_have_met = match before {
                Some(before) if stays && !is_beside => course.may_turn(&before, [a, b], h, STAGED),
                _ => true,
            };
            if !may_have_met {
                continue;
            }
            run.settle()?;
            let parts = self.within(run, index, motion).events([[from, a], [to, b]])?;
            for part in parts.into_iter().flatten() {
                self.found.push(index, part);
            }
        }
        Ok(())
    }

    fn within<'a>(
        &'a mut self,
        run: &'a mut Dense<R>,
        index: usize,
        motion: [R::Scalar; 2],
    ) -> Within<'a, R, G, N> {
        let Self { g, state, directions, .. } = self;
        Within { run, g, state, index, direction: directions[index], motion }
    }

    /// Goes on where the state of the run has just been set.
    ///
    /// # Errors
    /// As [`new`](Self::new); then no events are known.
    pub(super) fn begin_anew(&mut self, run: &mut Dense<R>) -> Result<(), StartError> {
        let values = self.at_end(run).map_err(|failure| {
            self.lost = Some(run.error(failure));
            self.found.forget();
            StartError::Starter(failure)
        })?;
        let h = Scalar::abs(run.step_size());
        let (zero, short) =
            (R::Scalar::lift(0.0), above_rounding::<R::Scalar>(LEFT) * h + instant(run.time(), h));
        let before = core::mem::replace(&mut self.found, Found::new());
        for (index, (watched, g)) in self.watched.iter_mut().zip(values).enumerate() {
            let is_zero =
                g == zero || watched.course.is_some_and(|course| Scalar::abs(g) <= course.rate * short);
            // At a jump of the velocity a condition may have crossed zero that is not zero.
            let is_now = |part| {
                self.last.is_some_and(|(_, last)| part == last || (is_zero && (part - last) * h <= short))
            };
            if before.of(index).any(is_now) {
                self.found.push(index, zero);
            }
            watched.g = if is_zero { zero } else { g };
        }
        (self.steps, self.lost) = (0, None);
        Ok(())
    }

    /// Whether the events of the last step are known.
    ///
    /// # Errors
    /// Why they are not.
    pub(super) fn check_known(&self) -> Result<(), StepError> {
        self.lost.as_ref().map_or(Ok(()), |lost| Err(*lost))
    }
}

/// So many roundings of time `t`, and of a length `h`, as are no difference.
fn instant<T: Real>(t: T, h: T) -> T {
    T::lift(ROUNDINGS) * T::default_epsilon() * (Scalar::abs(t) + h)
}
