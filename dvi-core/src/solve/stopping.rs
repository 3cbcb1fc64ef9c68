//! When an iterate is accepted.
//!
//! Each coordinate is judged in the size |q| + |Δ| of its block (the module `sizes`), so that units do not
//! matter: a correction d is the largest of those of the coordinates, each over its size. An iterate is
//! accepted when d is at most the tolerance; or when the rate θ = d/d' at which corrections shrink says that
//! the next one, θ d/(1 − θ) with all that follow, will be (Hairer & Wanner 1996, section IV.8); or when
//! corrections have stopped shrinking and are nothing but rounding errors.
//!
//! What a fixed point leaves over has the same direction in every step, and adds up to a drift however far
//! below the rounding of one step it is (Hairer, McLachlan & Razakarivony 2008). So a tolerance that asks
//! for less than rounding is never reached by a fixed point, and its rounding errors are those that no
//! longer shrink at all. Newton's method squares its error in the iteration that is accepted, and leaves
//! nothing over.
//!
//! Where the terms of an equation cancel, rounding errors are larger than their coordinate says: a body at
//! rest between two springs. What they are is measured where an iterate no longer improves. The unknowns of
//! a fixed point are moved by 2⁻¹⁶ of their sizes: 2¹⁶ times the response of a coordinate is what its
//! rounding errors are relative to. Newton's method is asked for its residual, relative to Σⱼ |Kᵢⱼ| sⱼ in
//! each row of its matrix K, where sⱼ are the sizes of the coordinates: that is the relative error of the
//! equations that the iterate solves (Oettli & Prager 1964).

mod quick;
mod together;

use super::sizes::Due;
use crate::Real;
use crate::error::{StartError, StepFailure};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::reported;

pub(crate) use quick::Quick;
pub(crate) use together::Convergences;

/// The criterion by which an iteration is done.
///
/// ```
#[doc = include_str!("../../docs/hidden/vortices.txt")]
/// let loose = Sigma { stopping: Stopping { tolerance: 1e-8, ..Stopping::default() }, ..Sigma::midpoint() };
/// let mut exact = Integrator::new(&Vortices, Sigma::midpoint(), 0.1, start.clone())?;
/// let mut loose = Integrator::new(&Vortices, loose, 0.1, start)?;
/// exact.take_steps(100)?;
/// loose.take_steps(100)?;
/// assert!(loose.statistics().iterations < exact.statistics().iterations);
/// assert!((loose.state().x[0] - exact.state().x[0]).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// The largest error of a coordinate to accept, relative to its size |q| + |Δ|, where Δ is its
    /// increment, or to the largest of these in its array. Default: 1e-17, below the rounding of double
    /// precision.
    ///
    /// Below the rounding of the arithmetic, an iteration goes on until its corrections no longer shrink.
    /// Units do not matter: with other units of coordinates and of time iterates are the same, scaled. On
    /// four equal vortices in quasi-periodic motion, σ = ½ and h near 0.1, the mean drift of ΣΓ|z|² in eight
    /// runs of 2·10⁵ steps is then 5·10⁻¹⁹ a step, within what rounding errors walk at random; with a
    /// tolerance of 2.3e-16, at which iterations stop as soon as such an error is predicted, it is
    /// 3.5·10⁻¹⁸ (the test `the_fixed_point_leaves_no_bias`).
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
        let in_range = self.tolerance >= 0.0 && self.tolerance < 1.0;
        StartError::unless(in_range, "tolerance", self.tolerance, "0 <= tolerance < 1")?;
        StartError::unless(self.max_iterations > 0, "max_iterations", 0.0, "at least 1")
    }
}

/// So many corrections in turn may be no smaller than the smallest before them.
const MOST_IN_VAIN: usize = 3;

/// Corrections that are no larger than this many units of rounding leave nothing to gain. Where a larger one
/// no longer shrinks, it may be that of one coordinate, beside which others are still to be improved, and
/// one more iteration is taken if the iteration goes to rounding.
const FINE: f64 = 4.0;

/// Corrections no larger than this many units of rounding of the coordinates cannot be told from noise.
pub(crate) const FLOOR: f64 = 32.0;

/// Corrections that are no larger than this part of a coordinate are none, be they still to shrink.
const NOTHING: f64 = 1e-30;

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

/// Newton's method gains nothing in an iteration that leaves more than this part of the correction; at a
/// double root it halves them.
const GAIN: f64 = 0.75;

/// A correction beyond this says that sizes have not been what they are.
const LARGE: f64 = 0.5;

