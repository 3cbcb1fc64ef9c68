//! The state at any time within the last step of a run: that step, taken again in part. The run does not
//! notice: what is moved is a copy.

use core::fmt::Debug;
use core::ops::Deref;

use crate::error::{StartError, StepError, StepFailure};
use crate::methods::JUMPS;
#[cfg(doc)]
use crate::methods::Method;
use crate::run::{Run, between::Flat};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::reported;
use crate::shown::shown;
use crate::system::start::step_error;
use crate::{Real, Scalar, Space, System, Vector};

/// A run with its continuous extension: the state at any time of its last step.
///
/// What is called dense output elsewhere is here a part of a step of the method itself, from where the last
/// step of the run began. So no state is less accurate than the points of the run are, but for the error of
/// one step: of order p + 1 for a method of order p, and p for [`Sigma`](crate::methods::Sigma) with σ ≠ ½.
/// The points of the run stay the same, bit for bit. A state costs a step, and to keep where steps begin
/// costs little: it is kept before each step while states are asked for, and else once in up to 64 steps,
/// which are then taken again.
///
/// What can be read of the run is read here too, by `Deref`. `R` is a run, or borrows one by `&mut`, as
/// [`Run::dense`] does. A run by itself keeps no point but the present one.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - x * x) / 2.0)]
/// struct Oscillator;
///
/// let start = OscillatorState { x: 1.0, dot_x: 0.0 };
/// let mut run = Dense::new(Integrator::new(&Oscillator, Gauss::<3>::new(), 0.1, start)?)?;
/// run.advance_to(0.75)?;
/// assert_eq!(run.steps(), 8);
/// for t in [0.75, 0.72, 0.8] {
///     assert!((run.state_at(t)?.x - t.cos()).abs() < 1e-9);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Dense<R: Run> {
    run: R,
    /// When steps at hand have begun.
    begun: R::Scalar,
    /// How many there are.
    taken: u64,
    /// How many there may be before the next point is kept.
    most: u64,
    /// The velocity of a state that is looked at, and that on the other side of a jump.
    v: [Vector<R::System, R::Scalar>; 2],
}

type FlatOf<'a, R> = Flat<'a, <R as Run>::System, <R as Run>::Scalar>;
/// A state of the system of a run `R`.
pub(crate) type StateOf<R> = <<R as Run>::System as System>::State<<R as Run>::Scalar>;
/// A time, and the state of a run there.
pub(super) type Timed<R> = Result<(<R as Run>::Scalar, StateOf<R>), StepError>;

/// The places within a step that are looked at, at most.
pub(super) const PLACES: usize = 8;

/// Parts of a step that differ by no more than so many rounding errors are one.
const TOGETHER: f64 = 16.0;

/// Whether two parts of a step are one but for rounding.
pub(super) fn are_one<T: Real>(a: T, b: T) -> bool {
    Scalar::abs(a - b) <= T::lift(TOGETHER) * T::default_epsilon()
}

/// Whether `t` is the present time of a run, which may have passed it by rounding, in steps of length `h`.
pub(crate) fn is_now<T: Real>(t: T, [now, h]: [T; 2]) -> bool {
    Scalar::abs(now - t) <= T::lift(2.0) * T::default_epsilon() * (Scalar::abs(t) + Scalar::abs(h))
}

/// Steps that may be taken again where nobody asks for states in between.
const LONGEST: u64 = 64;

impl<R: Run> Dense<R> {
    /// From the present point of `run` on. All memory is allocated here.
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin where this one is.
    pub fn new(mut run: R) -> Result<Self, StartError> {
        let (t, h, v) = (run.time(), run.step_size(), run.system().space().vectors());
        let (system, between) = run.between();
        between.begin(system, t, h)?;
        Ok(Self { run, begun: t, taken: 0, most: 1, v })
    }

