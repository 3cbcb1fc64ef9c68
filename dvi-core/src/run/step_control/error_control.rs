//! Steps whose error is estimated and kept below a tolerance.
//!
//! h' = h e^(−0.7) e₋^(0.4),    e = (ε/a)^(1/k)
//!
//! after a step with estimated error ε, in units of the tolerance, where ε is of order k in h: so e is how
//! many times too long the step was for an error a, and e₋ is that of the step before. This is the
//! proportional–integral controller of Gustafsson 1991, with the constants of Hairer & Wanner 1996, section
//! IV.2. Steps settle at e = 1. After a step that is taken back h' = h/e.

use super::seams::{AtSeam, Seams};
use super::verdict::{FACTORS, Verdict, excess, within};
use super::{ControlledRun, StepControl, breaks};
use crate::error::{StartError, StepError, StepFailure};
use crate::memory::lasting;
use crate::methods::{Carries, Method, Tolerance};
use crate::run::dense::is_now;
use crate::run::{Integrator, Run};
use crate::scalar::norm::{larger, reported};
use crate::system::start::{is_length, step_error};
use crate::{Held, Lagrangian, Real, Scalar, System};

/// A step that has failed is tried again with this part of its length.
const AFTER_FAILURE: f64 = 0.25;
/// The exponents of e and e₋.
const EXPONENTS: [f64; 2] = [-0.7, 0.4];
/// e₋ counts as at least this: what was far too short does not keep the next steps short.
const LEAST_BEFORE: f64 = 0.5;
/// What steps usually are becomes shorter by no more than this from step to step.
const FORGETTING: f64 = 0.9;
/// Steps that are no more than this longer than what is left to a given time lead there.
const STRETCH: f64 = 1.01;

/// Steps whose estimated error is within a tolerance, for those who want a motion up to some time to so many
/// digits, and no form to be preserved.
///
/// **It destroys the long-time behaviour of symplectic and symmetric methods.** A step that is chosen by its
/// error depends on where it begins and not on where it leads, so that the map of a step is neither
/// symplectic nor symmetric, and errors of energy and momenta grow as those of any other method do (Hairer,
/// Lubich & Wanner 2006, section VIII.1). They are within what the tolerance lets through. For long runs
/// take steps of one length, or [`Reversible`](super::Reversible).
///
/// The control is for methods that estimate the error of a step: [`Gauss`](crate::methods::Gauss), with
/// [`EnergyLimit`](crate::methods::EnergyLimit) around it or not. A step that does not meet the tolerance,
/// or fails, is taken back, and tried again with a shorter one;
/// [`Statistics::rejected`](crate::state::Statistics::rejected) counts them. Where no step meets it the run
/// ends with [`StepFailure::Tolerance`].
///
/// The tolerance is that of a step, and steps aim at a fiftieth of it. The error of a run is the sum of what
/// its steps contribute, and goes like the power p/(p + 1) of the tolerance for a method of order p. On
/// twelve motions, four of them not smooth, at 10⁻⁶, 10⁻⁹ and 10⁻¹² it was within 30 tolerances for four and
/// eight stages, and 200 for two (`tests/tests/error_control/problems.rs`). Below some 10⁻¹⁴ it is rounding.
///
/// Steps end where a formula is not smooth, at its [seams](crate::Lagrangian::seam): where the argument of
/// `abs` or `signum` changes its sign, or a comparison by `if`, `min` or `max` its outcome, outside of sums.
/// A step that leads to the other side of one is taken again so that it ends there, to rounding, forward and
/// backward, so that none sees both sides. A seam that is crossed twice within a step is found if it comes
/// nearer at the beginning and goes away at the end; a step in which it turns more often, on a cubic path
/// between the ends, is taken shorter. A motion that does not leave a seam, as a body at rest under dry
/// friction, ends the run with [`StepFailure::Seam`], or with that of a step that does not succeed; one that
/// slides along it may go on in steps that are very short.
///
/// The estimate looks at the whole step: at the `S` stages, at both ends, and between each two stages. A
/// jump or a kink in a term of a sum or in a function of your own, or the knot of a spline, makes steps short
/// where the motion meets it, and the error falls with the tolerance there too: on four motions with seams
/// within sums, at 10⁻⁶ to 10⁻¹², it was within the same bounds as that of the twelve
/// (`tests/tests/error_control/sums.rs`). What comes and goes between two of these points is not seen. A
/// step is at most twice as long as the one before; but on a body at rest or in free motion steps become
/// longer without end: a pulse that such a function gives there needs its times among the
/// [`breaks`](Self::breaks), or a [`longest_step`](Self::longest_step).
///
/// ```
/// use core::f64::consts::TAU;
/// use dvi_core::prelude::*;
///
/// /// A comet.
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 1.0 / (x * x + y * y).sqrt(),
/// )]
/// struct Kepler;
///
/// // An orbit of eccentricity 0.9 at its pericentre.
/// let start = KeplerState { x: 0.1, y: 0.0, dot_x: 0.0, dot_y: 19_f64.sqrt() };
/// let control = ErrorControl::new(1e-10, 0.01);
/// let mut run = Integrator::controlled(&Kepler, Gauss::<8>::new().in_lanes(), control, start)?;
/// run.advance_to(TAU)?;
/// assert!((run.state().x - 0.1).abs() < 1e-8);
/// assert!(run.steps() < 40);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorControl<'a> {
    /// The error that a step may have.
    pub tolerance: Tolerance,
    /// The length of the first step that is tried; negative to run back in time.
    pub first_step: f64,
    /// No step is longer than this, forward or backward; positive. Default: infinite. A force that comes and
    /// goes within a step is seen if it lasts longer than the largest distance of the points that are looked
    /// at: 0.29, 0.17 and 0.092 of a step of 2, 4 and 8 stages.
    pub longest_step: f64,
    /// Times in ascending order at which functions break that a formula calls, as where one of your own
    /// switches a force on: steps end there, to the rounding of the time, forward and backward, and none sees
    /// both sides of a jump. An `if` of a formula needs none: steps end where its side changes, and a step in
    /// which what it compares turns more than once is taken shorter. Default: none.
    ///
    /// ```
    /// use dvi_core::prelude::*;
    /// use dvi_core::Scalar;
    ///
    /// /// A mass that is pushed for a short time.
    /// #[lagrangian(
    ///     coordinates(x),
    ///     functions(push = [push, none, none]),
    ///     lagrangian = dot(x).powi(2) / 2.0,
    ///     force(x) = push(t),
    /// )]
    /// struct Pushed;
    ///
    /// fn push<T: Scalar>(t: T) -> T {
    ///     t.piecewise(|t| if t > 50.0 && t < 50.2 { 1.0 } else { 0.0 })
    /// }
    ///
    /// fn none<T: Scalar>(_: T) -> T {
    ///     T::lift(0.0)
    /// }
    ///
    /// let control = ErrorControl { breaks: &[50.0, 50.2], ..ErrorControl::new(1e-9, 0.01) };
    /// let start = PushedState { x: 0.0, dot_x: 0.0 };
    /// let mut run = Integrator::controlled(&Pushed, Gauss::<8>::new(), control, start)?;
    /// run.advance_to(100.0)?;
    /// assert!((run.state().x - 9.98).abs() < 1e-11 && run.steps() < 20);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub breaks: &'a [f64],
}

