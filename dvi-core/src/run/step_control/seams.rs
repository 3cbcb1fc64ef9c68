//! Steps that end at the seams of a system, where L or a force is not smooth.
//!
//! A step sees one side of a seam if all of its stages are there. One that leads to the other side is taken
//! again so that it ends where it meets the first seam on its way: the zero, as a function of its length, of
//!
//! min over k of ± gₖ at the end of the step
//!
//! with the sign that makes each seam gₖ positive where the step begins. It ends behind that place by some
//! rounding errors, so that the next step begins on the other side, and its error is estimated where it is
//! as much before it. Where a force pushes away from a seam, the equations of a step have several solutions:
//! one that comes out behind the seam at another than before it is too long. A step that begins on a seam
//! leaves it first, by a step of some rounding errors. Where a seam comes nearer at the beginning of a step
//! and goes away at its end, or where another one is met, its nearest place is looked for; a step over
//! several turns of a seam is too long.

use super::ControlledRun;
use crate::error::StepFailure;
use crate::memory::lasting;
use crate::methods::{Method, Tolerance};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{larger, reported};
use crate::solve::crossing::{Zero, zero};
use crate::{Lagrangian, Real, Scalar, Space, System, Vector};

/// By how many rounding errors of the step a step ends behind a seam, at least. Those of the time are more:
/// a motion that meets a seam some of them late each time gains energy.
const BEHIND: f64 = 4.0;
/// The same of one that leaves a seam on which it begins.
const LEAVING: f64 = 256.0;
/// A step may end so many times farther behind a seam, again and again, if it is not on the other side yet,
/// and at most so many times what is rounded of the step and of the time.
const WIDER: [f64; 2] = [8.0, 262_144.0];
/// From before a seam to behind it a motion goes no farther than so many times the part of the step between
/// them, and so many rounding errors.
const GOES_ON: f64 = 1024.0;
/// Iterations for the derivatives of a length, of numbers that carry some.
const POLISHED: usize = 3;
/// After so many hops for each seam, without a longer step between them, the motion does not leave them. A
/// hop is a step that is shorter than this part of those that were taken, or by half of the digits than
/// usual ones, and begins or ends at a seam, or near one, or is shorter by all of the machine precision.
const HOPS: (usize, f64) = (64, 1e-3);
/// Within so many steps of this length a seam is near.
const NEAR: f64 = 8.0;
/// What is usual fades by this factor with each step, so that a motion may become faster.
const FADING: f64 = 0.98;

/// What the seams of a system ask for.
#[derive(Debug)]
pub(super) struct Seams<S: System, T: Real> {
    /// Where the step begins.
    pub(super) t: T,
    pub(super) q: Vector<S, T>,
    pub(super) v: Vector<S, T>,
    /// The velocity where it ends.
    pub(super) v_end: Vector<S, T>,
    /// A point near by.
    pub(super) near: [Vector<S, T>; 2],
    /// Hops without a longer step between them.
    hops: usize,
    /// How long steps have been, as far as their errors tell, the longest of them fading.
    usual: T,
    /// How long those were that have been taken, in the same way.
    taken: T,
}

/// The lengths of a step that ends on either side of a seam.
#[derive(Clone, Copy)]
pub(super) struct AtSeam<T> {
    /// Zero if the step begins there.
    pub(super) before: T,
    pub(super) behind: T,
}

lasting!([S: System, T: Real] Seams<S, T>, T; count hops, number usual, number taken);

