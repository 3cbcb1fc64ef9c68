//! The sums of a few bodies, held against sums over all others.
//!
//! A kernel need not be what interpolation makes of it: it may have a pole between the nodes, or oscillate
//! faster than cubes are wide. Whether that matters depends on the bodies. So it is looked for in their
//! sums, in each evaluation.

use alloc::vec::Vec;

use super::neighbours::of_pair;
use super::packs::{LANES, Pack, load_before, load_places_before, repeat_place};
use super::quantity::Quantity;
use super::transfer::larger;
use super::work::Sorted;
use crate::Scalar;

/// Bodies whose sums are checked, at equal distances in the order of the tree: so they are from all regions.
const BODIES: usize = 8;

/// Whether the sums of some bodies are those over all others, but for `part` of the largest sum of the
/// absolute values of terms.
pub(super) fn holds<Q: Quantity<D>, const D: usize>(
    bodies: &Sorted<D>,
    factor: &impl Fn(Pack) -> Pack,
    sums: &[Vec<f64>; D],
    part: f64,
) -> bool {
    let all = bodies.tree.order.len();
    let checked = BODIES.min(all);
    let (mut apart, mut largest) = (0.0, 0.0);
    for body in (0..checked).map(|number| (2 * number + 1) * all / (2 * checked)) {
        let [direct, sizes] = over_all::<Q, D>(bodies, factor, body);
        let found = sums.iter().zip(direct.as_ref()).zip(sizes.as_ref());
        for ((sums, direct), size) in found {
            apart = larger(apart, (sums[body] - total(direct)).abs());
            largest = larger(largest, total(size));
        }
    }
    apart <= part * largest
}

/// The difference of the sums of some bodies, times their weights, from those over all others, relative to
/// these.
pub(super) fn error<Q: Quantity<D>, const D: usize>(
    bodies: &Sorted<D>,
    factor: &impl Fn(Pack) -> Pack,
    sums: &[Vec<f64>; D],
    count: usize,
) -> f64 {
    let all = bodies.tree.order.len();
    let mut pairs = Vec::new();
    for body in (0..all).step_by((all / count.max(1)).max(1)) {
        let [direct, _] = over_all::<Q, D>(bodies, factor, body);
        for (sums, direct) in sums.iter().zip(direct.as_ref()) {
            pairs.push([sums[body], total(direct)].map(|sum| bodies.weights[body] * sum));
        }
    }
    if pairs.iter().flatten().all(|sum| *sum == 0.0) {
        return 0.0;
    }
    // Squares of the largest numbers are none.
    let largest = pairs.iter().fold(0.0, |largest, [_, direct]| larger(largest, direct.abs()));
    let (mut error, mut size) = (0.0, 0.0);
    for [found, direct] in pairs {
        error += (found / largest - direct / largest).powi(2);
        size += (direct / largest).powi(2);
    }
    (error / size).sqrt()
}

/// The sums for one body over all others, and those of the absolute values.
fn over_all<Q: Quantity<D>, const D: usize>(
    Sorted { places, weights, tree, .. }: &Sorted<D>,
    factor: &impl Fn(Pack) -> Pack,
    body: usize,
) -> [Q::Sums; 2] {
    let at = repeat_place(places, body);
    let [mut sums, mut sizes] = [Q::NONE; 2];
    widest!({
        for others in [0..body, body + 1..tree.order.len()] {
            let last = others.end;
            for first in others.step_by(LANES) {
                let place = load_places_before(last, places, first);
                let weight = load_before(last, weights, first);
                let terms = of_pair::<Q, D>(factor, at, place);
                for (number, term) in terms.as_ref().iter().enumerate() {
                    sums.as_mut()[number] += *term * weight;
                    sizes.as_mut()[number] += Scalar::abs(*term * weight);
                }
            }
        }
    });
    [sums, sizes]
}

fn total(pack: &Pack) -> f64 {
    pack.0.iter().sum()
}
