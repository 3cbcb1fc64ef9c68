//! When an iterate is accepted.
//!
//! Each coordinate is judged in its own size |q| + |Δ| (the module `sizes`), so that units of coordinates do not matter: a
//! correction d is the largest of those of the coordinates, each over its size. An iterate is accepted when d is at most the
//! tolerance; or when the rate θ = d/d' at which corrections shrink says that the next one, θ d/(1 − θ) with all that
//! follow, will be (Hairer & Wanner 1996, section IV.8); or when corrections have stopped shrinking and are nothing but
//! rounding errors.
//!
//! What a fixed point leaves over has the same direction in every step, and adds up to a drift however far below the
//! rounding of one step it is (Hairer, McLachlan & Razakarivony 2008). So a tolerance that asks for less than rounding
//! is never reached by a fixed point, and its rounding errors are those that no longer shrink at all.
//! Newton's method squares its error in the iteration that is accepted, and leaves nothing over.
//!
//! Where the terms of an equation cancel, rounding errors are larger than their coordinate says, and have no bound that it
//! knows: a body at rest between two springs. There an iterate that no longer improves is put to the test: it is moved by
//! 2⁻¹⁶ of each size, and is accepted if the iteration returns to where its corrections were as small as before. An
//! iteration that does not contract does not return.

mod together;

use super::sizes::Due;
use crate::Real;
use crate::error::{StartError, StepFailure};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{larger, reported};

pub(crate) use together::Convergences;

/// The criterion by which an iteration is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// The largest error of a coordinate to accept, relative to its size |q| + |Δ|, where Δ is its increment. Default: 1e-17,
    /// below the rounding of double precision.
    ///
    /// Below the rounding of the arithmetic, an iteration goes on until its corrections no longer shrink. Units do not
    /// matter: with other units of coordinates and of time the iterates are the same, scaled. On four equal vortices in
    /// quasi-periodic motion, σ = ½ and h = 0.1, ΣΓ|z|² then changes by less than 4e-19 a step over 4·10⁵ steps; an
    /// iteration that stops as soon as an error of 1e-17 is predicted drifts by 1.2e-18.
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

/// What to do with an iterate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Continue,
    Accept,
    /// The corrections grow, or the budget is spent.
    GiveUp,
}

/// Corrections that are this small against the coordinates and do not shrink are rounding errors, as a rule.
const SMALL: f64 = 1e-7;

/// A correction beyond this says that sizes have not been what they are.
const LARGE: f64 = 0.5;

/// By so much a test of an iterate makes corrections larger at least, if it shows anything.
const SHAKEN: f64 = 64.0;

/// Corrections have returned to where they were when they are at most so many times as large.
const RETURNED: f64 = 4.0;

/// What is known of an iterate that no longer improves.
#[derive(Clone, Copy, Debug)]
enum Trial<T> {
    /// It improves, as far as is known.
    None,
    /// It has been moved, and corrections were of this size before.
    Shaken(T),
    /// Corrections have grown since, and are to return to this size.
    Returning(T),
}

/// The corrections of one step so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Convergence<T> {
    /// What the next iteration does first.
    pub(crate) due: Due,
    tolerance: T,
    correction: T,
    growths: usize,
    pub(crate) iterations: usize,
    budget: usize,
    /// The iteration by which it has to be decided.
    last: usize,
    trial: Trial<T>,
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
    /// Of an iteration that may take `budget` iterations.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new(stopping: Stopping, budget: usize) -> Self {
        Self {
            due: Due::Sizes,
            tolerance: T::lift(stopping.tolerance),
            more: if carries_derivatives::<T>() { MORE_BY_NEWTON } else { 0 },
            correction: T::lift(0.0),
            growths: 0,
            iterations: 0,
            budget,
            last: budget,
            trial: Trial::None,
            stalling: T::lift(1.0),
        }
    }

    /// The same for a fixed point, which gains a constant factor in each iteration.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn fixed_point(stopping: Stopping, budget: usize) -> Self {
        let mut new = Self::new(stopping, budget);
        if carries_derivatives::<T>() {
            new.more = MORE_BY_FIXED_POINT;
        }
        if is_below_rounding::<T>(stopping) { Self { stalling: T::lift(0.0), ..new } } else { new }
    }

    /// Takes note of the size of the latest correction and decides.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn judge(&mut self, correction: T) -> Verdict {
        let before = self.correction;
        let shrunk = before - correction;
        self.correction = correction;
        self.iterations += 1;
        if correction <= self.tolerance {
            return Verdict::Accept;
        }
        let is_small = correction <= T::lift(LARGE);
        if !is_small {
            self.resize();
        }
        if self.iterations > 1 {
            // θ d/(1 − θ) = d²/(d' − d), written without a division. It is negative where corrections grow. Where both sides are so
            // small that they are 0, nothing is known, and neither where sizes have changed.
            if correction * correction < self.tolerance * shrunk && before <= T::lift(LARGE) {
                return Verdict::Accept;
            }
            let is_shrinking = shrunk > self.stalling * correction;
            if !is_shrinking && let Some(verdict) = self.hesitate(shrunk) {
                return verdict;
            }
        }
        if self.iterations >= self.last { Verdict::GiveUp } else { Verdict::Continue }
    }

    /// Asks for the sizes that coordinates have now. While an iterate is put to the test they stay as they are.
    #[cold]
    fn resize(&mut self) {
        if matches!(self.trial, Trial::None) {
            self.due = Due::Sizes;
        }
    }

    /// Decides where corrections no longer shrink as they should.
    #[inline]
    fn hesitate(&mut self, shrunk: T) -> Option<Verdict> {
        if self.correction <= T::lift(FLOOR) * T::default_epsilon() {
            return Some(Verdict::Accept);
        }
        self.doubt(shrunk)
    }

    /// Puts an iterate to the test that no longer improves, and says how it has ended.
    #[cold]
    fn doubt(&mut self, shrunk: T) -> Option<Verdict> {
        let has_grown = shrunk <= T::lift(0.0);
        match self.trial {
            Trial::None => {
                self.growths += usize::from(has_grown);
                let is_noise = has_grown && self.correction <= T::lift(SMALL);
                if is_noise || self.growths > MOST_GROWTHS {
                    self.trial = Trial::Shaken(larger(self.correction, self.correction + shrunk));
                    self.due = Due::Shake;
                    self.last = self.iterations + self.budget;
                    // From now on each correction is looked at here.
                    self.stalling = T::lift(f64::INFINITY);
                }
                None
            }
            Trial::Shaken(level) if self.correction >= T::lift(SHAKEN) * level => {
                self.trial = Trial::Returning(level);
                self.growths = 0;
                None
            }
            Trial::Shaken(_) => Some(Verdict::GiveUp),
            Trial::Returning(level) if self.correction <= T::lift(RETURNED) * level => Some(Verdict::Accept),
            Trial::Returning(_) => {
                self.growths += usize::from(has_grown);
                (self.growths > MOST_GROWTHS).then_some(Verdict::GiveUp)
            }
        }
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
