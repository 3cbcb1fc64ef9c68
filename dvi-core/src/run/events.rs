//! Events of a run: where a condition g(t, state) crosses zero.
//!
//! They lie on the [continuous extension](Dense) of the run. After each step the sign of g tells whether it
//! has crossed. A step that begins and ends on one side may have crossed twice: if g is near enough to zero,
//! as its changes in the steps before say, its slopes at both ends are looked at, and where these point to
//! zero and away from it, g is followed down to its least value in between. Each crossing is found there to
//! rounding.

mod course;
mod search;

use core::fmt;
use core::iter::FusedIterator;

use super::dense::{Dense, StateOf};
use crate::error::{StartError, StepError, StepFailure};
use crate::run::Run;
use crate::scalar::Scalar;
use course::Watched;
use search::numbers;

pub use search::Direction;

/// Where a run meets a condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<S, T> {
    /// Which of the conditions it is.
    pub index: usize,
    /// When.
    pub time: T,
    /// The state, with named coordinates and, of a regular system, velocities.
    pub state: S,
}

/// An [`Event`] of a run `R`.
type EventOf<R> = Event<StateOf<R>, <R as Run>::Scalar>;

/// The events of a run, in the order in which they happen, as an iterator that takes as many steps as it
/// must.
///
/// A condition is a function g(t, state) of which an event is a zero; any number of them is one closure that
/// returns an array. An event lies on the step that leads over it, as it is [taken in part](Dense), and is
/// located to rounding there. So it has the error of the run and that of one step more, whatever the length
/// of the step: that is of the order h<sup>p+1</sup> for a method of order p. The points of the run are the
/// same, bit for bit, as without events. An event costs some twenty steps, and a condition that is far from
/// zero one evaluation a step, with the velocities of the state.
///
/// What follows from an event is the body of the loop: note it, leave the loop, or change the state and go on
/// by [`set_state`](Self::set_state). A run that is to stop at an event is set to its time and state:
/// [`Run::set_state`]. Without an event the loop does not end; [`next_until`](Self::next_until) looks for
/// events up to a time.
///
/// Of several events at one time the first in the array comes first. Where a run begins with g = 0 there is
/// no event, and one that lies at the end of a step counts once. A step that begins and ends on one side is
/// seen to cross zero in between if g turns once on the way; what turns more often within one step may pass
/// unseen. Events within a step that fails are not found, those before it are.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A ball that loses a fifth of its speed on the floor.
/// #[lagrangian(coordinates(height), lagrangian = dot(height).powi(2) / 2.0 - height)]
/// struct Ball;
///
/// let start: BallState = BallState { height: 0.5, dot_height: 0.0 };
/// let mut run = Integrator::new(&Ball, Variational::trapezoid(), 0.1, start)?;
/// // It is at the floor, and at the top of its way.
/// let conditions = [Direction::Falling, Direction::Falling];
/// let mut events = run.events(conditions, |_, ball: &BallState| [ball.height, ball.dot_height])?;
/// let mut tops = Vec::new();
/// while let Some(Event { index, time, state }) = events.next_until(4.0)? {
///     match index {
///         0 => events.set_state(time, BallState { dot_height: -0.8 * state.dot_height, ..state })?,
///         _ => tops.push((time, state.height)),
///     }
/// }
/// // Of a height of 0.5 it falls for a unit of time, and rises for 0.8 of one.
/// let [(t1, h1), (t2, h2)] = tops[..] else { panic!("{tops:?}") };
/// assert!((t1 - 1.8).abs() < 1e-12 && (h1 - 0.32).abs() < 1e-12);
/// assert!((t2 - 3.24).abs() < 1e-12 && (h2 - 0.2048).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Events<R: Run, G, const N: usize> {
    dense: Dense<R>,
    g: G,
    directions: [Direction; N],
    /// Of each condition, at the end of the last step.
    watched: [Watched<R::Scalar>; N],
    /// Parts of the last step at which events are, that have not been handed out.
    found: [[Option<R::Scalar>; 2]; N],
    /// Where states that are looked at are read to.
    state: StateOf<R>,
    /// The last event that was handed out.
    last: Option<usize>,
    /// Why the events of the last step are not known.
    lost: Option<StepError>,
    /// Whether the iterator has come to its end.
    ended: bool,
}

/// A condition that has led to a change of the state is zero there if it is no more than this part of what
/// changes in a step.
const LEFT: f64 = 1e-9;

