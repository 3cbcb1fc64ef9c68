//! The way down: what far cubes do, as local expansions, from the largest cubes to the smallest and from
//! these to the bodies.

use alloc::vec::Vec;
use core::ops::Range;

use super::basis::{Chebyshev, set_polynomials};
use super::expansion::{Expansion, Row, Stage};
use super::lists::{Pair, on};
use super::matrix::{Ends, VECTORS, padded};
use super::neighbours::add_reactions;
use super::packs::{LANES, NOTHING, Pack, add_before, coordinates};
use super::quantity::Quantity;
use super::shares::Piece;
use super::subspace::Subspace;
use super::transfer::Transfer;
use super::work::Sorted;

/// What acts on the cubes of a level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Actions<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) bodies: &'w Sorted<D>,
    /// For each offset, the cubes of the level that act on others as wholes.
    pub(super) far: &'w [Vec<Pair>],
    pub(super) transfer: Option<&'w Transfer>,
    /// What bodies of earlier cubes do one by one.
    pub(super) reactions: &'w [Pack],
    /// The moments of the level, if cubes of this level or larger ones act as wholes.
    pub(super) moments: Option<Stage<'w>>,
    /// The local expansions of the level above, if they are there.
    pub(super) above: Option<Stage<'w>>,
}

impl<const D: usize> Actions<'_, D> {
    /// Sets the local expansions of some cubes, and adds to the sums what acts on their bodies.
    pub(super) fn distribute<Q: Quantity<D>>(&self, mut piece: Piece<'_, f64, D>) {
        if let Some(moments) = self.moments {
            piece.rows.fill(0.0);
            self.inherit(moments.subspace, &piece.cubes, piece.rows);
            self.exchange(moments, &piece.cubes, piece.rows);
            self.evaluate::<Q>(moments.subspace, &mut piece);
        }
        add_reactions(self.bodies, &piece.cubes, self.reactions, &mut piece.sums);
    }

    /// What acts on the cubes around these.
    fn inherit(&self, subspace: &Subspace, cubes: &Range<usize>, locals: &mut [f64]) {
        let Some(above) = self.above else { return };
        for (side, matrix) in subspace.narrow.iter().enumerate() {
            let all = self.bodies.tree.cubes[cubes.clone()].iter().enumerate();
            let on_side = all.filter(|(_, cube)| cube.side() == side);
            let ends = on_side
                .map(|(place, cube)| Ends { from: above.row(cube.whole), to: place * subspace.stride });
            matrix.add_all(ends, above.rows, locals);
        }
    }

    /// What other cubes of the level do as wholes.
    fn exchange(&self, moments: Stage<'_>, cubes: &Range<usize>, locals: &mut [f64]) {
        let Some(transfer) = self.transfer else { return };
        for (list, matrix) in self.far.iter().zip(&transfer.matrices) {
            let ends = list[on(list, cubes)].iter().map(|pair| Ends {
                from: moments.row(pair.source as usize),
                to: (pair.target as usize - cubes.start) * moments.subspace.stride,
            });
            matrix.add_all(ends, moments.rows, locals);
        }
    }

    /// What the expansions are at the bodies of the cubes that are not divided.
    fn evaluate<Q: Quantity<D>>(&self, subspace: &Subspace, piece: &mut Piece<'_, f64, D>) {
        let Piece { cubes, rows: locals, room, sums } = piece;
        let (Expansion { basis, rows, .. }, Sorted { tree, places, .. }) = (self.expansion, self.bodies);
        let size = padded(basis.len());
        let first = tree.cubes[cubes.start].first;
        let all = tree.cubes[cubes.clone()].iter().enumerate();
        let mut leaves = all.filter(|(_, cube)| !cube.is_divided());
        let mut at = [[Chebyshev::NONE; D]; TOGETHER];
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
            widest!({
                for (cube, local) in some.iter().flatten().zip(room.chunks_exact(size)) {
                    let frame = tree.frame(cube);
                    for body in cube.bodies().step_by(TOGETHER * LANES) {
                        // Packs without a body are in the middle of the cube.
                        for (pack, at) in at.iter_mut().enumerate() {
                            let u =
                                coordinates(places, frame, (body + pack * LANES).min(cube.past), cube.past);
                            set_polynomials(at, &u, basis.order);
                        }
                        let found = evaluated::<D, Q>(local, rows, &at, 1.0 / frame.1);
                        for (body, found) in (body..cube.past).step_by(LANES).zip(&found) {
                            add_before(cube.past - first, sums, body - first, found.as_ref());
                        }
                    }
                }
            });
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
    at: &[[Chebyshev; D]; TOGETHER],
    scale: f64,
) -> [Q::Sums; TOGETHER] {
    let mut found = [Q::NONE; TOGETHER];
    for Row { degrees, first, len } in rows {
        let mut sums = [[NOTHING; 2]; TOGETHER];
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
