//! The way down: what far cubes do, as local expansions, from the largest cubes to the smallest and from these to the bodies.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::Chebyshev;
use super::expansion::{Expansion, Row};
use super::lists::{Lists, Pair, on};
use super::neighbours::add_reactions;
use super::packs::{Ends, LANES, Pack, add_before, add_product, add_products};
use super::polynomials::at_bodies;
use super::quantity::Quantity;
use super::transfer::Transfer;
use super::tree::Tree;
use crate::scalar::simd::widest_if;
use crate::threads::Part;

/// What acts on the cubes of a level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Actions<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) tree: &'w Tree<D>,
    pub(super) places: &'w [Vec<f64>; D],
    /// Whether there are far cubes on any level.
    pub(super) has_far: bool,
    /// For each offset, the cubes of the level that act on others as wholes.
    pub(super) far: &'w [Vec<Pair>],
    pub(super) lists: &'w Lists,
    /// What bodies of earlier cubes do one by one.
    pub(super) reactions: &'w [Pack],
    pub(super) transfer: Option<&'w Transfer>,
    /// The compressed moments of all cubes.
    pub(super) sent: &'w [f64],
    /// The local expansions of the cubes before this level.
    pub(super) above: &'w [f64],
}

/// What is summed for some cubes of one level.
#[derive(Debug)]
pub(super) struct Locals<'w, const D: usize> {
    pub(super) by: Actions<'w, D>,
    pub(super) cubes: Range<usize>,
    /// For each cube the potential of far cubes in it, and of those on its level the same compressed.
    pub(super) locals: &'w mut [f64],
    pub(super) received: &'w mut [f64],
    /// For the bodies of these cubes, from the first one on.
    pub(super) sums: [&'w mut [f64]; D],
}

impl<const D: usize> Part for Locals<'_, D> {
    fn size(&self) -> usize {
        self.sums[0].len()
    }
    fn halves(self) -> (Self, Option<Self>) {
        let Self { by, cubes, locals, received, mut sums } = self;
        let count = cubes.len() / 2;
        if count == 0 {
            return (Self { by, cubes, locals, received, sums }, None);
        }
        let middle = cubes.start + count;
        let entries = count * by.expansion.basis.len() * usize::from(by.has_far);
        let bodies = by.tree.cubes[middle].first - by.tree.cubes[cubes.start].first;
        let [(locals, other_locals), (received, other_received)] =
            [locals, received].map(|all| all.split_at_mut(entries));
        let other_sums = sums.each_mut().map(|sums| {
            let (own, other) = core::mem::take(sums).split_at_mut(bodies);
            *sums = own;
            other
        });
        let other = Self {
            by,
            cubes: middle..cubes.end,
            locals: other_locals,
            received: other_received,
            sums: other_sums,
        };
        (Self { by, cubes: cubes.start..middle, locals, received, sums }, Some(other))
    }
}

impl<const D: usize> Locals<'_, D> {
    pub(super) fn distribute<Q: Quantity<D>>(mut self) {
        if self.by.has_far {
            self.exchange();
            self.expand::<Q>();
        }
        let Self { by, cubes, mut sums, .. } = self;
        add_reactions(by.tree, by.lists, &cubes, by.reactions, &mut sums);
    }

    /// What other cubes do as wholes.
    fn exchange(&mut self) {
        let Self { by, cubes, received, .. } = self;
        let Some(transfer) = by.transfer else { return };
        let size = by.expansion.basis.len();
        received.fill(0.0);
        for (list, matrix) in by.far.iter().zip(&transfer.matrices) {
            let list = &list[on(list, cubes)];
            widest_if(
                true,
                #[inline(always)]
                || {
                    for some in list.chunks(LANES) {
                        let mut ends = [Ends::default(); LANES];
                        for (ends, pair) in ends.iter_mut().zip(some) {
                            let to = (pair.target as usize - cubes.start) * size;
                            *ends = Ends { from: pair.source as usize * size, to };
                        }
                        add_products(matrix, transfer.rank, &ends[..some.len()], by.sent, received);
                    }
                },
            );
        }
    }

    /// The expansions of these cubes, and what they are at the bodies of those that are not divided.
    fn expand<Q: Quantity<D>>(&mut self) {
        let Self { by, cubes, locals, received, sums } = self;
        let Expansion { basis, rows, refinement, .. } = by.expansion;
        let size = basis.len();
        widest_if(
            true,
            #[inline(always)]
            || {
                let mut at = [Chebyshev::none(); D];
                let first = by.tree.cubes[cubes.start].first;
                let both = locals.chunks_exact_mut(size).zip(received.chunks_exact(size));
                for (number, (local, received)) in cubes.clone().zip(both) {
                    let cube = &by.tree.cubes[number];
                    if cube.level == 0 {
                        local.fill(0.0);
                    } else {
                        local.copy_from_slice(&by.above[cube.whole * size..(cube.whole + 1) * size]);
                        refinement.narrow(rows, cube.side(), local);
                    }
                    if let Some(Transfer { rank, compression: [_, expand], .. }) = by.transfer {
                        add_product(local, expand, &received[..*rank]);
                    }
                    if cube.is_divided() {
                        continue;
                    }
                    let frame = by.tree.frame(cube);
                    for body in cube.bodies().step_by(LANES) {
                        at_bodies::<D, true>(&mut at, basis.order, by.places, frame, body, cube.past);
                        let found = evaluated::<D, Q>(local, rows, &at, 1.0 / frame.1);
                        add_before(cube.past - first, sums, body - first, found.as_ref());
                    }
                }
            },
        );
    }
}

/// What a local expansion is at some bodies.
#[inline(always)]
fn evaluated<const D: usize, Q: Quantity<D>>(
    local: &[f64],
    rows: &[Row<D>],
    at: &[Chebyshev<Pack>; D],
    scale: f64,
) -> Q::Sums {
    let last = &at[D - 1];
    let mut found = Q::none();
    for Row { degrees, first, len } in rows {
        let mut row = [Pack::all(0.0); 2];
        for (degree, &coefficient) in local[*first..first + len].iter().enumerate() {
            row[0] += Pack::all(coefficient) * last.value[degree];
            row[1] += Pack::all(coefficient) * last.slope[degree];
        }
        Q::add_row(&mut found, at, degrees, row, scale);
    }
    found
}
