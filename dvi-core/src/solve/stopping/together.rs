//! The convergence of several iterations in lanes, each judged as it would be alone.
//!
//! What is a branch in [`Convergence::judge`] is a choice between numbers here, of all lanes at once: 1 stands for yes, 0 for no.

use super::{Convergence, FLOOR, MOST_GROWTHS, Stopping, Verdict};
use crate::Scalar;
use crate::scalar::{Comparison, Lanes, smallest_normal};

/// The convergence of `W` iterations that run in step.
#[derive(Debug)]
pub(crate) struct Convergences<const W: usize> {
    tolerance: Lanes<W>,
    scale: Lanes<W>,
    first: Lanes<W>,
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
    /// As [`Convergence::of_fixed_point`] in each lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of_fixed_point(
        stopping: Stopping,
        scale: Lanes<W>,
        smallest: Lanes<W>,
        budget: usize,
    ) -> Self {
        let (zero, least) = (Lanes::all(0.0), Lanes::all(smallest_normal()));
        let mut new = Self {
            tolerance: zero,
            scale: Lanes::choose(scale, Comparison::Less, least, least, scale),
            first: zero,
            correction: zero,
            growths: zero,
            active: Lanes::all(1.0),
            iterations: zero,
            latest: 0,
            budget,
            stalling: zero,
        };
        for lane in 0..W {
            let alone = Convergence::of_fixed_point(stopping, scale.0[lane], smallest.0[lane], budget);
            new.tolerance.0[lane] = alone.tolerance;
            new.stalling.0[lane] = alone.stalling;
        }
        new
    }

    /// 1 in the lanes that go on, and 0 in the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn active(&self) -> Lanes<W> {
        self.active
    }

    /// How many iterations each lane has taken.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn iterations(&self) -> [u64; W] {
        let mut iterations = [0; W];
        for lane in 0..W {
            iterations[lane] = self.iterations.0[lane] as u64;
        }
        iterations
    }

    /// [`Convergence::judge`] in the active lanes: gives up if one of them does, and goes on as long as one does.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn judge(&mut self, corrections: Lanes<W>) -> Verdict {
        let first = self.latest == 0;
        self.latest += 1;
        self.iterations += self.active;
        let (no, yes) = (Lanes::all(0.0), Lanes::all(1.0));
        let shrunk = self.correction - corrections;
        self.correction = corrections;
        let mut is_last = Lanes::choose(corrections, Comparison::LessOrEqual, self.tolerance, yes, no);
        if first {
            self.first = corrections;
        } else {
            let are_later = self.are_small_later(shrunk);
            let are_noise = self.are_noise(shrunk);
            is_last = Lanes::choose(is_last + are_later + are_noise, Comparison::Greater, no, yes, no);
            self.growths += Lanes::choose(shrunk, Comparison::LessOrEqual, no, yes, no);
        }
        self.active = Lanes::choose(is_last, Comparison::Greater, no, no, self.active);
        if self.active == no {
            return Verdict::Accept;
        }
        let most = Lanes::all(MOST_GROWTHS as f64);
        let given_up = Lanes::choose(self.growths, Comparison::Greater, most, self.active, no);
        if given_up == no && self.latest < self.budget { Verdict::Continue } else { Verdict::GiveUp }
    }

    /// Whether all corrections that follow are within the tolerances.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_small_later(&self, shrunk: Lanes<W>) -> Lanes<W> {
        let (square, most) = (self.correction * self.correction, self.tolerance * shrunk);
        Lanes::choose(most, Comparison::Greater, square, Lanes::all(1.0), Lanes::all(0.0))
    }

    /// Whether the latest corrections no longer shrink, and are nothing but rounding errors.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_noise(&self, shrunk: Lanes<W>) -> Lanes<W> {
        let (no, yes) = (Lanes::all(0.0), Lanes::all(1.0));
        let largest = Lanes::choose(self.first, Comparison::Greater, self.scale, self.first, self.scale);
        let size = self.correction * Lanes::all(1.0 / (FLOOR * f64::EPSILON));
        let below = Lanes::choose(size, Comparison::LessOrEqual, largest, yes, no);
        Lanes::choose(shrunk, Comparison::Greater, self.stalling * self.correction, no, below)
    }
}

#[cfg(test)]
mod tests {
    use super::{Convergence, Convergences, Stopping, Verdict};
    use crate::scalar::Lanes;

    const LANES: usize = 8;

    /// Corrections that shrink to rounding errors of some size, at different rates, and with every fourth seed some that do not.
    fn correction(lane: usize, iteration: i32, seed: usize) -> f64 {
        let kind = (lane + seed) % LANES;
        let rate = [0.3, 0.1, 0.01, 0.05, 1e-3, 0.15, 1e-5, 0.2][kind];
        let noise = 1e-16 * ((31 * lane + 17 * iteration as usize + 7 * seed) % 5) as f64;
        match kind {
            0 if seed.is_multiple_of(4) => f64::powi(1.1, iteration),
            1 if seed.is_multiple_of(4) => f64::NAN,
            2 if iteration == 4 => 0.0,
            _ => f64::powi(rate, iteration) + noise,
        }
    }

    #[test]
    fn each_lane_is_judged_as_alone() {
        let (mut accepted, mut given_up) = (0, 0);
        for (seed, tolerance) in (0..44).flat_map(|seed| [0.0, 1e-17, 1e-12, 1e-6].map(|t| (seed, t))) {
            let stopping = Stopping { tolerance, ..Stopping::default() };
            let (scale, smallest, budget) = (Lanes::all(2.0), Lanes::all(0.5), 40);
            let of_one: Convergence<f64> = Convergence::of_fixed_point(stopping, 2.0, 0.5, budget);
            let mut alone = [(of_one, Verdict::Continue); LANES];
            let mut together: Convergences<LANES> =
                Convergences::of_fixed_point(stopping, scale, smallest, budget);
            let verdict = loop {
                let iteration = together.latest as i32;
                let corrections = Lanes(core::array::from_fn(|lane| correction(lane, iteration, seed)));
                let verdict = together.judge(corrections);
                for (lane, (convergence, latest)) in alone.iter_mut().enumerate() {
                    if *latest == Verdict::Continue {
                        *latest = convergence.judge(corrections.0[lane]);
                    }
                    let goes_on = f64::from(*latest != Verdict::Accept);
                    assert_eq!(together.active.0[lane], goes_on, "lane {lane}, {iteration}, seed {seed}");
                    assert_eq!(together.iterations()[lane], convergence.iterations as u64);
                }
                let one_has = |verdict| alone.iter().any(|(_, of_lane)| *of_lane == verdict);
                let expected = match (one_has(Verdict::GiveUp), one_has(Verdict::Continue)) {
                    (true, _) => Verdict::GiveUp,
                    (false, true) => Verdict::Continue,
                    (false, false) => Verdict::Accept,
                };
                assert_eq!(verdict, expected, "iteration {iteration}, seed {seed}");
                if verdict != Verdict::Continue {
                    break verdict;
                }
            };
            accepted += usize::from(verdict == Verdict::Accept);
            given_up += usize::from(verdict == Verdict::GiveUp);
        }
        assert!(accepted > 20 && given_up > 20, "{accepted} accepted, {given_up} given up");
    }
}
