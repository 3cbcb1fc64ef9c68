//! What bodies nearby do to each other one by one.
//!
//! Each pair of cubes is computed once, where the first of the two is the target. What its bodies do to
//! those of the other waits in a place of its own until the sums of the other are taken up: so no sum is
//! written by two, and its terms have one order.

use core::marker::PhantomData;
use core::ops::Range;

use super::lists::{Pair, on};
use super::packs::{
    LANES, NOTHING, Pack, add_before, add_lanes, load, load_before, load_places, load_places_before,
    repeat_place,
};
use super::quantity::Quantity;
use super::shares::Piece;
use super::tree::Cube;
use super::work::Sorted;

/// What acts nearby: the quantity Q, of which `factor` is what depends on the squared distance.
pub(super) struct Nearby<'w, Q, F, const D: usize> {
    pub(super) bodies: &'w Sorted<D>,
    pub(super) factor: &'w F,
    pub(super) quantity: PhantomData<fn() -> Q>,
}

impl<Q: Quantity<D>, F: Fn(Pack) -> Pack, const D: usize> Nearby<'_, Q, F, D> {
    /// Adds what the bodies of some cubes do to each other, and sets what they do to those of later cubes:
    /// for each such pair of cubes and each axis, a row of packs.
    pub(super) fn act(&self, Piece { cubes, mut sums, rows: reactions, .. }: Piece<'_, Pack, D>) {
        let Sorted { tree, lists, .. } = self.bodies;
        let near = on(&lists.near, &cubes);
        let (origin, first_pack) = (tree.cubes[cubes.start].first, lists.packs[near.start]);
        widest!({
            let mut kept = [Q::NONE; TOGETHER];
            let mut number = near.start;
            for pairs in lists.near[near].chunk_by(|pair, next| pair.target == next.target) {
                let one = &tree.cubes[pairs[0].target as usize];
                let mut later = number;
                for Pair { target, source } in pairs {
                    if target == source {
                        self.add_within(one, origin, &mut sums);
                    }
                    later += usize::from(source <= target);
                }
                number += pairs.len();
                let packs = [later, number].map(|number| D * (lists.packs[number] - first_pack));
                let reactions = &mut reactions[packs[0]..packs[1]];
                reactions.fill(NOTHING);
                for first in one.bodies().step_by(TOGETHER) {
                    let bodies = first..one.past.min(first + TOGETHER);
                    let kept = &mut kept[..bodies.len()];
                    kept.fill(Q::NONE);
                    let mut rest = &mut *reactions;
                    for pair in &lists.near[later..number] {
                        let other = &tree.cubes[pair.source as usize];
                        let (own, others) = rest.split_at_mut(D * other.bodies().len().div_ceil(LANES));
                        self.add_between(bodies.clone(), other, kept, own);
                        rest = others;
                    }
                    for (axis, sums) in sums.iter_mut().enumerate() {
                        add_lanes(
                            kept.iter().filter_map(|found| found.as_ref().get(axis)),
                            &mut sums[bodies.start - origin..],
                        );
                    }
                }
            }
        });
    }

    /// Adds what the bodies of a cube do to each other.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_within(&self, cube: &Cube<D>, origin: usize, sums: &mut [&mut [f64]; D]) {
        let Sorted { places, weights, .. } = self.bodies;
        for first in cube.bodies().step_by(LANES) {
            let past = cube.past.min(first + LANES);
            let mut found = Q::NONE;
            let at = load_places(places, first);
            for bodies in [cube.first..first, past..cube.past] {
                for body in bodies {
                    let term = of_pair::<Q, D>(self.factor, at, repeat_place(places, body));
                    add(found.as_mut(), term.as_ref(), Pack::all(weights[body]));
                }
            }
            // Each body of the pack with the next one, with the one after that, and so on, but not with
            // itself.
            let mut repeated = [[0.0; 2 * LANES]; D];
            for axis in 0..D {
                repeated[axis] = repeat(&places[axis][first..past]);
            }
            let repeated_weights = repeat(&weights[first..past]);
            for steps in 1..past - first {
                let mut others = at;
                for axis in 0..D {
                    others[axis] = load(&repeated[axis], steps);
                }
                let term = of_pair::<Q, D>(self.factor, at, others);
                add(found.as_mut(), term.as_ref(), load(&repeated_weights, steps));
            }
            add_before(cube.past - origin, sums, first - origin, found.as_ref());
        }
    }

    /// Adds what some bodies of one cube and those of an `other` do to each other: to what is `kept` for the
    /// ones, and to the `reactions` on the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_between(
        &self,
        bodies: Range<usize>,
        other: &Cube<D>,
        kept: &mut [Q::Sums],
        reactions: &mut [Pack],
    ) {
        let Sorted { places, weights, .. } = self.bodies;
        let whole = other.bodies().len() / LANES;
        let (reactions, last) = reactions.split_at_mut(whole * D);
        // In lanes without a body the last one stands, with the weight 0.
        let first_of_rest = other.first + whole * LANES;
        let rest = load_places_before(other.past, places, first_of_rest);
        let weights_of_rest = load_before(other.past, weights, first_of_rest);
        for (body, kept) in bodies.zip(kept) {
            let mut found = *kept;
            let at = repeat_place(places, body);
            let reaction = Pack::all(Q::EXCHANGED * weights[body]);
            for (pack, reactions) in reactions.chunks_exact_mut(D).enumerate() {
                let first = other.first + pack * LANES;
                let term = of_pair::<Q, D>(self.factor, at, load_places(places, first));
                add(found.as_mut(), term.as_ref(), load(weights, first));
                add(reactions, term.as_ref(), reaction);
            }
            if !last.is_empty() {
                let term = of_pair::<Q, D>(self.factor, at, rest);
                add(found.as_mut(), term.as_ref(), weights_of_rest);
                add(last, term.as_ref(), reaction);
            }
            *kept = found;
        }
    }
}

