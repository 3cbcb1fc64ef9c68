//! What bodies nearby do to each other one by one.
//!
//! Each pair of cubes is computed once, where the first of the two is the target. What its bodies do to
//! those of the other waits in a place of its own until the sums of the other are taken up: so no sum is
//! written by two, and its terms have one order.

use alloc::vec::Vec;
use core::ops::Range;

use super::lists::{Lists, Pair, on};
use super::packs::{LANES, Pack, add_before, add_lanes, load, load_before};
use super::quantity::Quantity;
use super::shares::Part;
use super::tree::{Cube, Tree};
use crate::scalar::Lanes;
use crate::scalar::widest_if;

/// What acts nearby.
#[derive(Debug)]
pub(super) struct Nearby<'w, Q, const D: usize> {
    pub(super) quantity: &'w Q,
    pub(super) tree: &'w Tree<D>,
    pub(super) lists: &'w Lists,
    pub(super) places: &'w [Vec<f64>; D],
    pub(super) weights: &'w [f64],
}

impl<Q, const D: usize> Clone for Nearby<'_, Q, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Q, const D: usize> Copy for Nearby<'_, Q, D> {}

/// The sums of some cubes of one level over their own bodies and those of later cubes, and what they do to
/// these.
#[derive(Debug)]
pub(super) struct Neighbours<'w, Q, const D: usize> {
    pub(super) by: Nearby<'w, Q, D>,
    pub(super) cubes: Range<usize>,
    /// Those of the list that have these cubes as targets.
    pub(super) near: Range<usize>,
    /// For the bodies of these cubes, from the first one on.
    pub(super) sums: [&'w mut [f64]; D],
    /// For each pair of cubes and each axis, a row of packs.
    pub(super) reactions: &'w mut [Pack],
}

impl<'w, Q, const D: usize> Neighbours<'w, Q, D> {
    pub(super) fn new(
        by: Nearby<'w, Q, D>,
        cubes: Range<usize>,
        sums: [&'w mut [f64]; D],
        reactions: &'w mut [Pack],
    ) -> Self {
        let near = on(&by.lists.near, &cubes);
        Self { by, cubes, near, sums, reactions }
    }
}

impl<Q: Sync, const D: usize> Part for Neighbours<'_, Q, D> {
    fn size(&self) -> usize {
        self.sums[0].len()
    }
    fn halves(self) -> (Self, Option<Self>) {
        let Self { by, cubes, near, mut sums, reactions } = self;
        let count = cubes.len() / 2;
        if count == 0 {
            return (Self { by, cubes, near, sums, reactions }, None);
        }
        let middle = cubes.start + count;
        let bodies = by.tree.cubes[middle].first - by.tree.cubes[cubes.start].first;
        let other_sums = sums.each_mut().map(|sums| {
            let (own, other) = core::mem::take(sums).split_at_mut(bodies);
            *sums = own;
            other
        });
        let between =
            near.start + by.lists.near[near.clone()].partition_point(|pair| (pair.target as usize) < middle);
        let packs = by.lists.packs[between] - by.lists.packs[near.start];
        let (reactions, other_reactions) = reactions.split_at_mut(D * packs);
        let other = Self {
            by,
            cubes: middle..cubes.end,
            near: between..near.end,
            sums: other_sums,
            reactions: other_reactions,
        };
        (Self { by, cubes: cubes.start..middle, near: near.start..between, sums, reactions }, Some(other))
    }
}

