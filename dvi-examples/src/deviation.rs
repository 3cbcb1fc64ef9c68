//! How far a conserved quantity is from its initial value in the course of a run, and whether that grows.
//!
//! An error that stays bounded is as large in the beginning of a run as in all of it; one that drifts is
//! not.

use crate::claim::larger;
use crate::figure::Envelope;

/// The deviation of one quantity, absolute or relative.
#[derive(Clone, Debug)]
pub struct Deviation {
    pub envelope: Envelope,
    /// The largest magnitude, in all and in the beginning.
    pub largest: f64,
    pub largest_early: f64,
    /// The latest value, with its sign.
    pub last: f64,
    /// The time at which the beginning ends.
    early: f64,
}

impl Deviation {
    /// The deviation in a run up to time `end`, with an envelope of so many intervals; the beginning is up
    /// to time `early`.
    pub fn new(end: f64, intervals: usize, early: f64) -> Self {
        let envelope = Envelope::new(end, intervals);
        Self { envelope, largest: 0.0, largest_early: 0.0, last: 0.0, early }
    }

    /// Adds the value at time `t`, which is later than those before.
    pub fn push(&mut self, t: f64, value: f64) {
        self.envelope.push(t, value);
        self.largest = larger(self.largest, value.abs());
        self.last = value;
        if t <= self.early {
            self.largest_early = self.largest;
        }
    }

    /// The largest magnitude in all, over that in the beginning.
    pub fn growth(&self) -> f64 {
        self.largest / self.largest_early
    }

    /// The largest magnitude in the last tenth of the intervals, over that in the first.
    pub fn trend(&self) -> f64 {
        let all = self.envelope.magnitude();
        let tenth = all.len().div_ceil(10);
        let largest = |part: &[[f64; 2]]| part.iter().map(|point| point[1]).fold(0.0, larger);
        if self.largest.is_nan() {
            return f64::NAN;
        }
        largest(&all[all.len() - tenth..]) / largest(&all[..tenth])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_the_beginning_belongs_to_it() {
        let mut deviation = Deviation::new(4.0, 4, 2.0);
        for (t, value) in [(1.0, 1.0), (2.0, -2.0), (3.0, 6.0), (4.0, -5.0)] {
            deviation.push(t, value);
        }
        assert_eq!((deviation.largest, deviation.largest_early, deviation.last), (6.0, 2.0, -5.0));
        assert_eq!(deviation.growth(), 3.0);
    }

    #[test]
    fn a_value_that_is_not_a_number_is_not_forgotten() {
        let mut deviation = Deviation::new(2.0, 2, 1.0);
        deviation.push(1.0, f64::NAN);
        deviation.push(2.0, 1.0);
        assert!(deviation.largest.is_nan() && deviation.growth().is_nan() && deviation.trend().is_nan());
    }

    #[test]
    fn a_trend_is_that_of_the_last_tenth() {
        let mut deviation = Deviation::new(20.0, 20, 20.0);
        for k in 0..20 {
            deviation.push(f64::from(k) + 0.5, -f64::from(k + 1));
        }
        assert_eq!(deviation.trend(), 10.0);
    }
}
