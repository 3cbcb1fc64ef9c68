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
    fn thinning_keeps_order_and_respects_the_limit() {
        let thinned = thin(&(0..1001).collect::<Vec<_>>(), 100);
        assert!(thinned.len() <= 100 && thinned.is_sorted() && thinned[0] == 0);
        assert_eq!(thin(&[1, 2, 3], 10), [1, 2, 3]);
        assert!(thin(&[] as &[u8], 10).is_empty());
    }
}