impl ErrorControl<'_> {
    /// With the same tolerance for relative and for absolute errors, steps of any length, and no breaks.
    pub fn new(tolerance: f64, first_step: f64) -> Self {
        let tolerance = Tolerance { relative: tolerance, absolute: tolerance };
        Self { tolerance, first_step, longest_step: f64::INFINITY, breaks: &[] }
    }
}

/// What [`ErrorControl`] carries from step to step.
#[derive(Debug)]
pub struct ErrorControlMemory<S: System, T: Real> {
    /// The length of the next step.
    h: T,
    /// The estimated error of the last step, in units of the tolerance; before the first step 1.
    error: T,
    /// e of the last step, at least [`LEAST_BEFORE`].
    excess: T,
    /// How long steps were of late, also where they have become much shorter at once.
    usual: T,
    /// A time that no step goes beyond, if there is one.
    end: Option<T>,
    /// If the system has some.
    seams: Option<Seams<S, T>>,
}

lasting!([S: System, T: Real] ErrorControlMemory<S, T>, T;
    number h, number error, number excess, number usual, parts seams; is_sound);

impl<S: System, T: Real> ErrorControlMemory<S, T> {
    /// The estimated error of the last step, in units of the tolerance; before the first step 1.
    pub fn error(&self) -> T {
        self.error
    }

    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        self.h != T::lift(0.0) && self.excess > T::lift(0.0)
    }
}