impl<Q: Quantity<D>, const D: usize> Neighbours<'_, Q, D> {
    pub(super) fn act(self) {
        let Self { by, cubes, near, mut sums, reactions } = self;
        let (origin, first_pack) = (by.tree.cubes[cubes.start].first, by.lists.packs[near.start]);
        widest_if(
            true,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || {
                let mut kept = [Q::none(); TOGETHER];
                let mut number = near.start;
                for pairs in by.lists.near[near].chunk_by(|pair, next| pair.target == next.target) {
                    let one = &by.tree.cubes[pairs[0].target as usize];
                    let mut later = number;
                    for Pair { target, source } in pairs {
                        if target == source {
                            within(&by, one, origin, &mut sums);
                        }
                        later += usize::from(source <= target);
                    }
                    number += pairs.len();
                    let packs = [later, number].map(|number| D * (by.lists.packs[number] - first_pack));
                    let reactions = &mut reactions[packs[0]..packs[1]];
                    reactions.fill(Pack::all(0.0));
                    for first in one.bodies().step_by(TOGETHER) {
                        let bodies = first..one.past.min(first + TOGETHER);
                        let kept = &mut kept[..bodies.len()];
                        kept.fill(Q::none());
                        let mut rest = &mut *reactions;
                        for pair in &by.lists.near[later..number] {
                            let other = &by.tree.cubes[pair.source as usize];
                            let (own, others) = rest.split_at_mut(D * other.bodies().len().div_ceil(LANES));
                            between(&by, bodies.clone(), other, kept, own);
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
            },
        );
    }
}

/// Bodies of a cube whose sums are kept while other cubes act on them.
const TOGETHER: usize = 64;

/// Adds what the bodies of a cube do to each other.
#[cfg_attr(not(debug_assertions), inline(always))]
fn within<Q: Quantity<D>, const D: usize>(
    by: &Nearby<'_, Q, D>,
    cube: &Cube<D>,
    origin: usize,
    sums: &mut [&mut [f64]; D],
) {
    for first in cube.bodies().step_by(LANES) {
        let past = cube.past.min(first + LANES);
        let mut found = Q::none();
        let at: [Pack; D] = core::array::from_fn(|axis| load(&by.places[axis], first));
        for bodies in [cube.first..first, past..cube.past] {
            for body in bodies {
                let place = core::array::from_fn(|axis| Pack::all(by.places[axis][body]));
                add_one(by.quantity, &mut found, at, (place, Pack::all(by.weights[body])));
            }
        }
        // Each body of the pack with the next one, with the one after that, and so on, but not with itself.
        let places = by.places.each_ref().map(|places| repeated(&places[first..past]));
        let weights = repeated(&by.weights[first..past]);
        for steps in 1..past - first {
            let place = core::array::from_fn(|axis| load(&places[axis], steps));
            add_one(by.quantity, &mut found, at, (place, load(&weights, steps)));
        }
        add_before(cube.past - origin, sums, first - origin, found.as_ref());
    }
}

/// Numbers one after the other, and again from the first.
#[cfg_attr(not(debug_assertions), inline(always))]
fn repeated(numbers: &[f64]) -> [f64; 2 * LANES] {
    core::array::from_fn(|place| numbers[place % numbers.len()])
}

/// Adds what others, given by their places and weights, do to some bodies `at` their places.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_one<Q: Quantity<D>, const D: usize>(
    quantity: &Q,
    found: &mut Q::Sums,
    at: [Pack; D],
    (places, weights): ([Pack; D], Pack),
) {
    let mut difference = at;
    let mut r2 = Pack::all(0.0);
    for axis in 0..D {
        difference[axis] = at[axis] - places[axis];
        r2 += difference[axis] * difference[axis];
    }
    quantity.add_pair(found, weights, &difference, r2);
}

/// Adds what some bodies of one cube and those of an `other` do to each other: to what is `kept` for the
/// ones, and to the `reactions` on the others.
#[cfg_attr(not(debug_assertions), inline(always))]
fn between<Q: Quantity<D>, const D: usize>(
    by: &Nearby<'_, Q, D>,
    bodies: Range<usize>,
    other: &Cube<D>,
    kept: &mut [Q::Sums],
    reactions: &mut [Pack],
) {
    let places_of_other = by.places.each_ref().map(|places| &places[other.bodies()]);
    let weights_of_other = &by.weights[other.bodies()];
    let whole = other.bodies().len() / LANES;
    let (reactions, last) = reactions.split_at_mut(whole * D);
    // In lanes without a body the last one stands, with the weight 0.
    let rest: [Pack; D] = core::array::from_fn(|axis| {
        let places = places_of_other[axis];
        Lanes(core::array::from_fn(|lane| places[(whole * LANES + lane).min(places.len() - 1)]))
    });
    let weights_of_rest = load_before(other.past, by.weights, other.first + whole * LANES);
    for (body, kept) in bodies.zip(kept) {
        let mut found = *kept;
        let body =
            (core::array::from_fn(|axis| Pack::all(by.places[axis][body])), Pack::all(by.weights[body]));
        for (pack, reactions) in reactions.chunks_exact_mut(D).enumerate() {
            let places = core::array::from_fn(|axis| load(places_of_other[axis], pack * LANES));
            let weights = load(weights_of_other, pack * LANES);
            add_both(by.quantity, &mut found, reactions, body, (places, weights));
        }
        if !last.is_empty() {
            add_both(by.quantity, &mut found, last, body, (rest, weights_of_rest));
        }
        *kept = found;
    }
}

/// Adds what one body and several do to each other, each given by its places and weights.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_both<Q: Quantity<D>, const D: usize>(
    quantity: &Q,
    found: &mut Q::Sums,
    reactions: &mut [Pack],
    (at, weight): ([Pack; D], Pack),
    (places, weights): ([Pack; D], Pack),
) {
    let mut difference = at;
    let mut r2 = Pack::all(0.0);
    for axis in 0..D {
        difference[axis] = at[axis] - places[axis];
        r2 += difference[axis] * difference[axis];
    }
    quantity.add_both(found, reactions, [weights, weight], &difference, r2);
}

/// Adds what earlier cubes did to some of a level.
pub(super) fn add_reactions<const D: usize>(
    tree: &Tree<D>,
    lists: &Lists,
    cubes: &Range<usize>,
    reactions: &[Pack],
    sums: &mut [&mut [f64]; D],
) {
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