/// What is known of an iterate that no longer improves.
#[derive(Clone, Copy, Debug)]
enum Trial {
    /// It improves, as far as is known.
    None,
    /// It has been moved, and the next correction says how it responds.
    Shaken,
    /// Sizes contain what its rounding errors are relative to.
    Loose,
    /// Instead of a correction it is asked for its residual.
    Asked,
}

/// The corrections of one step so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course<T> {
    /// What the next iteration does first.
    pub(crate) due: Due,
    tolerance: T,
    correction: T,
    /// How many corrections were in vain; of a fixed point, since the smallest.
    in_vain: usize,
    pub(crate) iterations: usize,
    /// The iteration by which it has to be decided.
    last: usize,
    is_fixed_point: bool,
    /// A correction that has shrunk by no more than so many times itself no longer counts as shrinking,
    /// where it is a rounding error.
    stalling: T,
    /// How many more iterations derivatives take that come with the numbers.
    pub(crate) more: usize,
}

/// What judges the corrections of an iteration.
pub(crate) trait Judge<T> {
    /// Whether what fails is to be called by its name: what is not a number may be found at the end of the
    /// step else.
    const NAMES: bool;
    /// Of an iteration that begins.
    fn of(course: Course<T>) -> Self;
    /// Takes note of the size of the latest correction and decides.
    fn judge(&mut self, correction: T) -> Verdict;
    fn course(&mut self) -> &mut Course<T>;
}

/// The judge that puts an iterate to the test which no longer improves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Convergence<T> {
    course: Course<T>,
    trial: Trial,
    /// The tolerance while no correction counts.
    kept: T,
    /// The smallest correction of a fixed point.
    least: T,
}

/// How many iterations of Newton's method after the last bring derivatives of up to third order: each
/// doubles the order.
const MORE_BY_NEWTON: usize = 2;

/// How many a fixed point takes: at a rate of ½ they leave 10⁻¹⁹.
const MORE_BY_FIXED_POINT: usize = 64;

impl<T: Real> Course<T> {
    #[inline]
    pub(crate) fn new(stopping: Stopping, budget: usize) -> Self {
        Self {
            due: Due::Sizes,
            tolerance: T::lift(stopping.tolerance),
            more: if carries_derivatives::<T>() { MORE_BY_NEWTON } else { 0 },
            correction: T::lift(0.0),
            in_vain: 0,
            is_fixed_point: false,
            iterations: 0,
            last: budget,
            stalling: T::lift(1.0),
        }
    }

    #[inline]
    pub(crate) fn fixed_point(stopping: Stopping, budget: usize) -> Self {
        let mut new = Self { is_fixed_point: true, ..Self::new(stopping, budget) };
        if carries_derivatives::<T>() {
            new.more = MORE_BY_FIXED_POINT;
        }
        // Less is asked for than the arithmetic gives: what is left over has the same sign in every step,
        // and adds up however small it is.
        if new.tolerance < T::default_epsilon() {
            (new.tolerance, new.stalling) = (T::lift(NOTHING), T::lift(0.0));
        }
        new
    }

    /// Takes note of a correction, and returns the one before.
    #[inline]
    fn take(&mut self, correction: T) -> T {
        self.iterations += 1;
        core::mem::replace(&mut self.correction, correction)
    }

    #[inline]
    fn is_shrinking(&self, shrunk: T) -> bool {
        shrunk > self.stalling * self.correction
    }

    /// Whether a correction that does not shrink is a rounding error, beside which nothing is left to gain.
    #[inline]
    fn is_noise(&self) -> bool {
        let size = self.correction / T::default_epsilon();
        size <= T::lift(FINE) || size <= T::lift(FLOOR) && (self.stalling > T::lift(0.0) || self.in_vain > 0)
    }

    #[inline]
    fn go_on(&self) -> Verdict {
        if self.iterations >= self.last { Verdict::GiveUp } else { Verdict::Continue }
    }

    /// The failure to report after [`Verdict::GiveUp`].
    #[inline]
    pub(crate) fn failure(&self) -> StepFailure {
        let Self { iterations, correction, tolerance, .. } = *self;
        let [correction, tolerance] = [correction, tolerance].map(reported);
        StepFailure::NotConverged { iterations, correction, tolerance }
    }

    /// A correction that is larger than this part of the one before was in vain.
    fn gain(&self) -> T {
        let creeps = !self.is_fixed_point && self.correction <= T::lift(SMALL);
        T::lift(if creeps { GAIN } else { 1.0 })
    }
}

impl<T: Real> Convergence<T> {
    /// Of an iteration that may take `budget` iterations.
    #[inline]
    pub(crate) fn new(stopping: Stopping, budget: usize) -> Self {
        Self::of(Course::new(stopping, budget))
    }