    /// Takes one step.
    ///
    /// # Errors
    /// As [`Run::advance`]; states within the step before are still known.
    #[inline]
    pub fn advance(&mut self) -> Result<(), StepError> {
        // Steps of a control cannot be taken again by the method alone.
        let is_kept = self.taken >= self.most || self.run.clock().is_none();
        if is_kept {
            self.run.between().1.keep_next();
        }
        let t = self.run.time();
        self.run.advance()?;
        if is_kept {
            self.run.between().1.begin_there();
            (self.begun, self.taken, self.most) = (t, 0, LONGEST.min(2 * self.most));
        }
        self.taken += 1;
        Ok(())
    }

    /// Takes steps until time `t` is within the last one, or at its end; none if it is there already.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`], with both times, if `t` lies before the last step or is not finite.
    /// [`StepError`] of the first step that fails; the run stays at the last good state, and states within
    /// the step before are still known.
    pub fn advance_to(&mut self, t: R::Scalar) -> Result<(), StepError> {
        self.check_ahead(t)?;
        if self.run.clock().is_some() {
            // Whole steps but the last two, of which rounding may be one.
            let ahead = reported((t - self.run.time()) / self.run.step_size()) - 2.0;
            if ahead >= 1.0 {
                let (t, before) = (self.run.time(), self.run.steps());
                self.run.between().1.keep_next();
                let taken = self.run.take_steps(ahead as u64);
                if self.run.steps() > before {
                    self.run.between().1.begin_there();
                    (self.begun, self.taken) = (t, self.run.steps() - before);
                }
                taken?;
            }
        }
        while self.is_before(self.run.time(), t) {
            self.advance()?;
        }
        Ok(())
    }

