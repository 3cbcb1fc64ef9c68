//! When an iterate is accepted.
//!
//! An iterate is accepted when its last correction d, in the maximum norm, is at most
//! tolerance · (max|q| + max|Δ|); or when the rate θ = d/d' at which corrections shrink says that the
//! next one, θ d/(1 − θ) with all that follow, will be (Hairer & Wanner 1996, section IV.8); or when
//! corrections have stopped shrinking and are nothing but rounding errors of the coordinates.
//!
//! What a fixed point leaves over has the same direction in every step, and adds up to a drift however far below the
//! rounding of one step it is (Hairer, McLachlan & Razakarivony 2008). So a tolerance that asks for less than rounding
//! is judged on the smallest coordinate, and rounding errors of a fixed point are those that no longer shrink at all.
//! Newton's method squares its error in the iteration that is
//! accepted, and leaves nothing over.

mod together;

use crate::Real;
use crate::error::{StartError, StepFailure};
use crate::scalar::norm::{larger, reported, smallest};
use crate::scalar::{carries_derivatives, smallest_normal};

pub(crate) use together::Convergences;

/// The criterion by which an iteration is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// The largest error to accept, relative to max|q| + max|Δ| over all coordinates. Default: 1e-17, below the
    /// rounding of double precision.
    ///
    /// Below the rounding of the arithmetic, it is relative to the smallest |q|, and an iteration that cannot reach that
    /// goes on until its corrections no longer shrink. The correction is one number for all coordinates, and rounding
    /// errors of a large coordinate that is in motion end the iteration for all: beside one of 10⁹ a fixed point leaves
    /// errors of 10⁻⁹ to 10⁻⁷ in the others, [`Solver::Newton`](super::Solver) some 10⁻¹³. On four equal
    /// vortices in quasi-periodic motion, σ = ½ and h = 0.1, ΣΓ|z|² then changes by less than 4e-19 a step over 4·10⁵ steps; an iteration that
    /// stops as soon as an error of 1e-17 of the largest is predicted drifts by 1.2e-18. A larger tolerance is judged on the
    /// largest coordinate.
    pub tolerance: f64,
    /// The largest number of iterations. Default: 100.
    pub max_iterations: usize,
}

impl Default for Stopping {
    fn default() -> Self {
        Self { tolerance: 1e-17, max_iterations: 100 }
    }
}

impl Stopping {
    pub(crate) fn validate(self) -> Result<(), StartError> {
        if !(self.tolerance >= 0.0 && self.tolerance < 1.0) {
            let range = "0 <= tolerance < 1";
            return Err(StartError::Parameter { name: "tolerance", value: self.tolerance, range });
        }
        if self.max_iterations == 0 {
            return Err(StartError::Parameter { name: "max_iterations", value: 0.0, range: "at least 1" });
        }
        Ok(())
    }
}

impl Stopping {
    /// An iteration that may go to rounding goes on until nothing is left to gain: beside compensated sums, which round
    /// less than a step, what it leaves over would be seen.
    pub(crate) fn exhaustive(self) -> Self {
        if is_below_rounding::<f64>(self) { Self { tolerance: 0.0, ..self } } else { self }
    }
}

/// How many times corrections may grow.
const MOST_GROWTHS: usize = 2;

/// Corrections no larger than this many units of rounding of the coordinates cannot be told from noise.
const FLOOR: f64 = 32.0;

impl StepFailure {
    /// Whether an iteration that did not converge has ended in rounding errors of numbers of size `scale`, which is larger than
    /// that of the unknowns where they are differences of these: then it has a solution.
    ///
    /// # Errors
    /// This failure, if it has not.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn unless_rounding<T: Real>(
        self,
        scale: impl FnOnce() -> Result<T, Self>,
    ) -> Result<(), Self> {
        let Self::NotConverged { correction, .. } = self else { return Err(self) };
        let scale = larger(scale().map_or(0.0, reported), reported(smallest_normal::<T>()));
        let floor = FLOOR * reported(T::default_epsilon()) * scale;
        if correction <= floor { Ok(()) } else { Err(self) }
    }
}

/// What to do with an iterate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Continue,
    Accept,
    /// The corrections grow, or the budget is spent.
    GiveUp,
}

