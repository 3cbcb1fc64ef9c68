//! What is left of a quantity whose run is too long for all of its values to be kept, and whether it grows.
//!
//! An error that stays bounded is as large in the beginning of a run as in all of it; one that drifts is
//! not.

use crate::figure::Points;
use crate::numbers::{larger, largest, least, mean};

/// A quantity over time: lowest, highest and mean value in each of many equal intervals, and how large it is
/// in all.
#[derive(Clone, Debug)]
pub struct Envelope {
    end: f64,
    /// The time at which the beginning ends.
    early: f64,
    bins: Vec<Bin>,
    /// The largest magnitude, in all and in the beginning.
    pub largest: f64,
    pub largest_early: f64,
    /// The latest value, with its sign.
    pub last: f64,
}

#[derive(Clone, Copy, Debug)]
struct Bin {
    low: f64,
    high: f64,
    sum: f64,
    count: u64,
}

const EMPTY: Bin = Bin { low: f64::INFINITY, high: f64::NEG_INFINITY, sum: 0.0, count: 0 };

impl Envelope {
    /// An envelope of `bins` intervals of [0, `end`]; the beginning is up to time `early`.
    pub fn new(end: f64, bins: usize, early: f64) -> Self {
        Self { end, early, bins: vec![EMPTY; bins.max(1)], largest: 0.0, largest_early: 0.0, last: 0.0 }
    }

    /// Adds the value at time `t`, which is later than those before; times beyond the end count for the last
    /// interval.
    pub fn push(&mut self, t: f64, value: f64) {
        let last = self.bins.len() - 1;
        let index = (t / self.end * self.bins.len() as f64) as usize;
        let bin = &mut self.bins[index.min(last)];
        bin.low = bin.low.min(value);
        bin.high = bin.high.max(value);
        bin.sum += value;
        bin.count += 1;
        self.largest = larger(self.largest, value.abs());
        self.last = value;
        if t <= self.early {
            self.largest_early = self.largest;
        }
    }

    /// The end of the last interval that has values.
    pub fn end(&self) -> f64 {
        let filled = self.bins.iter().rposition(|bin| bin.count > 0).map_or(0, |last| last + 1);
        self.end / self.bins.len() as f64 * filled as f64
    }

    /// [t, lowest, mean, highest] of each interval that has values, at the middle of the interval.
    pub fn rows(&self) -> Vec<[f64; 4]> {
        let width = self.end / self.bins.len() as f64;
        let filled = self.bins.iter().enumerate().filter(|(_, bin)| bin.count > 0);
        filled.map(|(i, b)| [(i as f64 + 0.5) * width, b.low, b.sum / b.count as f64, b.high]).collect()
    }

    /// [t, lowest, highest], for a band.
    pub fn band(&self) -> Vec<[f64; 3]> {
        self.rows().into_iter().map(|[t, low, _, high]| [t, low, high]).collect()
    }

    /// [t, largest magnitude], for a line on a logarithmic axis.
    pub fn magnitude(&self) -> Points {
        self.rows().into_iter().map(|[t, low, _, high]| [t, low.abs().max(high.abs())]).collect()
    }

    /// [t, mean], for a line.
    pub fn mean(&self) -> Points {
        self.rows().into_iter().map(|[t, _, mean, _]| [t, mean]).collect()
    }

    /// The largest magnitude in all, over that in the beginning.
    pub fn growth(&self) -> f64 {
        self.largest / self.largest_early
    }

    /// The lowest and the highest value; not numbers if one of the values is not.
    pub fn range(&self) -> [f64; 2] {
        let high = -least(self.bins.iter().map(|bin| -bin.high));
        if self.largest.is_nan() {
            [f64::NAN; 2]
        } else {
            [least(self.bins.iter().map(|bin| bin.low)), high]
        }
    }

    pub fn width(&self) -> f64 {
        let [low, high] = self.range();
        high - low
    }

    /// By how much the mean in the last tenth of the intervals differs from that in the first.
    pub fn drift(&self) -> f64 {
        let means = self.mean();
        let tenth = (self.bins.len() / 10).max(1).min(means.len());
        let of = |part: &[[f64; 2]]| mean(part.iter().map(|[_, mean]| *mean));
        of(&means[means.len() - tenth..]) - of(&means[..tenth])
    }