impl<R: Run, G, const N: usize> Events<R, G, N>
where
    G: FnMut(R::Scalar, &StateOf<R>) -> [R::Scalar; N],
{
    /// Of the run in `dense`, from its present point on, where each of the conditions `g` crosses zero in its
    /// direction. All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Starter`] if there are no velocities, or a condition is no number, at the present point.
    pub fn new(mut dense: Dense<R>, directions: [Direction; N], mut g: G) -> Result<Self, StartError> {
        let state = dense.at_end().map_err(StartError::Starter)?.state();
        let values = numbers(g(dense.time(), &state)).map_err(StartError::Starter)?;
        let watched = values.map(|g| Watched { g, course: None });
        Ok(Self {
            dense,
            g,
            directions,
            watched,
            found: [[None; 2]; N],
            state,
            last: None,
            lost: None,
            ended: false,
        })
    }

    /// The run, at the end of the step that is searched, with its continuous extension.
    pub fn dense(&mut self) -> &mut Dense<R> {
        &mut self.dense
    }

    /// The next event that is not after time `t`; `None` if there is none, and the run has come to the step
    /// that leads over `t`. Later events are handed out later.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`], with both times, if `t` lies before the last step or is not finite.
    /// [`StepError`] of the first step that fails, once all events before it have been handed out;
    /// [`StepFailure::UndefinedEvent`] in a step at whose end, or at a place that is looked at, a condition
    /// is no number: then no more is known of events, until another state is [set](Self::set_state).
    pub fn next_until(&mut self, t: R::Scalar) -> Result<Option<EventOf<R>>, StepError> {
        self.dense.check_ahead(t)?;
        self.next_before(Some(t))
    }

    fn next_before(&mut self, end: Option<R::Scalar>) -> Result<Option<EventOf<R>>, StepError> {
        while !end.is_some_and(|end| self.has_come_to(end)) {
            if let Some(event) = self.advance()? {
                return Ok(Some(event));
            }
        }
        Ok(None)
    }

    /// Whether no event up to time `end` is left, in the last step or behind it.
    fn has_come_to(&self, end: R::Scalar) -> bool {
        match self.first() {
            Some((part, ..)) => self.dense.is_before(end, self.dense.time_at(part)),
            None => !self.dense.is_before(self.dense.time(), end),
        }
    }

    /// Hands out an event of the last step or, if there is none left, takes a step and hands out its first, if
    /// there is one.
    ///
    /// # Errors
    /// As [`next_until`](Self::next_until).
    pub fn advance(&mut self) -> Result<Option<EventOf<R>>, StepError> {
        if self.first().is_none() {
            self.step()?;
        }
        let Some((part, index, which)) = self.first() else { return Ok(None) };
        self.found[index][which] = None;
        self.last = Some(index);
        self.event(part, index).map(Some).map_err(|failure| self.dense.error(failure))
    }

    /// Goes on from another state at time `t`, which is as a rule that of the last event; all events that have
    /// not been handed out are forgotten, and a condition that has led there is zero there. The run begins
    /// anew, as by [`Run::set_state`].
    ///
    /// # Errors
    /// As [`Run::set_state`], and as [`new`](Self::new).
    pub fn set_state(&mut self, t: R::Scalar, state: StateOf<R>) -> Result<(), StartError> {
        self.dense.set_state(t, state)?;
        self.found = [[None; 2]; N];
        self.dense.at_end().map_err(StartError::Starter)?.refill(&mut self.state);
        let values = numbers((self.g)(t, &self.state)).map_err(StartError::Starter)?;
        let h = Scalar::abs(self.dense.step_size());
        for (index, (watched, g)) in self.watched.iter_mut().zip(values).enumerate() {
            let rounding = watched
                .course
                .map_or(R::Scalar::lift(0.0), |course| R::Scalar::lift(LEFT) * course.rate * h);
            let has_led_there = self.last == Some(index) && Scalar::abs(g) <= rounding;
            *watched = Watched { g: if has_led_there { R::Scalar::lift(0.0) } else { g }, course: None };
        }
        (self.last, self.lost, self.ended) = (None, None, false);
        Ok(())
    }

    /// The first event of the last step that has not been handed out: its part of the step, its condition,
    /// and which of two it is.
    fn first(&self) -> Option<(R::Scalar, usize, usize)> {
        let mut first: Option<(R::Scalar, usize, usize)> = None;
        for (index, found) in self.found.iter().enumerate() {
            for (which, part) in found.iter().enumerate() {
                if let Some(part) = *part
                    && first.is_none_or(|(known, ..)| part < known)
                {
                    first = Some((part, index, which));
                }
            }
        }
        first
    }

    fn event(&mut self, part: R::Scalar, index: usize) -> Result<EventOf<R>, StepFailure> {
        self.dense.settle()?;
        self.dense.reach(part * self.dense.step_size())?;
        Ok(Event { index, time: self.dense.reached_time(), state: self.dense.reached()?.state() })
    }

    /// Takes a step, and finds its events.
    fn step(&mut self) -> Result<(), StepError> {
        self.lost.map_or(Ok(()), Err)?;
        self.dense.advance()?;
        self.search().map_err(|failure| {
            let error = self.dense.error(failure);
            self.lost = Some(error);
            error
        })
    }
}

impl<R: Run, G, const N: usize> Iterator for Events<R, G, N>
where
    G: FnMut(R::Scalar, &StateOf<R>) -> [R::Scalar; N],
{
    type Item = Result<EventOf<R>, StepError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let next = self.next_before(None).transpose();
        self.ended = next.as_ref().is_none_or(Result::is_err);
        next
    }
}

impl<R: Run, G, const N: usize> FusedIterator for Events<R, G, N> where
    G: FnMut(R::Scalar, &StateOf<R>) -> [R::Scalar; N]
{
}

impl<R: Run + fmt::Debug, G, const N: usize> fmt::Debug for Events<R, G, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { dense, directions, .. } = self;
        f.debug_struct("Events").field("run", dense).field("directions", directions).finish_non_exhaustive()
    }
}