/// The corrections of one step so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Convergence<T> {
    tolerance: T,
    /// Rounding errors are relative to the size of the numbers, or to the first correction if that is larger: from zero, or from close
    /// to it, that is the increment. Below the smallest normal number they are absolute.
    scale: T,
    first: T,
    correction: T,
    growths: usize,
    pub(crate) iterations: usize,
    budget: usize,
    /// A correction that has shrunk by no more than so many times itself no longer counts as shrinking, where it is a rounding error.
    stalling: T,
    /// How many more iterations derivatives take that come with the numbers.
    pub(crate) more: usize,
}

/// How many iterations of Newton's method after the last bring derivatives of up to third order: each doubles the order.
const MORE_BY_NEWTON: usize = 2;

/// How many a fixed point takes: at a rate of ½ they leave 10⁻¹⁹.
const MORE_BY_FIXED_POINT: usize = 64;

/// Whether less is asked for than the arithmetic gives.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_below_rounding<T: Real>(stopping: Stopping) -> bool {
    T::lift(stopping.tolerance) < T::default_epsilon()
}

impl<T: Real> Convergence<T> {
    /// Of an iteration that may take `budget` iterations, from `q`, for numbers of size `scale`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new(stopping: Stopping, scale: T, q: &[T], budget: usize) -> Self {
        let judged = if is_below_rounding::<T>(stopping) { smallest(q, scale) } else { scale };
        Self::of(stopping, scale, judged, budget)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(stopping: Stopping, scale: T, judged: T, budget: usize) -> Self {
        Self {
            tolerance: T::lift(stopping.tolerance) * judged,
            more: if carries_derivatives::<T>() { MORE_BY_NEWTON } else { 0 },
            scale,
            first: T::lift(0.0),
            correction: T::lift(0.0),
            growths: 0,
            iterations: 0,
            budget,
            stalling: T::lift(1.0),
        }
    }

    /// The same for a fixed point from `q`, which gains a constant factor in each iteration.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn fixed_point(stopping: Stopping, scale: T, q: &[T], budget: usize) -> Self {
        Self::new(stopping, scale, q, budget).slow(stopping)
    }

    /// The same from a point whose smallest coordinate that is not zero is `smallest`, at most `scale`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of_fixed_point(stopping: Stopping, scale: T, smallest: T, budget: usize) -> Self {
        let judged = if is_below_rounding::<T>(stopping) { smallest } else { scale };
        Self::of(stopping, scale, judged, budget).slow(stopping)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slow(self, stopping: Stopping) -> Self {
        let mut new = self;
        if carries_derivatives::<T>() {
            new.more = MORE_BY_FIXED_POINT;
        }
        if is_below_rounding::<T>(stopping) { Self { stalling: T::lift(0.0), ..new } } else { new }
    }

    /// Takes note of the size of the latest correction and decides.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn judge(&mut self, correction: T) -> Verdict {
        let shrunk = self.correction - correction;
        self.correction = correction;
        self.iterations += 1;
        if correction <= self.tolerance {
            return Verdict::Accept;
        }
        if self.iterations == 1 {
            self.first = correction;
        } else if correction * correction < self.tolerance * shrunk {
            // θ d/(1 − θ) = d²/(d' − d), written without a division. It is negative where corrections grow. Where both sides are so
            // small that they are 0, nothing is known.
            return Verdict::Accept;
        } else {
            let is_shrinking = shrunk > self.stalling * correction;
            if !is_shrinking && let Some(verdict) = self.hesitate(shrunk) {
                return verdict;
            }
        }
        if self.iterations >= self.budget { Verdict::GiveUp } else { Verdict::Continue }
    }

    /// Decides where corrections no longer shrink as they should.
    #[inline]
    fn hesitate(&mut self, shrunk: T) -> Option<Verdict> {
        let size = self.correction / (T::lift(FLOOR) * T::default_epsilon());
        if size <= larger(larger(self.scale, self.first), smallest_normal()) {
            return Some(Verdict::Accept);
        }
        if shrunk <= T::lift(0.0) {
            self.growths += 1;
        }
        (self.growths > MOST_GROWTHS).then_some(Verdict::GiveUp)
    }

    /// The failure to report after [`Verdict::GiveUp`].
    #[cold]
    pub(crate) fn failure(&self) -> StepFailure {
        StepFailure::NotConverged {
            iterations: self.iterations,
            correction: reported(self.correction),
            tolerance: reported(self.tolerance),
        }
    }
}
