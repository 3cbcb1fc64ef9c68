//! Bodies sorted into a tree of cubes, of which each has half the edge of the one around it.

use alloc::vec::Vec;
use core::ops::Range;

use super::shares;

/// Bits of a place along each axis: 2^LEVELS cubes along an edge of the largest.
const LEVELS: u32 = 20;

/// A cube with its bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cube<const D: usize> {
    pub(super) level: u32,
    /// Its place among the cubes of its level.
    pub(super) cell: [u32; D],
    /// Its bodies, in the order of the tree.
    pub(super) first: usize,
    pub(super) past: usize,
    /// The cube around it; the largest stands for its own.
    pub(super) whole: usize,
    /// Its parts, in the order of the cubes; none if it is not divided.
    pub(super) first_part: usize,
    pub(super) past_part: usize,
}

impl<const D: usize> Cube<D> {
    pub(super) fn bodies(&self) -> Range<usize> {
        self.first..self.past
    }

    pub(super) fn parts(&self) -> Range<usize> {
        self.first_part..self.past_part
    }

    pub(super) fn is_divided(&self) -> bool {
        !self.parts().is_empty()
    }

    /// How many cubes away the `other` of the same level is along each axis.
    pub(super) fn offset(&self, other: &Self) -> [i32; D] {
        core::array::from_fn(|axis| self.cell[axis] as i32 - other.cell[axis] as i32)
    }

    /// On which side of the cube around it this one lies: bit by bit, whether on the upper half of an axis.
    pub(super) fn side(&self) -> usize {
        self.cell.iter().rev().fold(0, |side, place| side << 1 | (place & 1) as usize)
    }
}

/// The cubes, from the largest down, and the order of the bodies in them.
#[derive(Clone, Debug)]
pub(super) struct Tree<const D: usize> {
    /// The body at each place, with what it is sorted by.
    pub(super) order: Vec<(u64, u32)>,
    pub(super) cubes: Vec<Cube<D>>,
    /// Which of them each level has, in the order of their bodies.
    pub(super) levels: Vec<Range<usize>>,
    /// The binary logarithm of the edge of the largest cube.
    edge: i32,
    corner: [f64; D],
}

/// A coordinate is not finite, or too large to be squared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NotFinite;

impl<const D: usize> Tree<D> {
    pub(super) fn new() -> Self {
        Self { order: Vec::new(), cubes: Vec::new(), levels: Vec::new(), edge: 0, corner: [0.0; D] }
    }

    /// Sorts bodies at these places, into cubes that are divided if they have more than `few`.
    ///
    /// The largest cube depends on nothing but the extent of the bodies, and its edges are powers of two, so
    /// that the same cubes are found again while the bodies move a little.
    pub(super) fn sort(&mut self, places: [&[f64]; D], few: usize) -> Result<(), NotFinite> {
        self.enclose(places)?;
        if self.order.len() != places[0].len() {
            self.order = (0..places[0].len()).map(|body| (0, body as u32)).collect();
        }
        let cells = f64::from(1_u32 << LEVELS) / exp2(self.edge);
        let corner = self.corner;
        for (key, body) in &mut self.order {
            *key = interleaved::<D>(core::array::from_fn(|axis| {
                let cell = ((places[axis][*body as usize] - corner[axis]) * cells) as u32;
                cell.min((1 << LEVELS) - 1)
            }));
        }
        // Nothing to do where bodies did not move.
        if !self.order.is_sorted() {
            shares::sort(&mut self.order);
        }
        self.divide(few);
        Ok(())
    }

    fn enclose(&mut self, places: [&[f64]; D]) -> Result<(), NotFinite> {
        let mut ends = [(0.0, 0.0); D];
        let mut extent = 0.0;
        for (end, places) in ends.iter_mut().zip(places) {
            *end = interval(places)?;
            let length = end.1 - end.0;
            extent = if length > extent { length } else { extent };
        }
        let mut exponent = exponent(extent);
        // Bodies far from the origin: places that are no multiples of a cell of the smallest cubes.
        loop {
            if exponent > 500 {
                return Err(NotFinite);
            }
            let step = exp2(exponent);
            self.corner = ends.map(|(lowest, _)| (lowest / step).floor() * step);
            self.edge = exponent + 1;
            let encloses =
                ends.iter().zip(self.corner).all(|(&(_, highest), corner)| highest - corner < 2.0 * step);
            if encloses {
                return Ok(());
            }
            exponent += 1;
        }
    }

