//! How far a conserved quantity is from its initial value in the course of a run, and whether that grows.
//!
//! An error that stays bounded is as large in the beginning of a run as in all of it; one that drifts is
//! not.

use anyhow::Result;
use dvi_core::error::StepError;

use crate::figure::{Axis, Envelope, Line, Panel, Points, Stroke};
use crate::numbers::{larger, least};
use crate::output::Table;

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

    /// The largest magnitude in each interval, for a line on a logarithmic axis.
    pub fn magnitude(&self) -> Points {
        self.envelope.magnitude()
    }

    /// The lowest and the highest value; not numbers if one of the values is not.
    pub fn range(&self) -> [f64; 2] {
        let rows = self.envelope.rows();
        let high = rows.iter().map(|row| row[3]).fold(f64::NEG_INFINITY, larger);
        if self.largest.is_nan() { [f64::NAN; 2] } else { [least(rows.iter().map(|row| row[1])), high] }
    }

    /// The largest difference of two values.
    pub fn width(&self) -> f64 {
        let [low, high] = self.range();
        high - low
    }

    /// By how much the mean in the last tenth of the intervals differs from that in the first.
    pub fn drift(&self) -> f64 {
        let means = self.envelope.mean();
        let tenth = (self.envelope.intervals() / 10).max(1).min(means.len());
        let mean = |part: &[[f64; 2]]| part.iter().map(|[_, mean]| mean).sum::<f64>() / part.len() as f64;
        mean(&means[means.len() - tenth..]) - mean(&means[..tenth])
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

/// How long a run is, when its beginning ends, and in how many intervals it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    pub end: f64,
    pub early: f64,
    pub intervals: usize,
}

impl Span {
    /// That of so many steps of length `h`, drawn in 400 intervals, of which so many are the beginning.
    pub fn of(steps: u64, h: f64, early: u64) -> Self {
        Self { end: steps as f64 * h, early: early as f64 * h, intervals: 400 }
    }

    /// How many steps of length `h` it has.
    pub fn steps(self, h: f64) -> u64 {
        (self.end / h).round() as u64
    }

    /// Of several quantities.
    pub fn deviations<const N: usize>(self) -> [Deviation; N] {
        std::array::from_fn(|_| Deviation::new(self.end, self.intervals, self.early))
    }
}

/// Adds the values of several quantities at time `t`.
pub fn note<const N: usize>(kept: &mut [Deviation; N], t: f64, values: [f64; N]) {
    kept.iter_mut().zip(values).for_each(|(deviation, value)| deviation.push(t, value));
}

/// The name of a run, and the line that figures show it with.
pub type Named<'a> = (&'a str, Stroke);

/// A run by its name, by the line that figures show it with, by the length of its steps, by what it should
/// keep, by points of its path, and by the error that has ended it early.
#[derive(Clone, Debug)]
pub struct Series<const N: usize> {
    pub name: String,
    pub stroke: Stroke,
    pub h: f64,
    pub kept: [Deviation; N],
    pub path: Points,
    pub ended: Option<StepError>,
}

impl<const N: usize> Series<N> {
    pub fn new((name, stroke): Named<'_>, h: f64, kept: [Deviation; N]) -> Self {
        Self { name: name.into(), stroke, h, kept, path: Vec::new(), ended: None }
    }

    /// The series of a run that comes to its end.
    pub fn whole(self) -> Result<Self> {
        self.ended.map_or(Ok(self), |error| Err(error.into()))
    }

    /// What the series is, for [`Panel::lines`], over any points.
    pub fn line(&self, points: Points) -> Line<&str> {
        (&self.name, self.stroke, points)
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

/// A line for each run, for [`Panel::lines`]: the largest magnitude of a quantity in each interval of time.
pub fn magnitudes<'a, const N: usize>(
    all: impl IntoIterator<Item = &'a Series<N>>,
    quantity: usize,
) -> Vec<Line<&'a str>> {
    all.into_iter().map(|series| series.line(series.kept[quantity].envelope.magnitude())).collect()
}

/// A panel of that up to time `end`.
pub fn over_time<'a, const N: usize>(
    [title, label]: [&str; 2],
    end: f64,
    [low, high]: [f64; 2],
    all: impl IntoIterator<Item = &'a Series<N>>,
    quantity: usize,
) -> Panel {
    let axis = Axis::logarithmic(label).within(low, high);
    Panel::new(title, Axis::time(end), axis).lines(magnitudes(all, quantity))
}

/// A table with the name of each run, time, and the largest magnitudes of as many quantities as there are
/// columns.
pub fn magnitude_table<'a, const N: usize>(
    columns: &[&str],
    all: impl IntoIterator<Item = &'a Series<N>>,
) -> Result<Table> {
    let quantities = columns.len().saturating_sub(2).min(N);
    let curves = all.into_iter().map(|Series { name, kept, .. }| {
        let others: Vec<_> = kept[1..quantities].iter().map(Deviation::magnitude).collect();
        let rows = kept[0].magnitude().into_iter().enumerate();
        let row = move |(k, first): (usize, [f64; 2])| {
            first.into_iter().chain(others.iter().map(|of| of[k][1])).collect::<Vec<_>>()
        };
        ([name], [], rows.map(row))
    });
    curve_table(columns, curves)
}

/// A table with the name of each run, that of each of its quantities if there is a column for it, and
/// lowest, mean and highest value in each interval of time.
pub fn range_table<'a, const N: usize>(
    columns: &[&str],
    quantities: &[&str],
    all: impl IntoIterator<Item = &'a Series<N>>,
) -> Result<Table> {
    let names = columns.len().saturating_sub(4);
    let curves = all.into_iter().flat_map(|Series { name, kept, .. }| {
        let named = quantities.iter().map(move |quantity| [name, *quantity].into_iter().take(names));
        named.zip(kept).map(|(texts, of)| (texts, [], of.envelope.rows()))
    });
    curve_table(columns, curves)
}

/// A table of curves, each with its names, the numbers that belong to all of it, and its points.
pub fn curve_table<T, N, P, C: Into<Option<f64>>>(
    columns: &[&str],
    curves: impl IntoIterator<Item = (T, N, P)>,
) -> Result<Table>
where
    T: IntoIterator<Item: AsRef<str>> + Clone,
    N: IntoIterator<Item = C> + Clone,
    P: IntoIterator<Item: IntoIterator<Item = C>>,
{
    let rows = curves.into_iter().flat_map(|(names, numbers, points)| {
        let rows = points.into_iter();
        rows.map(move |point| (names.clone(), numbers.clone().into_iter().chain(point).map(Into::into)))
    });
    Table::of(columns, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In intervals of length one.
    fn of<const N: usize>([end, early]: [f64; 2], values: [(f64, f64); N]) -> Deviation {
        let mut deviation = Deviation::new(end, end as usize, early);
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
}
