//! The way up: moments of all cubes, from the smallest to the largest.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::MOST;
use super::expansion::{Expansion, Row};
use super::matrix::{Batch, Ends, VECTORS};
use super::packs::{LANES, Pack, add_lanes, load_before};
use super::polynomials::coordinates;
use super::shares::Part;
use super::subspace::{Subspace, number};
use super::tree::{Cube, Tree};
use crate::scalar::widest_if;

/// What moments are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sources<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) tree: &'w Tree<D>,
    pub(super) places: &'w [Vec<f64>; D],
    pub(super) weights: &'w [f64],
    /// The functions of this level.
    pub(super) subspace: &'w Subspace,
    /// Those of the next one, if there is one; its moments, and the first of its cubes.
    pub(super) subspace_below: Option<&'w Subspace>,
    pub(super) below: &'w [f64],
    pub(super) first_below: usize,
}

/// The moments of some cubes of one level.
#[derive(Debug)]
pub(super) struct Moments<'w, const D: usize> {
    pub(super) from: Sources<'w, D>,
    pub(super) cubes: Range<usize>,
    /// Of each cube Σ w B over its bodies, for the functions B of the subspace.
    pub(super) moments: &'w mut [f64],
    /// Room for those of one cube in the basis.
    pub(super) room: &'w mut [f64],
}

impl<const D: usize> Part for Moments<'_, D> {
    fn size(&self) -> usize {
        self.cubes.len()
    }
    fn halves(self) -> (Self, Option<Self>) {
        let Self { from, cubes, moments, room } = self;
        let count = cubes.len() / 2;
        let middle = cubes.start + count;
        let (moments, other_moments) = moments.split_at_mut(count * from.subspace.stride);
        let (room, other_room) = room.split_at_mut(count * from.expansion.basis.len());
        let other = Self { from, cubes: middle..cubes.end, moments: other_moments, room: other_room };
        (Self { from, cubes: cubes.start..middle, moments, room }, Some(other))
    }
}

/// Bodies whose polynomials are known at once, in packs.
const TOGETHER: usize = 6;
/// Moments that are summed at once: of four the compiler would mix the lanes.
const AT_ONCE: usize = 3;

impl<const D: usize> Moments<'_, D> {
    pub(super) fn collect(self) {
        let Self { from, cubes, moments, room } = self;
        let (stride, size) = (from.subspace.stride, from.expansion.basis.len());
        let of_part = &from.tree.cubes[cubes.clone()];
        moments.fill(0.0);
        let mut leaves = of_part.iter().enumerate().filter(|(_, cube)| !cube.is_divided());
        let mut at = [[[Pack::all(0.0); TOGETHER]; MOST]; D];
        loop {
            let mut ends = [Ends::default(); VECTORS];
            let mut count = 0;
            widest_if(
                true,
                #[cfg_attr(not(debug_assertions), inline(always))]
                || {
                    let rooms = room.chunks_exact_mut(size).take(VECTORS);
                    for (number, (room, (place, cube))) in rooms.zip(&mut leaves).enumerate() {
                        room.fill(0.0);
                        of_bodies(&from, cube, &mut at, room);
                        ends[number] = Ends { from: number * size, to: place * stride };
                        count = number + 1;
                    }
                },
            );
            if count == 0 {
                break;
            }
            from.subspace.compress.add_products(&ends[..count], room, moments);
        }
        let Some(below) = from.subspace_below else { return };
        for (side, matrix) in below.widen.iter().enumerate() {
            let mut batch = Batch::new();
            for (place, cube) in of_part.iter().enumerate() {
                for part in cube.parts().filter(|part| number(from.tree.cubes[*part].side()) == side) {
                    let ends = Ends { from: (part - from.first_below) * below.stride, to: place * stride };
                    batch.push(ends, matrix, from.below, moments);
                }
            }
            batch.finish(matrix, from.below, moments);
        }
    }
}

/// The polynomials of each degree at several packs of bodies, along each axis.
type Values<const D: usize> = [[[Pack; TOGETHER]; MOST]; D];

/// Adds the moments of the bodies of a cube.
#[cfg_attr(not(debug_assertions), inline(always))]
fn of_bodies<const D: usize>(
    from: &Sources<'_, D>,
    cube: &Cube<D>,
    at: &mut Values<D>,
    moments: &mut [f64],
) {
    let frame = from.tree.frame(cube);
    for group in cube.bodies().step_by(TOGETHER * LANES) {
        let mut weights = [Pack::all(0.0); TOGETHER];
        let mut kept = [Pack::all(0.0); MOST + AT_ONCE];
        let mut count = 0;
        for first in (group..cube.past).step_by(LANES).take(TOGETHER) {
            let u = coordinates(from.places, frame, first, cube.past);
            for (at, u) in at.iter_mut().zip(u) {
                set_values(at, count, u, from.expansion.basis.order);
            }
            weights[count] = load_before(cube.past, from.weights, first);
            count += 1;
        }
        for Row { degrees, first, len } in &from.expansion.rows {
            let mut products = weights;
            for axis in 0..D - 1 {
                let values = &at[axis][degrees[axis]];
                for pack in 0..TOGETHER {
                    products[pack] = products[pack] * values[pack];
                }
            }
            for degree in (0..*len).step_by(AT_ONCE) {
                let mut sums = [Pack::all(0.0); AT_ONCE];
                for pack in 0..count {
                    let product = products[pack];
                    for other in 0..AT_ONCE {
                        // Those behind the last are not used.
                        sums[other] += product * at[D - 1][(degree + other) % MOST][pack];
                    }
                }
                kept[degree..degree + AT_ONCE].copy_from_slice(&sums);
            }
            add_lanes(kept[..*len].iter(), &mut moments[*first..first + len]);
        }
    }
}

/// Sets the polynomials of a pack of bodies at u.
#[cfg_attr(not(debug_assertions), inline(always))]
fn set_values(at: &mut [[Pack; TOGETHER]; MOST], pack: usize, u: Pack, order: usize) {
    let [mut before, mut last] = [Pack::all(1.0), u];
    (at[0][pack], at[1][pack]) = (before, last);
    let twice = u + u;
    for at in &mut at[2..order.max(2)] {
        (before, last) = (last, twice * last - before);
        at[pack] = last;
    }
}