impl<H, S: Lagrangian<T>, M, T: Real> Integrator<H, M, T, ErrorControl<'_>>
where
    H: Held<System = S>,
    M: Method<S, T>,
{
    /// Takes steps up to time `t`, of which the last one is as long as it takes to get there, to the
    /// rounding of the time. Nothing is allocated. The present time takes no step.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`] if `t` is past, in the direction of the next
    /// step, or not finite; the run can go on to another time.
    /// [`StepError`] of the first step that fails; the run stays at the last good state.
    pub fn advance_to(&mut self, t: T) -> Result<(), StepError> {
        let now = self.time();
        if !t.is_finite() || !(self.is_before(t) || is_now(t, [now, self.step_size()])) {
            let failure = StepFailure::Unreachable { now: reported(now), target: reported(t) };
            return Err(step_error(self.system(), self.steps(), now, failure));
        }
        let is_ahead = |run: &Self| run.is_before(t) && run.time() + (t - run.time()) != run.time();
        let mut result = Ok(());
        self.control_memory.end = Some(t);
        while result.is_ok() && is_ahead(self) {
            result = self.advance();
        }
        self.control_memory.end = None;
        result
    }

    /// Whether time `t` lies ahead, in the direction of the run.
    fn is_before(&self, t: T) -> bool {
        let now = self.time();
        if self.control_memory.h > T::lift(0.0) { now < t } else { now > t }
    }
}

impl<S: System, T: Real> Carries<S, T> for ErrorControl<'_> {
    type Memory = ErrorControlMemory<S, T>;
}

impl<S: Lagrangian<T>, T: Real> StepControl<S, T> for ErrorControl<'_> {
    type Suited<X> = X;

    const REJECTS: bool = true;

    fn begin(&self, system: &S, _q: &[T], _v: &[T], _t: T) -> Result<(Self::Memory, T), StartError> {
        self.tolerance.validate::<T>()?;
        if !is_length(self.first_step) {
            return Err(StartError::Step { h: self.first_step });
        }
        StartError::unless(self.longest_step > 0.0, "longest_step", self.longest_step, "positive")?;
        if let Some(value) = breaks::misplaced(self.breaks) {
            let range = "finite, and not before the one before it";
            return Err(StartError::Parameter { name: "breaks", value, range });
        }
        let (h, one) = (self.at_most_longest(T::lift(self.first_step)), T::lift(1.0));
        let seams = (S::SEAMS > 0).then(|| Seams::new(system));
        Ok((ErrorControlMemory { h, error: one, excess: one, usual: h, end: None, seams }, h))
    }

    fn admit<M: Method<S, T>>(&self) -> Result<(), StartError> {
        let reason = "the method has no estimate of the error of a step: take `Gauss`; no method for \
                      constraints, impacts or rotations has one";
        StartError::unless_it(M::ESTIMATES_LOCAL_ERROR, "ErrorControl", reason)
    }

    fn step<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure> {
        let usual = larger(Scalar::abs(memory.h), T::lift(FORGETTING) * Scalar::abs(memory.usual));
        let ends = [memory.end, breaks::next(self.breaks, t, memory.h)].into_iter().flatten();
        let left =
            ends.map(|end| end - t).reduce(|a, b| if Scalar::abs(b) < Scalar::abs(a) { b } else { a });
        let is_last = |left: &T| Scalar::abs(*left) <= T::lift(STRETCH) * Scalar::abs(memory.h);
        let mut tried = self.at_most_longest(left.filter(is_last).unwrap_or(memory.h));
        let mut seams = if S::SEAMS > 0 { memory.seams.as_mut() } else { None };
        if let Some(seams) = &mut seams {
            seams.keep(run, t)?;
        }
        let (mut is_first, mut failed) = (true, None);
        let (error, at_seam) = loop {
            let judged = run.step(t, tried).and_then(|()| self.judge(run, &mut seams, t, [tried, usual]));
            let (factor, failure) = match judged {
                Ok(Verdict::Accepted { error, at_seam }) => break (error, at_seam),
                Ok(Verdict::TooLong { factor, failure }) => (factor, failure),
                // The failure of a longer step tells more than that the steps became too short.
                Err(failure @ StepFailure::StepLength { .. }) => return Err(failed.unwrap_or(failure)),
                Err(failure) => (T::lift(AFTER_FAILURE), Some(failure)),
            };
            run.go_back();
            run.statistics().rejected += 1;
            (is_first, failed) = (false, failure.or(failed));
            tried *= factor;
        };
        let h = at_seam.map_or(tried, |AtSeam { behind, .. }| behind);
        if let Some(seams) = seams {
            seams.count(run, [h, usual])?;
        }
        let (e, [now, before]) = (excess(run, error), EXPONENTS.map(T::lift));
        let factor = Scalar::powf(e, now) * Scalar::powf(memory.excess, before);
        let most = if is_first { FACTORS[1] } else { 1.0 };
        let next = self.at_most_longest(h * within(factor, most));
        // A step that is cut short, by the end of the run or by a seam, says little of the next one.
        let uncut = if at_seam.is_some() { tried } else { memory.h };
        let is_cut = (left == Some(h) || at_seam.is_some()) && Scalar::abs(next) < Scalar::abs(uncut);
        memory.h = if is_cut { uncut } else { next };
        (memory.error, memory.excess, memory.usual) = (error, larger(T::lift(LEAST_BEFORE), e), usual);
        Ok(h)
    }
}
