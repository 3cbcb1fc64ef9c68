//! The way down: what far cubes do, as local expansions, from the largest cubes to the smallest and from
//! these to the bodies.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::{Chebyshev, set_polynomials};
use super::expansion::{Expansion, Row};
use super::lists::{Lists, Pair, on};
use super::matrix::{Batch, Ends, VECTORS, padded};
use super::neighbours::add_reactions;
use super::packs::{LANES, Pack, add_before};
use super::polynomials::coordinates;
use super::quantity::Quantity;
use super::shares::Part;
use super::subspace::{Subspace, number};
use super::transfer::Transfer;
use super::tree::Tree;
use crate::scalar::widest_if;

/// What acts on the cubes of a level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Actions<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) tree: &'w Tree<D>,
    pub(super) places: &'w [Vec<f64>; D],
    /// For each offset, the cubes of the level that act on others as wholes.
    pub(super) far: &'w [Vec<Pair>],
    pub(super) lists: &'w Lists,
    /// What bodies of earlier cubes do one by one.
    pub(super) reactions: &'w [Pack],
    pub(super) transfer: Option<&'w Transfer>,
    /// The functions of the level, if cubes of this level or larger ones act as wholes.
    pub(super) subspace: Option<&'w Subspace>,
    /// The moments of all cubes of the level, and the first of these cubes.
    pub(super) moments: &'w [f64],
    pub(super) first: usize,
    /// The functions of the level before, if they are there; its local expansions, and the first of its
    /// cubes.
    pub(super) subspace_above: Option<&'w Subspace>,
    pub(super) above: &'w [f64],
    pub(super) first_above: usize,
}

/// What is summed for some cubes of one level.
#[derive(Debug)]
pub(super) struct Locals<'w, const D: usize> {
    pub(super) by: Actions<'w, D>,
    pub(super) cubes: Range<usize>,
    /// For each cube the potential of far cubes in it.
    pub(super) locals: &'w mut [f64],
    /// Room for that of one cube in the basis.
    pub(super) room: &'w mut [f64],
    /// For the bodies of these cubes, from the first one on.
    pub(super) sums: [&'w mut [f64]; D],
}

impl<const D: usize> Part for Locals<'_, D> {
    fn size(&self) -> usize {
        self.sums[0].len()
    }
    fn halves(self) -> (Self, Option<Self>) {
        let Self { by, cubes, locals, room, mut sums } = self;
        let count = cubes.len() / 2;
        if count == 0 {
            return (Self { by, cubes, locals, room, sums }, None);
        }
        let middle = cubes.start + count;
        let bodies = by.tree.cubes[middle].first - by.tree.cubes[cubes.start].first;
        let stride = by.subspace.map_or(0, |subspace| subspace.stride);
        let (locals, other_locals) = locals.split_at_mut(count * stride);
        let size = by.subspace.map_or(0, |_| padded(by.expansion.basis.len()));
        let (room, other_room) = room.split_at_mut(count * size);
        let other_sums = sums.each_mut().map(|sums| {
            let (own, other) = core::mem::take(sums).split_at_mut(bodies);
            *sums = own;
            other
        });
        let other =
            Self { by, cubes: middle..cubes.end, locals: other_locals, room: other_room, sums: other_sums };
        (Self { by, cubes: cubes.start..middle, locals, room, sums }, Some(other))
    }
}

