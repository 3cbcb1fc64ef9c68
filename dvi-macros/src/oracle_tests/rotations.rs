//! Rotations and unit vectors of regular systems, in the oracle: all of their entries are coordinates.
//!
//! A rotation is nine numbers, row by row, as the blocks of an array of vectors or as one block. Its angular
//! velocity has the first three of their places. Derivatives are those of the formulas, as if all entries
//! were independent.

use super::formula::Index;
use super::system::System;
use super::write::Writer;
use crate::syntax::Factor;

/// The numbers of a rotation.
pub(super) const ENTRIES: usize = 9;
/// Those of its columns, of its angular velocity, and of unit vectors.
pub(super) const COMPONENTS: usize = 3;

impl System {
    pub(super) fn is_rotation(&self, block: usize) -> bool {
        self.blocks[block].factor == Factor::Rotation
    }

    /// Whether rotations or unit vectors are among the coordinates, as such.
    pub(super) fn is_on_manifold(&self) -> bool {
        (0..self.blocks.len()).any(|block| self.is_factor(block))
    }

    fn is_factor(&self, block: usize) -> bool {
        self.blocks[block].factor != Factor::Line && !self.is_spinor(block)
    }

    /// Whether a coordinate is one rotation or unit vector, and no array of them.
    pub(super) fn is_single_factor(&self, first: usize) -> bool {
        self.is_factor(first) && self.axes(first) == 1
    }

    /// Whether all of a block has velocities, or the first entries of a rotation by itself.
    pub(super) fn has_velocity(&self, block: usize) -> bool {
        let number = self.blocks[block].axis.map_or(0, |[number, _]| number);
        !self.is_spinor(block) && (!self.is_rotation(block) || number < COMPONENTS)
    }
}

impl Writer<'_> {
    /// What makes a velocity of a coordinate.
    pub(super) fn word(&self, block: usize) -> &'static str {
        if self.system.is_rotation(block) { "omega" } else { self.velocity }
    }

    /// `R[i][j][k]` or `R[j][k]`, or the same entry of a column.
    pub(super) fn entry(&self, block: usize, index: Option<&Index>) -> String {
        let (of, number) = self.rotation(block, index);
        let (row, column) = (number / COMPONENTS, number % COMPONENTS);
        match self.spelling.is_other() {
            true => format!("{of}.column({column})[{row}]"),
            false => format!("{of}[{row}][{column}]"),
        }
    }

    /// `omega(R[i])[k]` or `omega(R)[k]`
    pub(super) fn angular_velocity(&self, block: usize, index: Option<&Index>) -> String {
        let (of, number) = self.rotation(block, index);
        format!("omega({of})[{number}]")
    }

    /// A rotation, and the number of one of its entries.
    fn rotation(&self, block: usize, index: Option<&Index>) -> (String, usize) {
        match (self.system.blocks[block].axis, index) {
            (Some([number, _]), _) => (self.whole(block, index), number),
            (None, entry) => (self.whole(block, None), entry.map_or(0, |entry| entry.constant as usize)),
        }
    }
}
