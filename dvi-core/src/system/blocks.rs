//! The blocks of coordinates of a system, each rotation and each unit vector by itself.

use core::ops::Range;

use super::{CoordinateBlock, System};
use crate::Real;
use crate::error::StartError;
use crate::name::{Axis, Factor};
use crate::scalar::norm::reported;

/// How far a state may be off the manifold, in units of rounding.
const TOLERANCE: f64 = 4096.0;

/// Where the numbers of a block of coordinates stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) name: &'static str,
    /// Its number in an array of rotations or unit vectors.
    pub(crate) index: Option<usize>,
    pub(crate) factor: Factor,
    /// The place of its first coordinate, and how far from each other they are.
    at: usize,
    stride: usize,
    coordinates: usize,
    /// Its first tangent vector in a basis of the tangent space.
    pub(crate) slot: usize,
}

impl Block {
    /// The place of its coordinate of this number.
    #[inline]
    pub(crate) fn place(self, number: usize) -> usize {
        self.at + number * self.stride
    }

    /// The places of its coordinates.
    #[inline]
    pub(crate) fn places(self) -> impl Iterator<Item = usize> {
        (0..self.coordinates).map(move |number| self.place(number))
    }

    /// The places of its velocities.
    #[inline]
    pub(crate) fn velocities(self) -> impl Iterator<Item = usize> {
        (0..self.factor.velocities(self.coordinates)).map(move |number| self.place(number))
    }

    /// The places of the first three coordinates, of a rotation or a unit vector.
    #[inline]
    pub(crate) fn vector(self) -> [usize; 3] {
        [0, 1, 2].map(|number| self.place(number))
    }

    /// Its tangent vectors in that basis.
    #[inline]
    pub(crate) fn slots(self) -> Range<usize> {
        self.slot..self.slot + self.dimension()
    }

    /// The number of its tangent vectors.
    #[inline]
    pub(crate) fn dimension(self) -> usize {
        self.factor.dimension(self.coordinates)
    }

    /// Whether it may be off the manifold by `defect`.
    ///
    /// # Errors
    /// [`StartError::OffManifold`] if it may not.
    pub(crate) fn check<T: Real>(self, defect: T) -> Result<(), StartError> {
        let Self { name: block, index, .. } = self;
        let [defect, tolerance] = [defect, T::lift(TOLERANCE) * T::default_epsilon()].map(reported);
        if defect <= tolerance {
            Ok(())
        } else {
            Err(StartError::OffManifold { block, index, defect, tolerance })
        }
    }
}

/// The blocks of coordinates of `system`.
#[inline]
pub(crate) fn blocks<S: System>(system: &S) -> Blocks<'_, S> {
    Blocks { system, number: 0, index: 0, at: 0, slot: 0 }
}

/// Stands before a block. As a chain of adapters, a step of a heavy top takes 400 instructions more
/// (`cargo bench -p dvi-kernels --bench instructions`).
pub(crate) struct Blocks<'a, S> {
    system: &'a S,
    /// The coordinates as they are declared, and the number in an array of these.
    number: usize,
    index: usize,
    /// The first place of what is declared, and the next tangent vector.
    at: usize,
    slot: usize,
}

impl<S: System> Iterator for Blocks<'_, S> {
    type Item = Block;

    #[inline]
    fn next(&mut self) -> Option<Block> {
        loop {
            let &CoordinateBlock { name, size, axis, factor } = S::REPORT.coordinates.get(self.number)?;
            let len = self.system.block_len(self.number);
            // An array has its first coordinates in the first of the blocks that are declared.
            let (count, coordinates, stride) = match axis {
                Some(Axis { number: 0, of }) if factor != Factor::Line => (len, usize::from(of), len),
                Some(Axis { .. }) if factor != Factor::Line => (0, 0, len),
                Some(Axis { .. }) | None => (1, len, 1),
            };
            if self.index == count {
                (self.number, self.index, self.at) = (self.number + 1, 0, self.at + len);
                continue;
            }
            let is_array = axis.is_some() && factor != Factor::Line && !size.is_empty();
            let index = is_array.then_some(self.index);
            let (at, slot) = (self.at + self.index, self.slot);
            let block = Block { name, index, factor, at, stride, coordinates, slot };
            self.index += 1;
            self.slot += block.dimension();
            return Some(block);
        }
    }
}
