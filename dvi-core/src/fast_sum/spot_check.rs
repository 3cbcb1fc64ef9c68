//! The sums of a few bodies, held against sums over all others.
//!
//! A kernel need not be what interpolation makes of it: it may have a pole between the nodes, or oscillate
//! faster than cubes are wide. Whether that matters depends on the bodies. So it is looked for in their
//! sums, in each evaluation.

use alloc::vec::Vec;

use super::packs::{LANES, Pack, load, load_before};
use super::quantity::Quantity;
use super::transfer::larger;
use crate::Scalar;
use crate::scalar::Lanes;
use crate::scalar::widest_if;

/// Bodies whose sums are checked, at equal distances in the order of the tree: so they are from all regions.
const BODIES: usize = 8;

/// Whether the sums of some bodies are those over all others, but for `part` of the largest sum of the
/// absolute values of terms.
pub(super) fn holds<Q: Quantity<D>, const D: usize>(
    quantity: &Q,
    (places, weights): (&[Vec<f64>; D], &[f64]),
    sums: &[Vec<f64>; D],
    bodies: usize,
    part: f64,
) -> bool {
    let places = places.each_ref().map(|places| &places[..bodies]);
    let checked = BODIES.min(bodies);
    let (mut apart, mut largest) = (0.0, 0.0);
    for body in (0..checked).map(|number| (2 * number + 1) * bodies / (2 * checked)) {
        let [direct, sizes] = over_all(quantity, (places, weights), body);
        let found = sums.iter().zip(direct.as_ref()).zip(sizes.as_ref());
        for ((sums, direct), size) in found {
            apart = larger(apart, (sums[body] - total(direct)).abs());
            largest = larger(largest, total(size));
        }
    }
    apart <= part * largest
}

/// The sums for one body over all others, and those of the absolute values. There is room behind the last of
/// the weights.
fn over_all<Q: Quantity<D>, const D: usize>(
    quantity: &Q,
    (places, weights): ([&[f64]; D], &[f64]),
    body: usize,
) -> [Q::Sums; 2] {
    let at: [Pack; D] = core::array::from_fn(|axis| Pack::all(places[axis][body]));
    let [mut sums, mut sizes] = [Q::none(); 2];
    widest_if(
        true,
        #[cfg_attr(not(debug_assertions), inline(always))]
        || {
            for others in [0..body, body + 1..places[0].len()] {
                let last = others.end;
                for first in others.step_by(LANES) {
                    let difference =
                        core::array::from_fn(|axis| at[axis] - load_some(places[axis], first, last));
                    let r2 = difference.iter().fold(Pack::all(0.0), |sum, part| sum + *part * *part);
                    let weight = load_before(last, weights, first);
                    let mut term = Q::none();
                    quantity.add_pair(&mut term, weight, &difference, r2);
                    for (number, term) in term.as_ref().iter().enumerate() {
                        sums.as_mut()[number] += *term;
                        sizes.as_mut()[number] += Scalar::abs(*term);
                    }
                }
            }
        },
    );
    [sums, sizes]
}

/// Some numbers before `last`, and the last of them again.
#[cfg_attr(not(debug_assertions), inline(always))]
fn load_some(numbers: &[f64], first: usize, last: usize) -> Pack {
    if first + LANES <= last {
        return load(numbers, first);
    }
    Lanes(core::array::from_fn(|lane| numbers[(first + lane).min(last - 1)]))
}

fn total(pack: &Pack) -> f64 {
    pack.0.iter().sum()
}