    /// The state at time `t`, up to which steps are taken as by [`advance_to`](Self::advance_to).
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to); [`StepError`] with the failure of the part of the step that
    /// leads to `t`.
    pub fn state_at(&mut self, t: R::Scalar) -> Result<StateOf<R>, StepError> {
        self.advance_to(t)?;
        // The derivative of a time, if it carries one, is not that of the end of a step.
        let now = self.run.time();
        let is_end = match self.taken {
            0 => is_now(t, [now, self.run.step_size()]),
            _ => t == now && !carries_derivatives::<R::Scalar>(),
        };
        let state = if is_end { self.at_end().map(Flat::state) } else { self.state_within(t) };
        state.map_err(|failure| self.error(failure))
    }

    /// Begins anew as [`Run::set_state`] does.
    ///
    /// # Errors
    /// As [`Run::set_state`].
    pub fn set_state(&mut self, t: R::Scalar, state: StateOf<R>) -> Result<(), StartError> {
        self.run.set_state(t, state)?;
        self.keep();
        Ok(())
    }

    fn keep(&mut self) {
        let (_, between) = self.run.between();
        between.keep_next();
        between.begin_there();
        (self.begun, self.taken) = (self.run.time(), 0);
    }

    /// Whether time `t` is within the last step, or ahead.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`].
    pub(super) fn check_ahead(&self, t: R::Scalar) -> Result<(), StepError> {
        let [begun, now] = [self.last_begun(), self.run.time()];
        let is_ahead =
            reported(t).is_finite() && (!self.is_before(t, begun) || is_now(t, [now, self.run.step_size()]));
        if is_ahead { Ok(()) } else { Err(self.unreachable(t)) }
    }

    /// That time `t` is out of reach.
    #[cold]
    pub(super) fn unreachable(&self, t: R::Scalar) -> StepError {
        let begun = self.last_begun();
        let [now, target] = [begun, t].map(reported);
        let failure = StepFailure::Unreachable { now, target };
        step_error(self.run.system(), self.run.steps(), begun, failure)
    }

    /// Whether `a` lies before `b` in the direction of the run.
    pub(super) fn is_before(&self, a: R::Scalar, b: R::Scalar) -> bool {
        if self.run.step_size() > R::Scalar::lift(0.0) { a < b } else { a > b }
    }

    /// The time when the last step began; the present before the first.
    pub(super) fn last_begun(&self) -> R::Scalar {
        match (self.taken, self.run.clock()) {
            (2.., Some(clock)) => clock.after(1_u64.wrapping_neg()).time(),
            _ => self.begun,
        }
    }

    /// The time at a part of the last step.
    pub(super) fn time_at(&self, part: R::Scalar) -> R::Scalar {
        self.last_begun() + part * self.run.step_size()
    }

    /// Takes the steps again that lead from where one was kept to where the last one began.
    pub(super) fn settle(&mut self) -> Result<(), StepFailure> {
        self.most = 1;
        let (Some(clock), 2..) = (self.run.clock(), self.taken) else { return Ok(()) };
        let (clock, before) = (clock.after(self.taken.wrapping_neg()), self.taken - 1);
        let (system, between) = self.run.between();
        let taken = between.settle(system, clock, before);
        self.begun = clock.after(before).time();
        self.taken = 1;
        if taken.is_err() {
            // They have been taken before; where that leads elsewhere, nothing is known of the last step.
            self.keep();
        }
        taken
    }

    fn state_within(&mut self, t: R::Scalar) -> Result<StateOf<R>, StepFailure> {
        self.settle()?;
        self.reach(t - self.begun).map(|(_, at)| at.state())
    }

    /// The time `h` after the last step began, within this step, and the state there. Where it began is
    /// [settled](Self::settle).
    ///
    /// # Errors
    /// As [`Method::step`] and [`Method::velocity`]; [`StepFailure::LeftDomain`].
    pub(super) fn reach(&mut self, h: R::Scalar) -> Result<(R::Scalar, FlatOf<'_, R>), StepFailure> {
        let whole = self.run.step_size();
        let (system, between) = self.run.between();
        let [v, _] = &mut self.v;
        let q = between.reach(system, self.begun, [h, whole], v)?;
        Ok((self.begun + h, Flat { system, q, v }))
    }

    /// A place within the last step that is known, a jump of the velocity or another: the part of the step,
    /// and the state there or the states before a jump and behind it.
    pub(super) fn at_place(&mut self, jump: bool, index: usize) -> Option<(R::Scalar, [FlatOf<'_, R>; 2])> {
        let (system, between) = self.run.between();
        let (part, q) = between.place(jump, index, self.v.each_mut())?;
        Some((part, self.v.each_ref().map(|v| Flat { system, q, v })))
    }

    /// The time at a part of the last step, and the state there; where its velocity jumps, that behind the
    /// jump.
    pub(super) fn at_part(&mut self, part: R::Scalar) -> Result<(R::Scalar, StateOf<R>), StepFailure> {
        let mut behind_jump = None;
        for jump in 0..JUMPS {
            let Some((place, [_, behind])) = self.at_place(true, jump) else { break };
            if are_one(place, part) {
                behind_jump = Some(behind.state());
            }
        }
        if let Some(state) = behind_jump {
            return Ok((self.time_at(part), state));
        }
        self.settle()?;
        let (t, at) = self.reach(part * self.run.step_size())?;
        Ok((t, at.state()))
    }

    /// The end of the step.
    pub(super) fn at_end(&mut self) -> Result<FlatOf<'_, R>, StepFailure> {
        let t = self.run.time();
        let (system, between) = self.run.between();
        let [v, _] = &mut self.v;
        Ok(Flat { system, q: between.end(system, t, v)?, v })
    }

    /// What has failed in the last step.
    #[cold]
    pub(super) fn error(&self, failure: StepFailure) -> StepError {
        step_error(self.run.system(), self.run.steps().saturating_sub(1), self.last_begun(), failure)
    }
}

impl<R: Run> Deref for Dense<R> {
    type Target = R;

    fn deref(&self) -> &R {
        &self.run
    }
}

shown!([R: Run + Debug] Dense<R>, |dense| run: dense.run);
