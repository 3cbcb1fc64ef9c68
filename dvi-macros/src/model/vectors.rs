//! Coordinates that are vectors: `r[n][3]` is a block for each component, `r[i][0]`, `r[i][1]`, `r[i][2]`, of
//! which each has the n coordinates of its own one after the other, and all have one name.

use std::ops::{Range, RangeInclusive};

use syn::ext::IdentExt as _;
use syn::{Expr, Ident};

use super::{Block, Model, Shape};
use crate::symbolic::Index;
use crate::syntax::{Factor, literal};

/// The numbers of components that a vector may have. Formulas have a term for each.
pub(crate) const COMPONENTS: RangeInclusive<i64> = 2..=16;

/// Which component of a vector the coordinates of a block are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    pub(crate) number: usize,
    /// The number of components.
    pub(crate) of: usize,
}

/// The coordinates of a spinor, of which a unit vector is made in a degenerate system: two complex numbers.
pub(crate) const SPINOR: usize = 4;

impl Block {
    /// Whether the coordinates are of spinors.
    pub(crate) fn is_spinor(&self) -> bool {
        self.factor == Factor::Sphere && self.axis.is_some_and(|axis| axis.of == SPINOR)
    }

    /// The entry at an index, as formulas have it.
    pub(crate) fn entry(&self, index: &str) -> String {
        let component = self.axis.map_or_else(String::new, |axis| format!("[{}]", axis.number));
        match &self.array {
            Some(_) => format!("{}[{index}]{component}", self.name.unraw()),
            None => self.name.unraw().to_string(),
        }
    }

    /// The entry of this number in the block.
    pub(crate) fn at(&self, number: i64) -> String {
        match self.row_length() {
            Some(length) => {
                let indices = Index::literal(number).row_and_column(length);
                let indices = indices.map(|index| index.as_literal().map(|index| format!("[{index}]")));
                format!("{}{}", self.name.unraw(), indices.into_iter().flatten().collect::<String>())
            }
            None => self.entry(&number.to_string()),
        }
    }

    /// What the spinor of a unit vector is called in reports.
    pub(crate) fn spinor(&self) -> String {
        format!("z_{}", self.name.unraw())
    }

    /// What is said of all its coordinates: `x`, or `r[i][0]` where others have the same name, or `R[i]`
    /// where these are one.
    pub(crate) fn label(&self) -> String {
        match (self.axis, self.factor) {
            (Some(_), Factor::Line) => self.entry("i"),
            (Some(_), Factor::Rotation | Factor::Sphere) if self.array.is_some() => {
                format!("{}[i]", self.name.unraw())
            }
            (_, Factor::Rotation | Factor::Sphere) | (None, Factor::Line) => self.name.to_string(),
        }
    }

    /// Whether its coordinates are entries of rotations that no velocity has the places of: the nine entries
    /// of a rotation have three.
    pub(crate) fn is_without_velocity(&self) -> bool {
        self.factor == Factor::Rotation && self.axis.is_some_and(|axis| axis.number >= VELOCITIES)
    }
}

/// The velocities of a rotation.
const VELOCITIES: usize = 3;

impl Model {
    /// Whether unit vectors are among the coordinates of a degenerate system.
    pub(crate) fn has_spinors(&self) -> bool {
        self.blocks.iter().any(Block::is_spinor)
    }

    /// The blocks of each coordinate that was declared, or that a time transformation has added: one, or
    /// those of the components of a vector.
    pub(crate) fn coordinates(&self) -> Vec<Range<usize>> {
        let is_first = |block: &usize| self.blocks[*block].axis.is_none_or(|axis| axis.number == 0);
        (0..self.blocks.len()).filter(is_first).map(|first| self.coordinate_at(first)).collect()
    }

    /// The blocks of the coordinate that begins with this one.
    pub(crate) fn coordinate_at(&self, first: usize) -> Range<usize> {
        first..first + self.blocks[first].axis.map_or(1, |axis| axis.of)
    }

    /// The blocks of the coordinate of this name.
    pub(crate) fn coordinate_of(&self, name: &Ident) -> Option<Range<usize>> {
        let first = self.blocks.iter().position(|block| block.name == *name)?;
        Some(self.coordinate_at(first))
    }

    /// How many coordinates of a block have a velocity.
    pub(crate) fn velocities(&self, block: usize) -> Index {
        match &self.blocks[block] {
            Block { factor: Factor::Rotation, axis: None, .. } => Index::literal(VELOCITIES as i64),
            block if block.is_without_velocity() => Index::literal(0),
            _ => self.block_size(block),
        }
    }

    /// The number of components of the coordinate that begins with this block, if it is a vector as a whole:
    /// an array of a few.
    pub(crate) fn whole(&self, block: usize) -> Option<i64> {
        let Block { array, axis: None, factor: Factor::Line | Factor::Sphere, .. } = &self.blocks[block]
        else {
            return None;
        };
        let size = array.as_ref()?.0.as_literal()?;
        COMPONENTS.contains(&size).then_some(size)
    }

    /// The names that are vectors, each with the number of indices that it is one with.
    pub(crate) fn vectors(&self) -> Vec<(String, usize)> {
        let coordinate = |blocks: Range<usize>| {
            let block = Some(&self.blocks[blocks.start]).filter(|block| block.factor != Factor::Rotation)?;
            let indices = usize::from(block.array.is_some());
            let indices = block.axis.map(|_| indices).or_else(|| self.whole(blocks.start).map(|_| 0))?;
            Some((block.name.to_string(), indices))
        };
        let parameters = self.parameters.iter().filter_map(|parameter| {
            let (mut indices, mut shape) = (0, &parameter.shape);
            while let Shape::Array(length, entry) = shape {
                if length.is_some_and(|length| are_components(length, entry)) {
                    return Some((parameter.text.clone(), indices));
                }
                (indices, shape) = (indices + 1, entry);
            }
            None
        });
        self.coordinates().into_iter().filter_map(coordinate).chain(parameters).collect()
    }
}

/// Whether an array of so many of these is a vector: of numbers, for all that is known of their type.
pub(crate) fn are_components(length: i64, entry: &Shape) -> bool {
    COMPONENTS.contains(&length) && !matches!(entry, Shape::Array(..) | Shape::Other)
}

/// The number of components in `r[n][3]`.
pub(super) fn components(name: &Ident, declared: &Expr) -> syn::Result<usize> {
    let count = literal(declared).filter(|count| COMPONENTS.contains(count));
    let message = format!("a vector has two components or more: an array of numbers is `{name}[n]`");
    count.map(|count| count as usize).ok_or_else(|| syn::Error::new_spanned(declared, message))
}
