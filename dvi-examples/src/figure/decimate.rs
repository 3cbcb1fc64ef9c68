//! Long series without solid blocks: what is drawn is bounded by the pixels, not by the steps.

use std::collections::BTreeSet;

/// Keeps of each pixel column the first, lowest, highest and last point (Jugel et al. 2014): the line
/// looks the same as if all points were drawn. Series that are not sorted by x are left alone.
pub(super) fn by_column(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let sorted = points.is_sorted_by(|a, b| a[0] <= b[0]);
    let columns = points.chunk_by(|a, b| a[0].floor() == b[0].floor());
    if sorted { columns.flat_map(extremes).collect() } else { points }
}

fn extremes(column: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let all = || 0..column.len();
    let by_height = |&i: &usize, &j: &usize| column[i][1].total_cmp(&column[j][1]);
    let kept = [all().next(), all().min_by(by_height), all().max_by(by_height), all().last()];
    let in_order: BTreeSet<usize> = kept.into_iter().flatten().collect();
    in_order.into_iter().map(|i| column[i]).collect()
}

/// The envelope of a series that is too long to be kept: lowest, highest and mean value of each of
/// many equal intervals of time.
#[derive(Clone, Debug)]
pub struct Envelope {
    end: f64,
    bins: Vec<Bin>,
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
    /// An envelope of `bins` intervals of [0, `end`].
    pub fn new(end: f64, bins: usize) -> Self {
        Self { end, bins: vec![EMPTY; bins.max(1)] }
    }

    /// Adds the value at time `t`; times beyond the end count for the last interval.
    pub fn push(&mut self, t: f64, value: f64) {
        let last = self.bins.len() - 1;
        let index = (t / self.end * self.bins.len() as f64) as usize;
        let bin = &mut self.bins[index.min(last)];
        bin.low = bin.low.min(value);
        bin.high = bin.high.max(value);
        bin.sum += value;
        bin.count += 1;
    }

    /// How many intervals there are.
    pub fn intervals(&self) -> usize {
        self.bins.len()
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
    pub fn magnitude(&self) -> Vec<[f64; 2]> {
        self.rows().into_iter().map(|[t, low, _, high]| [t, low.abs().max(high.abs())]).collect()
    }

    /// [t, mean], for a line.
    pub fn mean(&self) -> Vec<[f64; 2]> {
        self.rows().into_iter().map(|[t, _, mean, _]| [t, mean]).collect()
    }
}

/// At most `limit` of the items, evenly spread, in their order.
pub fn thin<T: Copy>(items: &[T], limit: usize) -> Vec<T> {
    items.iter().copied().step_by(items.len().div_ceil(limit.max(1)).max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimation_by_column_keeps_extremes_and_ends() {
        let wave =
            |i: u32| [f64::from(i) * 0.01, (f64::from(i) * 0.7).sin() + if i == 4321 { 9.0 } else { 0.0 }];
        let all: Vec<_> = (0..10_000).map(wave).collect();
        let kept = by_column(all.clone());
        assert!(kept.len() <= 400, "{} points for 100 columns", kept.len());
        assert!(kept.contains(&wave(4321)));
        assert_eq!((kept.first(), kept.last()), (all.first(), all.last()));
        for column in 0..100 {
            let highest = |points: &[[f64; 2]]| {
                let inside = points.iter().filter(|point| point[0].floor() == f64::from(column));
                inside.map(|point| point[1]).fold(f64::NEG_INFINITY, f64::max)
            };
            assert_eq!(highest(&kept), highest(&all));
        }
    }

    #[test]
    fn curves_that_turn_back_are_not_decimated() {
        let circle: Vec<_> = (0..100).map(|i| [f64::from(i).cos(), f64::from(i).sin()]).collect();
        assert_eq!(by_column(circle.clone()), circle);
    }

    #[test]
    fn an_envelope_holds_every_extreme_and_the_mean() {
        let mut envelope = Envelope::new(10.0, 5);
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
        let mut envelope = Envelope::new(10.0, 100);
        envelope.push(0.0, 1.0);
        envelope.push(2.0, 1.0);
        assert_eq!(envelope.mean().len(), 2);
        assert!((envelope.end() - 2.1).abs() < 1e-12, "{}", envelope.end());
    }

    #[test]
    fn thinning_keeps_order_and_respects_the_limit() {
        let thinned = thin(&(0..1001).collect::<Vec<_>>(), 100);
        assert!(thinned.len() <= 100 && thinned.is_sorted() && thinned[0] == 0);
        assert_eq!(thin(&[1, 2, 3], 10), [1, 2, 3]);
        assert_eq!(thin(&[] as &[u8], 10), []);
    }
}