    /// The same for a fixed point, which gains a constant factor in each iteration.
    #[inline]
    pub(crate) fn fixed_point(stopping: Stopping, budget: usize) -> Self {
        Self::of(Course::fixed_point(stopping, budget))
    }

    /// Decides where corrections no longer shrink as they should, the last one from `before`.
    #[inline]
    fn hesitate(&mut self, before: T) -> Option<Verdict> {
        if self.course.is_noise() && !matches!(self.trial, Trial::Shaken) {
            return Some(Verdict::Accept);
        }
        // What another function sees has no place in registers.
        let verdict;
        (*self, verdict) = self.doubt(before);
        verdict
    }

    /// Puts an iterate to the test that no longer improves, and says how it has ended.
    #[cold]
    #[inline(never)]
    fn doubt(mut self, before: T) -> (Self, Option<Verdict>) {
        let Self { course, trial, kept, least } = &mut self;
        let infinity = T::lift(f64::INFINITY);
        if course.is_fixed_point && before < *least {
            (*least, course.in_vain) = (before, 0);
        }
        // A correction that is not a number is counted by the budget alone.
        let is_vain = course.correction >= course.gain() * before
            && (!course.is_fixed_point || course.correction >= *least);
        if matches!(trial, Trial::None | Trial::Loose) {
            course.in_vain += usize::from(is_vain);
        }
        let is_in_vain = course.in_vain > MOST_IN_VAIN;
        let verdict = match trial {
            Trial::Shaken => {
                (*trial, course.tolerance, course.stalling) = (Trial::Loose, *kept, T::lift(0.0));
                (course.due, course.correction) = (Due::Response, infinity);
                None
            }
            Trial::Asked => {
                // It goes on from where it was, with sizes in the place of which the residual has been.
                (*trial, course.stalling) = (Trial::None, T::lift(1.0));
                (course.due, course.correction) = (Due::Sizes, infinity);
                None
            }
            Trial::Loose => is_in_vain.then_some(Verdict::GiveUp),
            Trial::None if course.is_fixed_point => {
                let is_noise = course.in_vain > 1 && course.correction <= T::lift(SMALL);
                if is_in_vain || is_noise {
                    (*least, course.in_vain, course.last) = (infinity, 0, course.iterations + course.last);
                    (*kept, course.tolerance, course.stalling) = (course.tolerance, T::lift(-1.0), infinity);
                    (*trial, course.due, course.correction) = (Trial::Shaken, Due::Shake, infinity);
                }
                None
            }
            Trial::None if course.in_vain > MOST_IN_VAIN + 1 => Some(Verdict::GiveUp),
            Trial::None => {
                // To ask takes no elimination, and says at once whether anything is left to gain. A
                // coordinate that is nothing but rounding errors has corrections as large as itself.
                if is_in_vain || is_vain && course.correction <= T::lift(LARGE) {
                    (course.last, course.stalling) = (course.last + 1, infinity);
                    (*trial, course.due, course.correction) = (Trial::Asked, Due::Residual, infinity);
                }
                None
            }
        };
        (self, verdict)
    }
}

impl<T: Real> Judge<T> for Convergence<T> {
    const NAMES: bool = true;

    #[inline]
    fn of(course: Course<T>) -> Self {
        let kept = course.tolerance;
        Self { course, trial: Trial::None, kept, least: T::lift(f64::INFINITY) }
    }

    #[inline]
    fn judge(&mut self, correction: T) -> Verdict {
        let Self { course, trial, .. } = self;
        let before = course.take(correction);
        let shrunk = before - correction;
        if correction <= course.tolerance {
            return Verdict::Accept;
        }
        let is_small = correction <= T::lift(LARGE);
        // While an iterate is put to the test, sizes stay as they are.
        if !is_small && matches!(trial, Trial::None) {
            course.due = Due::Sizes;
        }
        if course.iterations > 1 {
            // θ d/(1 − θ) = d²/(d' − d), written without a division. It is negative where corrections grow.
            // Where both sides are so small that they are 0, nothing is known, and neither where sizes have
            // changed.
            if correction * correction < course.tolerance * shrunk && before <= T::lift(LARGE) {
                return Verdict::Accept;
            }
            if !course.is_shrinking(shrunk)
                && let Some(verdict) = self.hesitate(before)
            {
                return verdict;
            }
        }
        self.course.go_on()
    }

    #[inline]
    fn course(&mut self) -> &mut Course<T> {
        &mut self.course
    }
}