    fn divide(&mut self, few: usize) {
        let whole = Cube {
            level: 0,
            cell: [0; D],
            first: 0,
            past: self.order.len(),
            whole: 0,
            first_part: 0,
            past_part: 0,
        };
        self.cubes.clear();
        self.cubes.push(whole);
        self.levels.clear();
        let mut next = 0;
        while next < self.cubes.len() {
            let cube = self.cubes[next];
            if cube.level as usize == self.levels.len() {
                // All cubes of the level stand here, and none of the next.
                self.levels.push(next..self.cubes.len());
            }
            if cube.past - cube.first > few && cube.level < LEVELS {
                let first_part = self.cubes.len();
                self.divide_cube(next);
                (self.cubes[next].first_part, self.cubes[next].past_part) = (first_part, self.cubes.len());
            }
            next += 1;
        }
    }

    fn divide_cube(&mut self, whole: usize) {
        let cube = self.cubes[whole];
        let shift = (LEVELS - cube.level - 1) * D as u32;
        let mut first = cube.first;
        for part in 0..1_u64 << D {
            let bodies = &self.order[first..cube.past];
            let past = first + bodies.partition_point(|(key, _)| (key >> shift) & ((1 << D) - 1) <= part);
            if past > first {
                let cell = core::array::from_fn(|axis| 2 * cube.cell[axis] + (part >> axis & 1) as u32);
                // Not divided, as the one around it was so far.
                self.cubes.push(Cube { level: cube.level + 1, cell, first, past, whole, ..cube });
            }
            first = past;
        }
    }

    /// The binary logarithm of the edge of a cube of this level.
    pub(super) fn edge(&self, level: u32) -> i32 {
        self.edge - level as i32
    }

    /// The middle of a cube, and half its edge.
    pub(super) fn frame(&self, cube: &Cube<D>) -> ([f64; D], f64) {
        let edge = exp2(self.edge(cube.level));
        let middle = |axis: usize| self.corner[axis] + (f64::from(cube.cell[axis]) + 0.5) * edge;
        (core::array::from_fn(middle), edge / 2.0)
    }
}

/// The least and the largest of some places.
fn interval(places: &[f64]) -> Result<(f64, f64), NotFinite> {
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for &place in places {
        if !place.is_finite() {
            return Err(NotFinite);
        }
        (lowest, highest) = (lowest.min(place), highest.max(place));
    }
    Ok(if places.is_empty() { (0.0, 0.0) } else { (lowest, highest) })
}

/// Bit b of coordinate a becomes bit D b + a.
fn interleaved<const D: usize>(cell: [u32; D]) -> u64 {
    let mut key = 0;
    for (axis, place) in cell.into_iter().enumerate() {
        key |= spread::<D>(place) << axis;
    }
    key
}

/// Bit b becomes bit D b: halves of the bits are moved apart, then halves of these.
fn spread<const D: usize>(place: u32) -> u64 {
    let mut bits = u64::from(place);
    for shift in [16, 8, 4, 2, 1] {
        bits = (bits | bits << (shift * (D - 1))) & const { groups::<D>() }[shift.trailing_zeros() as usize];
    }
    bits
}

/// For each power of two, the bits that stand in groups of as many, and D − 1 groups apart.
const fn groups<const D: usize>() -> [u64; 5] {
    let mut masks = [0; 5];
    let mut power = 0;
    while power < masks.len() {
        let mut bit = 0;
        while bit < u64::BITS {
            if (bit >> power) % D as u32 == 0 {
                masks[power] |= 1 << bit;
            }
            bit += 1;
        }
        power += 1;
    }
    masks
}

/// 2^exponent.
pub(super) fn exp2(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

/// The least exponent of a power of two that is not below `extent`, and 0 for none.
fn exponent(extent: f64) -> i32 {
    if extent > 0.0 { extent.log2().ceil() as i32 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::{LEVELS, interleaved};

    fn holds<const D: usize>() {
        let mut state = 3_u32;
        for _ in 0..1000 {
            let cell: [u32; D] = core::array::from_fn(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                state >> (32 - LEVELS)
            });
            let bit =
                |axis: usize, bit: u32| u64::from(cell[axis] >> bit & 1) << (bit * D as u32 + axis as u32);
            let expected = (0..D)
                .flat_map(|axis| (0..LEVELS).map(move |number| (axis, number)))
                .fold(0, |key, (axis, number)| key | bit(axis, number));
            assert_eq!(interleaved(cell), expected);
        }
    }

    #[test]
    fn bits_of_the_coordinates_alternate() {
        holds::<1>();
        holds::<2>();
        holds::<3>();
    }
}