impl<S: Lagrangian<T>, T: Real> Seams<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let ([q, v, v_end], zero) = (system.space().vectors(), T::lift(0.0));
        Self { t: zero, q, v, v_end, near: system.space().vectors(), hops: 0, usual: zero, taken: zero }
    }

    /// Keeps the present point, at time `t`, where steps begin.
    pub(super) fn keep<M: Method<S, T>>(
        &mut self,
        run: &ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<(), StepFailure> {
        self.t = t;
        self.q.copy_from_slice(run.q());
        run.velocity(t, &mut self.v)
    }

    /// Where a step of length `h`, which has been taken, is to end instead, if it leads to the other side of
    /// a seam. The run has then been moved to the place before that. Where the step begins `at_break`, a seam
    /// that is there is left to the break.
    pub(super) fn end<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        h: T,
        at_break: bool,
    ) -> Result<Option<AtSeam<T>>, StepFailure> {
        let [nothing, one] = [0.0, 1.0].map(T::lift);
        let rounding = T::default_epsilon() * (one + Scalar::abs(self.t / h));
        if !at_break && let Some(behind) = self.leave(run, h, T::lift(LEAVING) * rounding)? {
            return Ok(Some(AtSeam { before: nothing, behind }));
        }
        let Some(found) = self.first_crossing(run, h)? else { return Ok(None) };
        let mut place = found.place;
        if carries_derivatives::<T>() {
            // That values have converged says nothing of the derivatives.
            for _ in 0..POLISHED {
                place -= self.look(run, place * h)? / found.slope;
            }
        }
        let [wider, most] = WIDER.map(T::lift);
        let mut margin = T::lift(BEHIND) * T::default_epsilon();
        // By rounding, one has ended before the break.
        let is_left_to_break = at_break && place <= T::lift(2.0 * BEHIND) * rounding;
        while !is_left_to_break && margin < most * rounding {
            let behind = if place + margin < one { (place + margin) * h } else { h };
            // The error is estimated at its end too, which no rounding of the time moves to the other side.
            let short = larger(margin, T::lift(BEHIND) * rounding);
            let before = if place > short { (place - short) * h } else { nothing };
            let (at_behind, at_before) = (self.look(run, behind)?, self.look(run, before)?);
            // Where the step was to end on the seam, the next one leaves it.
            let is_behind = at_behind < nothing || (at_behind == nothing && behind == h);
            if is_behind && at_before >= nothing {
                return Ok(Some(AtSeam { before, behind }));
            }
            margin *= wider;
        }
        // The motion touches the seam, or leaves it where the step begins.
        self.look(run, h)?;
        Ok(None)
    }

    /// The first place of a step of length `h`, which has been taken, at which a seam is crossed. If there
    /// is none the run is at the end of the step.
    fn first_crossing<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        h: T,
    ) -> Result<Option<Zero<T>>, StepFailure> {
        let [nothing, one] = [0.0, 1.0].map(T::lift);
        let at_end = self.ahead(run, h)?.0;
        let crossed = if at_end > nothing { self.dip(run, h)? } else { Some(one) };
        let Some(mut place) = crossed else { return Ok(None) };
        let begin = [nothing, self.look(run, nothing)?];
        loop {
            let last = [place, self.look(run, place * h)?];
            let found = zero([begin, last], &mut |place| self.look(run, place * h))?;
            match self.crossed_before(run, found.place, h)? {
                Some(earlier) => place = earlier,
                None => return Ok(Some(found)),
            }
        }
    }

    /// A part of a step of length `h` at which a seam has been crossed, before that `place` at which one is.
    fn crossed_before<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        place: T,
        h: T,
    ) -> Result<Option<T>, StepFailure> {
        // A long step may have crossed it three times, and another seam twice.
        let middle = T::lift(0.5) * place;
        if self.look(run, middle * h)? < T::lift(0.0) {
            return Ok(Some(middle));
        }
        self.look(run, place * h)?;
        Ok(self.dip(run, place * h)?.map(|low| low * place))
    }

    /// Moves the run from the place before a seam, if it is at one, to that behind it, and returns whether
    /// the motion goes on there, to the `tolerance`.
    pub(super) fn cross<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        at_seam: Option<AtSeam<T>>,
        tolerance: Tolerance,
    ) -> Result<bool, StepFailure> {
        let Some(AtSeam { before, behind }) = at_seam else { return Ok(true) };
        self.near[0].copy_from_slice(run.q());
        run.go_back();
        run.step(self.t, behind)?;
        let (length, between) = (Scalar::abs(behind), Scalar::abs(behind - before));
        let part = T::lift(GOES_ON) * (T::default_epsilon() + between / length);
        let goes_on = |k: usize| {
            let [size, begin, end] = [Scalar::abs(run.q()[k]), self.q[k], run.q()[k]];
            let way =
                length * (Scalar::abs(self.v[k]) + Scalar::abs(self.v_end[k])) + Scalar::abs(end - begin);
            // What is no number is found elsewhere.
            let is_off =
                Scalar::abs(end - self.near[0][k]) > tolerance.of_coordinate(size) + part * (size + way);
            !is_off
        };
        Ok(before == T::lift(0.0) || (0..self.q.len()).all(goes_on))
    }

    /// The length of this `part` of a step, if it leads away from a seam on which the step begins: there a
    /// formula has the value of neither side, or of the wrong one.
    fn leave<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        h: T,
        part: T,
    ) -> Result<Option<T>, StepFailure> {
        let (system, [nothing, one]) = (run.system(), [0.0, 1.0].map(T::lift));
        let is_on = |seams: &Self, seam: usize| seams.at_begin(system, seam) == nothing;
        if !(0..S::SEAMS).any(|seam| is_on(self, seam)) {
            return Ok(None);
        }
        let behind = if part < one { part * h } else { h };
        self.look(run, behind)?;
        let (t, q, v) = (self.t + behind, run.q(), &self.v_end);
        let leaves = (0..S::SEAMS).any(|seam| is_on(self, seam) && system.seam(seam, q, v, t) != nothing);
        if !leaves {
            self.look(run, h)?;
        }
        Ok(leaves.then_some(behind))
    }

    /// Counts a step of length `h` where steps usually have another.
    ///
    /// # Errors
    /// [`StepFailure::Seam`]: nothing is counted then.
    pub(super) fn count<M: Method<S, T>>(
        &mut self,
        run: &ControlledRun<'_, S, M, T>,
        [h, usual]: [T; 2],
    ) -> Result<(), StepFailure> {
        let (length, fading) = (Scalar::abs(h), T::lift(FADING));
        self.usual = larger(usual, fading * self.usual);
        self.taken = larger(length, fading * self.taken);
        let hop = larger(T::lift(HOPS.1) * self.taken, Scalar::sqrt(T::default_epsilon()) * self.usual);
        if length > hop {
            self.hops = 0;
            return Ok(());
        }
        let (_, nearest) = self.ahead(run, h)?;
        let (system, t) = (run.system(), self.t + h);
        let is_near = |&seam: &usize| {
            let (begin, end) = (self.at_begin(system, seam), system.seam(seam, run.q(), &self.v_end, t));
            // A step that leads away, as towards a pole, is none that stays.
            let leads_away = begin * (end - begin) > T::lift(0.0);
            !leads_away && Scalar::abs(begin) <= T::lift(NEAR) * Scalar::abs(end - begin)
        };
        let near = (0..S::SEAMS).find(is_near);
        let no_step = length < T::default_epsilon() * self.usual;
        let Some(seam) = near.or(no_step.then_some(nearest)) else { return Ok(()) };
        if self.hops >= HOPS.0 * S::SEAMS {
            return Err(StepFailure::Seam { seam, time: reported(t) });
        }
        self.hops += 1;
        Ok(())
    }

    /// A seam where the step begins.
    pub(super) fn at_begin(&self, system: &S, seam: usize) -> T {
        system.seam(seam, &self.q, &self.v, self.t)
    }

    /// Moves the run from where the step begins by a length `h`, and looks ahead there.
    pub(super) fn look<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        h: T,
    ) -> Result<T, StepFailure> {
        run.go_back();
        if self.t + h != self.t {
            run.step(self.t, h)?;
        }
        self.ahead(run, h).map(|(ahead, _)| ahead)
    }

    /// How far ahead the nearest seam is after a step of length `h`, negative if it has been crossed, and
    /// which one that is. A step that begins on a seam, and stays there at first, is on neither side of it.
    fn ahead<M: Method<S, T>>(
        &mut self,
        run: &ControlledRun<'_, S, M, T>,
        h: T,
    ) -> Result<(T, usize), StepFailure> {
        let (system, t, nothing) = (run.system(), self.t + h, T::lift(0.0));
        run.velocity(t, &mut self.v_end)?;
        let mut nearest = (T::lift(f64::INFINITY), 0);
        for seam in 0..S::SEAMS {
            let begin = self.at_begin(system, seam);
            let end = system.seam(seam, run.q(), &self.v_end, t);
            let ahead = if begin < nothing { -end } else { end };
            if begin != nothing && ahead < nearest.0 {
                nearest = (ahead, seam);
            }
        }
        Ok(nearest)
    }
}
