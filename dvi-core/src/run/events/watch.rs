//! Conditions that are watched on a run that somebody else drives.

use super::conditions::Conditions;
use super::course::{Course, Watched};
use super::found::Found;
use super::search::{Within, numbers};
use super::{Direction, EventOf};
use crate::error::{StartError, StepError, StepFailure};
use crate::methods::JUMPS;
use crate::run::Run;
use crate::run::dense::{Dense, PLACES, StateOf};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::larger;
use crate::shown::shown;
use crate::{Real, Scalar};

/// Conditions that are watched on a run: [`Events`](super::Events) for those who take the steps themselves.
/// Several can watch one run, each with conditions of its own.
///
/// ```
#[doc = include_str!("../../../docs/hidden/pendulum.txt")]
/// let mut run = Dense::new(Integrator::new(&Pendulum, Gauss::<4>::new(), 0.1, start)?)?;
/// let mut bottom = Watch::new(&mut run, [Direction::Either], |_, state| [state.angle])?;
/// let mut turns = Watch::new(&mut run, [Direction::Either], |_, state| [state.dot_angle])?;
/// let (mut passages, mut turned) = (0, 0);
/// while run.time() < 20.0 {
///     run.advance()?;
///     bottom.search(&mut run)?;
///     turns.search(&mut run)?;
///     passages += usize::from(bottom.next_until(&mut run, 20.0)?.is_some());
///     turned += usize::from(turns.next_until(&mut run, 20.0)?.is_some());
/// }
/// // A quarter of its period of 6.7 after the start, and each half of one from there on.
/// assert_eq!((passages, turned), (6, 5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Watch<R: Run, G, const N: usize> {
    g: G,
    directions: [Direction; N],
    /// Of each condition, at the end of the last step.
    watched: [Watched<R::Scalar>; N],
    /// Events of the last step that have not been handed out.
    pub(super) found: Found<R::Scalar, N>,
    /// Where states that are looked at are read to.
    state: StateOf<R>,
    /// When it has looked last, and how often the state had been set.
    time: R::Scalar,
    beginnings: u64,
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
const ROUNDINGS: f64 = 1024.0;
/// At a jump of the velocity a condition is zero if it is no more than this part of what changes in a step.
const CLOSED: f64 = 1e-11;
/// A shorter part of a step, as a jump is one, is not looked into: where it begins and ends is no better
/// known.
const SHORT: f64 = 1e-9;

impl<R: Run, G, const N: usize> Watch<R, G, N>
where
    G: FnMut(R::Scalar, &StateOf<R>) -> [R::Scalar; N],
{
    /// From the present point of the run on, where each of the conditions `g` crosses zero in its direction.
    /// All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Starter`] if there are no velocities, or a condition is no number, at the present
    /// point.
    pub fn new(run: &mut Dense<R>, directions: [Direction; N], g: G) -> Result<Self, StartError> {
        Self::of(run, directions, g)
    }
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Watch<R, G, N> {
    /// The same for conditions of either kind.
    pub(super) fn of(run: &mut Dense<R>, directions: [Direction; N], mut g: G) -> Result<Self, StartError> {
        let mut state = run.at_end().map_err(StartError::Starter)?.state();
        let time = run.time();
        let at = run.at_end().map_err(StartError::Starter)?;
        let values = numbers(g.values(time, at, &mut state)).map_err(StartError::Starter)?;
        let watched = values.map(|g| Watched { g, course: None });
        let (found, last, lost, beginnings) = (Found::new(), None, None, run.beginnings);
        Ok(Self { g, directions, watched, found, state, time, beginnings, last, steps: 2, hops: 0, lost })
    }

    /// Finds the events of the last step: to be called after each step.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`] if it was not called after the step before, or a state was set: then a
    /// new `Watch` begins. Else as [`Events::next_until`](super::Events::next_until).
    pub fn search(&mut self, run: &mut Dense<R>) -> Result<(), StepError> {
        self.check_known()?;
        if run.last_begun() != self.time || run.beginnings != self.beginnings {
            return Err(run.unreachable(self.time));
        }
        self.time = run.time();
        self.find(run).map_err(|failure| {
            let error = run.error(failure);
            self.lost = Some(error);
            error
        })
    }

    /// The next event of the last step that is not after time `t`, if there is one.
    ///
    /// # Errors
    /// As [`Events::next_until`](super::Events::next_until), of the last step.
    pub fn next_until(&mut self, run: &mut Dense<R>, t: R::Scalar) -> Result<Option<EventOf<R>>, StepError> {
        run.check_ahead(t)?;
        self.next_before(run, Some(t))
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
        for place in 0..PLACES {
            let Some((part, t, at)) = run.at_place(place) else { break };
            let values = numbers(self.g.values(t, at, &mut self.state))?;
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
            let Some((part, sides)) = run.at_jump(jump) else { break };
            let values = |at| numbers(self.g.values(begun + part * h, at, &mut self.state));
            let [before, behind] = sides.map(values);
            let [before, behind] = self.closed([before?, behind?], Scalar::abs(h));
            self.find_between::<false>(run, [from, part], before)?;
            self.find_between::<false>(run, [part, part], behind)?;
            from = part;
        }
        Ok(from)
    }

    /// The values on both sides of a jump, of which that of a gap that is closed but for rounding is zero.
    fn closed(&self, sides: [[R::Scalar; N]; 2], h: R::Scalar) -> [[R::Scalar; N]; 2] {
        let [zero, closed] = [0.0, CLOSED].map(R::Scalar::lift);
        let change: [_; N] = core::array::from_fn(|index| {
            let Watched { g, course } = self.watched[index];
            let change = Scalar::abs(sides[0][index] - g);
            course.map_or(change, |course| larger(change, course.rate * h))
        });
        let of = |g: R::Scalar, change| if Scalar::abs(g) <= closed * change { zero } else { g };
        sides.map(|side| core::array::from_fn(|index| of(side[index], change[index])))
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
        let [zero, one, left, unsure, short] = [0.0, 1.0, LEFT, UNSURE, SHORT].map(R::Scalar::lift);
        let whole = Scalar::abs(run.step_size());
        let (h, instant) = (whole * (to - from), instant(self.time, whole));
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
            if carries_derivatives::<R::Scalar>() && Scalar::abs(b) <= left * change {
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
        (self.time, self.beginnings) = (run.time(), run.beginnings);
        let values = self.at_end(run).map_err(|failure| {
            self.lost = Some(run.error(failure));
            self.found.forget();
            StartError::Starter(failure)
        })?;
        let h = Scalar::abs(run.step_size());
        let (zero, short) = (R::Scalar::lift(0.0), R::Scalar::lift(LEFT) * h + instant(self.time, h));
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
        self.lost.map_or(Ok(()), Err)
    }
}

/// So many roundings of time `t`, and of a length `h`, as are no difference.
fn instant<T: Real>(t: T, h: T) -> T {
    T::lift(ROUNDINGS) * T::default_epsilon() * (Scalar::abs(t) + h)
}

shown!([R: Run, G, const N: usize] Watch<R, G, N>, |watch| directions: watch.directions);