impl<const D: usize> Locals<'_, D> {
    pub(super) fn distribute<Q: Quantity<D>>(mut self) {
        if let Some(subspace) = self.by.subspace {
            self.locals.fill(0.0);
            self.inherit(subspace);
            self.exchange(subspace);
            self.evaluate::<Q>(subspace);
        }
        let Self { by, cubes, mut sums, .. } = self;
        add_reactions(by.tree, by.lists, &cubes, by.reactions, &mut sums);
    }

    /// What acts on the cubes around these.
    fn inherit(&mut self, subspace: &Subspace) {
        let Self { by, cubes, locals, .. } = self;
        let Some(above) = by.subspace_above else { return };
        for (side, matrix) in subspace.narrow.iter().enumerate() {
            let mut batch = Batch::new();
            for (place, cube) in by.tree.cubes[cubes.clone()].iter().enumerate() {
                if number(cube.side()) == side {
                    let from = (cube.whole - by.first_above) * above.stride;
                    batch.push(Ends { from, to: place * subspace.stride }, matrix, by.above, locals);
                }
            }
            batch.finish(matrix, by.above, locals);
        }
    }

    /// What other cubes of the level do as wholes.
    fn exchange(&mut self, subspace: &Subspace) {
        let Self { by, cubes, locals, .. } = self;
        let Some(transfer) = by.transfer else { return };
        for (list, matrix) in by.far.iter().zip(&transfer.matrices) {
            let mut batch = Batch::new();
            for Pair { target, source } in &list[on(list, cubes)] {
                let from = (*source as usize - by.first) * subspace.stride;
                let to = (*target as usize - cubes.start) * subspace.stride;
                batch.push(Ends { from, to }, matrix, by.moments, locals);
            }
            batch.finish(matrix, by.moments, locals);
        }
    }

    /// What the expansions are at the bodies of the cubes that are not divided.
    fn evaluate<Q: Quantity<D>>(&mut self, subspace: &Subspace) {
        let Self { by, cubes, locals, room, sums } = self;
        let Expansion { basis, rows, .. } = by.expansion;
        let size = padded(basis.len());
        let first = by.tree.cubes[cubes.start].first;
        let all = by.tree.cubes[cubes.clone()].iter().enumerate();
        let mut leaves = all.filter(|(_, cube)| !cube.is_divided());
        let mut at = [[Chebyshev::none(); D]; TOGETHER];
        loop {
            let mut some = [None; VECTORS];
            let mut ends = [Ends::default(); VECTORS];
            let mut count = 0;
            for (number, (place, cube)) in (0..VECTORS.min(room.len() / size)).zip(&mut leaves) {
                some[number] = Some(cube);
                ends[number] = Ends { from: place * subspace.stride, to: number * size };
                count = number + 1;
            }
            if count == 0 {
                break;
            }
            room[..count * size].fill(0.0);
            subspace.expand.add_products(&ends[..count], locals, room);
            widest_if(
                true,
                #[cfg_attr(not(debug_assertions), inline(always))]
                || {
                    for (cube, local) in some.iter().flatten().zip(room.chunks_exact(size)) {
                        let frame = by.tree.frame(cube);
                        for body in cube.bodies().step_by(TOGETHER * LANES) {
                            // Packs without a body are in the middle of the cube.
                            for (pack, at) in at.iter_mut().enumerate() {
                                let u = coordinates(
                                    by.places,
                                    frame,
                                    (body + pack * LANES).min(cube.past),
                                    cube.past,
                                );
                                set_polynomials(at, &u, basis.order);
                            }
                            let found = evaluated::<D, Q>(local, rows, &at, 1.0 / frame.1);
                            for (body, found) in (body..cube.past).step_by(LANES).zip(&found) {
                                add_before(cube.past - first, sums, body - first, found.as_ref());
                            }
                        }
                    }
                },
            );
        }
    }
}

/// Packs of bodies that an expansion is evaluated at.
const TOGETHER: usize = 2;

/// What a local expansion is at some bodies.
#[cfg_attr(not(debug_assertions), inline(always))]
fn evaluated<const D: usize, Q: Quantity<D>>(
    local: &[f64],
    rows: &[Row<D>],
    at: &[[Chebyshev<Pack>; D]; TOGETHER],
    scale: f64,
) -> [Q::Sums; TOGETHER] {
    let mut found = [Q::none(); TOGETHER];
    for Row { degrees, first, len } in rows {
        let mut sums = [[Pack::all(0.0); 2]; TOGETHER];
        for (degree, &coefficient) in local[*first..first + len].iter().enumerate() {
            let coefficient = Pack::all(coefficient);
            for pack in 0..TOGETHER {
                let last = &at[pack][D - 1];
                sums[pack][0] += coefficient * last.value[degree];
                sums[pack][1] += coefficient * last.slope[degree];
            }
        }
        for pack in 0..TOGETHER {
            Q::add_row(&mut found[pack], &at[pack], degrees, sums[pack], scale);
        }
    }
    found
}