    /// The largest magnitude in the last tenth of the intervals, over that in the first.
    pub fn trend(&self) -> f64 {
        let all = self.magnitude();
        let tenth = all.len().div_ceil(10);
        let of = |part: &[[f64; 2]]| largest(part.iter().map(|point| point[1]));
        let ratio = of(&all[all.len() - tenth..]) / of(&all[..tenth]);
        if self.largest.is_nan() { f64::NAN } else { ratio }
    }
}

/// The largest values of several quantities in each interval of the logarithm of time.
#[derive(Clone, Debug)]
pub struct Decades<const N: usize> {
    intervals_of_each: f64,
    /// Where the latest interval ends.
    end: f64,
    /// The first time in each interval, and the largest values.
    pub rows: Vec<(f64, [f64; N])>,
}

impl<const N: usize> Decades<N> {
    /// With so many intervals in a factor of ten.
    pub fn new(intervals_of_each: f64) -> Self {
        Self { intervals_of_each, end: f64::MIN_POSITIVE, rows: Vec::new() }
    }

    /// Adds values at time `t` > 0, which is later than those before.
    pub fn push(&mut self, t: f64, values: [f64; N]) {
        if t >= self.end {
            let interval = (t.log10() * self.intervals_of_each).floor();
            self.end = 10f64.powf((interval + 1.0) / self.intervals_of_each);
            self.rows.push((t, [0.0; N]));
        }
        if let Some((_, row)) = self.rows.last_mut() {
            *row = std::array::from_fn(|i| larger(row[i], values[i]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In intervals of length one.
    fn of<const N: usize>([end, early]: [f64; 2], values: [(f64, f64); N]) -> Envelope {
        let mut deviation = Envelope::new(end, end as usize, early);
        values.into_iter().for_each(|(t, value)| deviation.push(t, value));
        deviation
    }

    #[test]
    fn the_end_of_the_beginning_belongs_to_it() {
        let deviation = of([4.0, 2.0], [(1.0, 1.0), (2.0, -2.0), (3.0, 6.0), (4.0, -5.0)]);
        assert_eq!((deviation.largest, deviation.largest_early, deviation.last), (6.0, 2.0, -5.0));
        assert_eq!(deviation.growth(), 3.0);
    }

    #[test]
    fn a_value_that_is_not_a_number_is_not_forgotten() {
        let deviation = of([2.0, 1.0], [(1.0, f64::NAN), (2.0, 1.0)]);
        assert!(deviation.largest.is_nan() && deviation.growth().is_nan() && deviation.trend().is_nan());
    }

    #[test]
    fn a_trend_is_that_of_the_last_tenth() {
        let values = std::array::from_fn::<_, 20, _>(|k| (k as f64 + 0.5, -(k as f64 + 1.0)));
        assert_eq!(of([20.0; 2], values).trend(), 10.0);
    }

    #[test]
    fn an_envelope_holds_every_extreme_and_the_mean() {
        let mut envelope = Envelope::new(10.0, 5, 0.0);
        for i in 0..=1000 {
            let t = f64::from(i) * 0.01;
            envelope.push(t, if i == 777 { -50.0 } else { t });
        }
        let rows = envelope.rows();
        assert_eq!(rows.len(), 5);
        assert_eq!((rows[0][0], rows[0][1], rows[0][3]), (1.0, 0.0, 1.99));
        assert!((rows[0][2] - 0.995).abs() < 1e-12);
        assert_eq!(rows[3][1], -50.0);
        assert_eq!(rows[4][3], 10.0);
    }

    #[test]
    fn an_envelope_shows_only_what_was_reached() {
        let mut envelope = Envelope::new(10.0, 100, 0.0);
        envelope.push(0.0, 1.0);
        envelope.push(2.0, 1.0);
        assert_eq!(envelope.mean().len(), 2);
        assert!((envelope.end() - 2.1).abs() < 1e-12, "{}", envelope.end());
    }
}
