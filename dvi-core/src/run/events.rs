//! Events of a run: where a condition g(t, state) crosses zero.
//!
//! They lie on the [continuous extension](Dense) of the run. After each step the sign of g tells whether it
//! has crossed. A step that begins and ends on one side may have crossed twice: if g is near enough to zero,
//! as its changes in the steps before say, its slopes at both ends are looked at, and where these point to
//! zero and away from it, g is followed down to its least value in between. Methods of many stages take steps
//! over several turns: there the stages divide a step into parts, each of which is searched so. So do jumps
//! of the velocity, of which a method knows the place and both sides. Each crossing is found to rounding.

mod course;
mod found;
mod search;
mod watch;

use core::fmt::Debug;
use core::iter::FusedIterator;

use super::dense::{Dense, StateOf};
#[cfg(doc)]
use crate::error::StepFailure;
use crate::error::{StartError, StepError};
use crate::run::{Run, between::Flat};
use crate::shown::shown;
use crate::{Lagrangian, Real, System};
pub use search::Direction;
use watch::Watch;

/// Conditions of which an event is a zero: a closure over the time and the state, or those that are
/// [declared](crate::run::Run::declared_events) in the attribute of the system.
pub trait Conditions<S: System, T: Real, const N: usize> {
    /// Their values at time `t`. What `state` is before does not matter.
    fn values(&mut self, t: T, at: Flat<'_, S, T>, state: &mut S::State<T>) -> [T; N];
}

impl<S: System, T: Real, const N: usize, G: FnMut(T, &S::State<T>) -> [T; N]> Conditions<S, T, N> for G {
    #[inline]
    fn values(&mut self, t: T, at: Flat<'_, S, T>, state: &mut S::State<T>) -> [T; N] {
        at.refill(state);
        self(t, state)
    }
}

/// The events that a system declares, all in their order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Declared;

impl<S: Lagrangian<T>, T: Real, const N: usize> Conditions<S, T, N> for Declared {
    #[inline]
    fn values(&mut self, t: T, at: Flat<'_, S, T>, _: &mut S::State<T>) -> [T; N] {
        core::array::from_fn(|index| at.system.event(index, at.q, at.v, t))
    }
}

/// Where a run meets a condition.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // The first passage through the lowest point, a quarter of a period 4 K(sin ½) after the start.
/// let mut run = Integrator::new(&Pendulum, Gauss::<4>::new(), 0.1, start)?;
/// let event = run.events([Direction::Falling], |_, state| [state.angle])?.next_until(10.0)?;
/// let Event { index, time, state } = event.ok_or("it swings")?;
/// assert_eq!(index, 0); // the only condition
/// assert!(state.angle.abs() < 1e-12 && (time - 1.675).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
/// zero one evaluation a step, and one for each stage of [`Gauss`](crate::methods::Gauss) with six and more,
/// with the velocities of the state.
///
/// What follows from an event is the body of the loop: note it, leave the loop, or change the state and go
/// on by [`set_state`](Self::set_state). A run that is to stop at an event is set to its time and state:
/// [`Run::set_state`]; `events` that are asked of it anew begin at the end of its last step, behind what else
/// is in that. Without an event the loop does not end; [`next_until`](Self::next_until) looks for events up
/// to a time.
///
/// Of several events at one time the first in the array comes first. Where a run begins with g = 0 there is
/// no event, and one that lies at the end of a step counts once. A step that ends on the other side has
/// crossed zero once; one that ends on the same side is seen to cross it twice if g turns once on the way,
/// with [`Gauss`](crate::methods::Gauss) of six stages and more if it turns once between two of these and
/// the polynomial through them does, and with [`Impacts`](crate::methods::Impacts) if it turns once before
/// each impact and behind it; a gap that closes there but for rounding is zero, and so an event on the way
/// down.
/// What turns more often may pass unseen, as in steps of other methods over several turns, and what is flat
/// for many steps and dips in a part of one. A condition that jumps across zero, as a velocity does at an
/// impact, is an event behind its jump, and one that comes to zero and stays there is an event where it
/// comes. Events within a step that fails are not found, those before it are. Where events follow each other
/// ever faster, as those of a ball that comes to rest, the run ends with [`StepFailure::Hops`].
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A ball that loses a fifth of its speed on the floor.
/// #[lagrangian(coordinates(height), lagrangian = dot(height).powi(2) / 2.0 - height)]
/// struct Ball;
///
/// let start = BallState { height: 0.5, dot_height: 0.0 };
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
    watch: Watch<R, G, N>,
    /// Whether the iterator has come to its end.
    ended: bool,
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Events<R, G, N> {
    /// Of the run in `dense`, from its present point on.
    pub(super) fn new(mut dense: Dense<R>, directions: [Direction; N], g: G) -> Result<Self, StartError> {
        let watch = Watch::new(&mut dense, directions, g)?;
        Ok(Self { dense, watch, ended: false })
    }

    /// The run, at the end of the step that is searched.
    pub fn run(&self) -> &R {
        &self.dense
    }

    /// The next event that is not after time `t`; `None` if there is none, and the run has come to the step
    /// that leads over `t`. Later events are handed out later, by these same `Events`: others, begun when the
    /// run has come to the end of that step, look from there on.
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
        loop {
            let next = self.watch.next_before(&mut self.dense, end)?;
            let has_come_to = |end| self.watch.is_left() || !self.dense.is_before(self.dense.time(), end);
            if next.is_some() || end.is_some_and(has_come_to) {
                return Ok(next);
            }
            self.step()?;
        }
    }

    /// Hands out an event of the last step or, if there is none left, takes a step and hands out its first,
    /// if there is one.
    ///
    /// # Errors
    /// As [`next_until`](Self::next_until).
    pub fn advance(&mut self) -> Result<Option<EventOf<R>>, StepError> {
        if !self.watch.is_left() {
            self.step()?;
        }
        self.watch.next_before(&mut self.dense, None)
    }

    /// Goes on from another state at time `t`, which is as a rule that of the last event. The run begins
    /// anew, as by [`Run::set_state`]. Conditions that are zero there but for rounding are zero; of the
    /// events that have not been handed out those that happen there too, as in a corner, are handed out
    /// next, and all others are forgotten.
    ///
    /// # Errors
    /// As [`Run::set_state`]. As [`Run::events`]: the run is there then, but no events are known.
    pub fn set_state(&mut self, t: R::Scalar, state: StateOf<R>) -> Result<(), StartError> {
        self.dense.set_state(t, state)?;
        self.watch.begin_anew(&mut self.dense)?;
        self.ended = false;
        Ok(())
    }

    /// Takes a step, and finds its events.
    fn step(&mut self) -> Result<(), StepError> {
        self.watch.check_known()?;
        self.dense.advance()?;
        self.watch.search(&mut self.dense)
    }
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Iterator for Events<R, G, N> {
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

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> FusedIterator for Events<R, G, N> {}

shown!(
    [R: Run + Debug, G, const N: usize] Events<R, G, N>, |events|
    run: events.dense,
    directions: events.watch.directions
);
