//! The way up: moments of all cubes, from the smallest to the largest.

use super::basis::MOST;
use super::expansion::{Expansion, Row, Stage};
use super::matrix::{Ends, VECTORS, padded};
use super::packs::{LANES, NOTHING, Pack, add_lanes, coordinates, load_before};
use super::shares::Piece;
use super::subspace::Subspace;
use super::tree::Cube;
use super::work::Sorted;

/// What the moments of a level are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sources<'w, const D: usize> {
    pub(super) expansion: &'w Expansion<D>,
    pub(super) bodies: &'w Sorted<D>,
    /// The functions of this level.
    pub(super) subspace: &'w Subspace,
    /// The moments of the next one, if there is one.
    pub(super) below: Option<Stage<'w>>,
}

/// Bodies whose polynomials are known at once, in packs.
const TOGETHER: usize = 6;
/// Moments that are summed at once: of four the compiler would mix the lanes.
const AT_ONCE: usize = 3;

impl<const D: usize> Sources<'_, D> {
    /// Sets the moments of some cubes: of each Σ w B over its bodies, for the functions B of the subspace.
    pub(super) fn collect(&self, Piece { cubes, rows: moments, room, .. }: Piece<'_, f64, D>) {
        let Self { bodies: Sorted { tree, .. }, subspace, .. } = *self;
        let (stride, size) = (subspace.stride, padded(self.expansion.basis.len()));
        let of_part = &tree.cubes[cubes];
        moments.fill(0.0);
        let mut leaves = of_part.iter().enumerate().filter(|(_, cube)| !cube.is_divided());
        let mut at = [[[NOTHING; TOGETHER]; MOST]; D];
        loop {
            let mut ends = [Ends::default(); VECTORS];
            let mut count = 0;
            widest!({
                let rooms = room.chunks_exact_mut(size).take(VECTORS);
                for (number, (room, (place, cube))) in rooms.zip(&mut leaves).enumerate() {
                    room.fill(0.0);
                    self.add_bodies(cube, &mut at, room);
                    ends[number] = Ends { from: number * size, to: place * stride };
                    count = number + 1;
                }
            });
            if count == 0 {
                break;
            }
            subspace.compress.add_products(&ends[..count], room, moments);
        }
        let Some(below) = self.below else { return };
        for (side, matrix) in below.subspace.widen.iter().enumerate() {
            let parts = of_part
                .iter()
                .enumerate()
                .flat_map(|(place, cube)| cube.parts().map(move |part| (place, part)));
            let on_side = parts.filter(|(_, part)| tree.cubes[*part].side() == side);
            let ends = on_side.map(|(place, part)| Ends { from: below.row(part), to: place * stride });
            matrix.add_all(ends, below.rows, moments);
        }
    }

    /// Adds the moments of the bodies of a cube.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bodies(&self, cube: &Cube<D>, at: &mut Values<D>, moments: &mut [f64]) {
        let Self { expansion, bodies: Sorted { tree, places, weights, .. }, .. } = *self;
        let frame = tree.frame(cube);
        for group in cube.bodies().step_by(TOGETHER * LANES) {
            let mut packs = [NOTHING; TOGETHER];
            let mut kept = [NOTHING; MOST + AT_ONCE];
            let mut count = 0;
            for first in (group..cube.past).step_by(LANES).take(TOGETHER) {
                let u = coordinates(places, frame, first, cube.past);
                for (at, u) in at.iter_mut().zip(u) {
                    set_values(at, count, u, expansion.basis.order);
                }
                packs[count] = load_before(cube.past, weights, first);
                count += 1;
            }
            for Row { degrees, first, len } in &expansion.rows {
                let mut products = packs;
                for axis in 0..D - 1 {
                    let values = &at[axis][degrees[axis]];
                    for pack in 0..TOGETHER {
                        products[pack] = products[pack] * values[pack];
                    }
                }
                for degree in (0..*len).step_by(AT_ONCE) {
                    let mut sums = [NOTHING; AT_ONCE];
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
}

/// The polynomials of each degree at several packs of bodies, along each axis.
type Values<const D: usize> = [[[Pack; TOGETHER]; MOST]; D];

/// Sets the polynomials of a pack of bodies at u.
#[inline]
fn set_values(at: &mut [[Pack; TOGETHER]; MOST], pack: usize, u: Pack, order: usize) {
    let [mut before, mut last] = [Pack::all(1.0), u];
    (at[0][pack], at[1][pack]) = (before, last);
    let twice = u + u;
    for at in &mut at[2..order.max(2)] {
        (before, last) = (last, twice * last - before);
        at[pack] = last;
    }
}