/// What the quantity has of others at their `places` for some bodies `at` theirs, but for the weights.
#[inline]
pub(super) fn of_pair<Q: Quantity<D>, const D: usize>(
    factor: &impl Fn(Pack) -> Pack,
    at: [Pack; D],
    places: [Pack; D],
) -> Q::Sums {
    let mut difference = at;
    let mut r2 = NOTHING;
    for axis in 0..D {
        difference[axis] = at[axis] - places[axis];
        r2 += difference[axis] * difference[axis];
    }
    Q::of_pair(factor(r2), &difference)
}

/// Adds terms times a weight.
#[inline]
fn add(sums: &mut [Pack], terms: &[Pack], weight: Pack) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += *term * weight;
    }
}

/// Bodies of a cube whose sums are kept while other cubes act on them.
const TOGETHER: usize = 64;

/// Numbers one after the other, and again from the first.
#[inline]
fn repeat(numbers: &[f64]) -> [f64; 2 * LANES] {
    core::array::from_fn(|place| numbers[place % numbers.len()])
}

/// Adds what earlier cubes did to some of a level.
pub(super) fn add_reactions<const D: usize>(
    bodies: &Sorted<D>,
    cubes: &Range<usize>,
    reactions: &[Pack],
    sums: &mut [&mut [f64]; D],
) {
    let Sorted { tree, lists, .. } = bodies;
    let origin = tree.cubes[cubes.start].first;
    for number in on(&lists.near, cubes) {
        let Pair { target, source } = lists.near[number];
        if source >= target {
            continue;
        }
        let cube = &tree.cubes[target as usize];
        let from = &reactions[D * lists.packs[lists.opposite[number]]..];
        for (first, found) in cube.bodies().step_by(LANES).zip(from.chunks_exact(D)) {
            add_before(cube.past - origin, sums, first - origin, found);
        }
    }
}
