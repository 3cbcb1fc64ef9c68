//! The way up: moments of all cubes, from the smallest to the largest.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::{Chebyshev, MOST};
use super::expansion::{Expansion, Row};
use super::packs::{LANES, Pack, add_product, load_before};
use super::polynomials::at_bodies;
use super::transfer::Transfer;
use super::tree::{Cube, Tree};
use crate::scalar::simd::widest_if;
use crate::threads::Part;

/// What moments are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sources<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) tree: &'w Tree<D>,
    pub(super) places: &'w [Vec<f64>; D],
    pub(super) weights: &'w [f64],
    /// What is sent to others from cubes of this level, if anything.
    pub(super) transfer: Option<&'w Transfer>,
    /// The moments of the cubes from the next level on, and the first of these cubes.
    pub(super) below: &'w [f64],
    pub(super) first_below: usize,
}

/// The moments of some cubes of one level.
#[derive(Debug)]
pub(super) struct Moments<'w, const D: usize> {
    pub(super) from: Sources<'w, D>,
    pub(super) cubes: Range<usize>,
    /// Of each cube Σ w B over its bodies; the same, compressed; and room for those of a part.
    pub(super) moments: &'w mut [f64],
    pub(super) sent: &'w mut [f64],
    pub(super) room: &'w mut [f64],
}

impl<const D: usize> Part for Moments<'_, D> {
    fn size(&self) -> usize {
        self.cubes.len()
    }
    fn halves(self) -> (Self, Option<Self>) {
        let Self { from, cubes, moments, sent, room } = self;
        let count = cubes.len() / 2;
        let middle = cubes.start + count;
        let entries = count * from.expansion.basis.len();
        let [(moments, other_moments), (sent, other_sent), (room, other_room)] =
            [moments, sent, room].map(|all| all.split_at_mut(entries));
        let other = Self {
            from,
            cubes: middle..cubes.end,
            moments: other_moments,
            sent: other_sent,
            room: other_room,
        };
        (Self { from, cubes: cubes.start..middle, moments, sent, room }, Some(other))
    }
}

/// Bodies whose polynomials are known at once, in packs.
const TOGETHER: usize = 8;
/// Moments that are summed at once.
const FOUR: usize = 4;

impl<const D: usize> Moments<'_, D> {
    pub(super) fn collect(self) {
        let Self { from, cubes, moments, sent, room } = self;
        let size = from.expansion.basis.len();
        widest_if(
            true,
            #[inline(always)]
            || {
                let mut at = [[Chebyshev::none(); D]; TOGETHER];
                let all = moments.chunks_exact_mut(size).zip(sent.chunks_exact_mut(size));
                for ((number, (moments, sent)), room) in cubes.zip(all).zip(room.chunks_exact_mut(size)) {
                    let cube = &from.tree.cubes[number];
                    moments.fill(0.0);
                    if !cube.is_divided() {
                        of_bodies(&from, cube, &mut at, moments);
                    }
                    for part in cube.parts() {
                        let start = (part - from.first_below) * size;
                        room.copy_from_slice(&from.below[start..start + size]);
                        let Expansion { refinement, rows, .. } = from.expansion;
                        refinement.widen(rows, from.tree.cubes[part].side(), room);
                        moments.iter_mut().zip(&*room).for_each(|(moment, part)| *moment += part);
                    }
                    if let Some(Transfer { rank: rank @ 1.., compression: [compress, _], .. }) = from.transfer
                    {
                        let sent = &mut sent[..*rank];
                        sent.fill(0.0);
                        add_product(sent, compress, moments);
                    }
                }
            },
        );
    }
}

/// Adds the moments of the bodies of a cube.
#[inline(always)]
fn of_bodies<const D: usize>(
    from: &Sources<'_, D>,
    cube: &Cube<D>,
    at: &mut [[Chebyshev<Pack>; D]; TOGETHER],
    moments: &mut [f64],
) {
    let frame = from.tree.frame(cube);
    for group in cube.bodies().step_by(TOGETHER * LANES) {
        let mut weights = [Pack::all(0.0); TOGETHER];
        let mut count = 0;
        for first in (group..cube.past).step_by(LANES).take(TOGETHER) {
            let order = from.expansion.basis.order;
            at_bodies::<D, false>(&mut at[count], order, from.places, frame, first, cube.past);
            weights[count] = load_before(cube.past, from.weights, first);
            count += 1;
        }
        for Row { degrees, first, len } in &from.expansion.rows {
            let mut products = weights;
            for (product, at) in products[..count].iter_mut().zip(&*at) {
                for axis in 0..D - 1 {
                    *product = *product * at[axis].value[degrees[axis]];
                }
            }
            for degree in (0..*len).step_by(FOUR) {
                let mut sums = [Pack::all(0.0); FOUR];
                for (product, at) in products[..count].iter().zip(&*at) {
                    for other in 0..FOUR {
                        // Those behind the last are not used.
                        sums[other] += *product * at[D - 1].value[(degree + other) % MOST];
                    }
                }
                let moments = &mut moments[first + degree..first + len.min(&(degree + FOUR))];
                for (moment, sum) in moments.iter_mut().zip(&sums) {
                    *moment += sum.0.iter().sum::<f64>();
                }
            }
        }
    }
}
