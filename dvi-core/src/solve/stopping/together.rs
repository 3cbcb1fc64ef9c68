//! The convergence of several iterations in lanes, each judged as it would be alone.
//!
//! What is a branch in [`Quick`] is a choice between numbers here, of all lanes at once: 1 stands
//! for yes, 0 for no.

use super::{Course, FINE, FLOOR, LARGE, MOST_IN_VAIN, Stopping, Verdict};
use crate::Scalar;
use crate::scalar::{Comparison, Lanes};

/// The convergence of `W` fixed points that run in step.
#[derive(Debug)]
pub(crate) struct Convergences<const W: usize> {
    tolerance: Lanes<W>,
    correction: Lanes<W>,
    growths: Lanes<W>,
    /// 1 where the iteration goes on, and 0 where it is done.
    active: Lanes<W>,
    /// How many iterations each has taken, and how many those have that go on.
    iterations: Lanes<W>,
    latest: usize,
    budget: usize,
    stalling: Lanes<W>,
}

impl<const W: usize> Convergences<W> {
    /// As a [`Quick`](super::Quick) of a fixed point in each lane.
    pub(crate) fn fixed_point(stopping: Stopping, budget: usize) -> Self {
        let alone = Course::<f64>::fixed_point(stopping, budget);
        let zero = Lanes::all(0.0);
        Self {
            tolerance: Lanes::all(alone.tolerance),
            correction: zero,
            growths: zero,
            active: Lanes::all(1.0),
            iterations: zero,
            latest: 0,
            budget,
            stalling: Lanes::all(alone.stalling),
        }
    }

    /// Whether the next iteration takes the sizes of the coordinates first.
    pub(crate) fn takes_sizes(&self) -> bool {
        self.latest == 0
    }

    /// 1 in the lanes that go on, and 0 in the others.
    #[inline]
    pub(crate) fn active(&self) -> Lanes<W> {
        self.active
    }

    /// How many iterations each lane has taken.
    pub(crate) fn iterations(&self) -> [u64; W] {
        let mut iterations = [0; W];
        for lane in 0..W {
            iterations[lane] = self.iterations.0[lane] as u64;
        }
        iterations
    }

    /// As [`Quick`] judges, in the active lanes: gives up if one of them does, and goes on as long as one
    /// does.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn judge(&mut self, corrections: Lanes<W>) -> Verdict {
        let first = self.latest == 0;
        self.latest += 1;
        self.iterations += self.active;
        let (no, yes) = (Lanes::all(0.0), Lanes::all(1.0));
        let shrunk = self.correction - corrections;
        self.correction = corrections;
        let mut is_last = Lanes::choose(corrections, Comparison::LessOrEqual, self.tolerance, yes, no);
        // A correction that is not a number is not small.
        let is_small = Lanes::choose(corrections, Comparison::LessOrEqual, Lanes::all(LARGE), yes, no);
        let mut is_alone = yes - is_small;
        if !first {
            let stands = Lanes::choose(shrunk, Comparison::Greater, self.stalling * corrections, no, yes);
            let floor = Lanes::all(FLOOR * f64::EPSILON);
            let fine = Lanes::all(FINE * f64::EPSILON);
            let are_noise = Lanes::choose(corrections, Comparison::LessOrEqual, floor, stands, no);
            let are_fine = Lanes::choose(corrections, Comparison::LessOrEqual, fine, stands, no);
            // Where nothing is left to gain, where less than rounding is not asked for, or once more.
            let once_more =
                Lanes::choose(self.growths + self.stalling, Comparison::Greater, no, are_noise, no);
            is_last += self.are_small_later(shrunk) + are_fine + once_more;
            self.growths += Lanes::choose(shrunk, Comparison::LessOrEqual, no, stands, no);
            is_alone += Lanes::choose(
                self.growths,
                Comparison::Greater,
                Lanes::all(MOST_IN_VAIN as f64),
                stands,
                no,
            );
        }
        self.active = Lanes::choose(is_last, Comparison::Greater, no, no, self.active);
        if self.active == no {
            return Verdict::Accept;
        }
        let given_up = Lanes::choose(is_alone, Comparison::Greater, no, self.active, no);
        if given_up == no && self.latest < self.budget { Verdict::Continue } else { Verdict::GiveUp }
    }

    /// Whether all corrections that follow are within the tolerances.
    #[inline]
    fn are_small_later(&self, shrunk: Lanes<W>) -> Lanes<W> {
        let (square, most) = (self.correction * self.correction, self.tolerance * shrunk);
        Lanes::choose(most, Comparison::Greater, square, Lanes::all(1.0), Lanes::all(0.0))
    }
}
