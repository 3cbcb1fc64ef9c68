//! Arrays of numbers with two indices: `q[n][m]` is one block, its n rows of m coordinates one after the
//! other. The graph knows the place of an entry in the block, and what users see has both indices.

use syn::{Expr, Ident};

use super::vectors::COMPONENTS;
use super::{Block, Model};
use crate::errors::Errors;
use crate::internal::internal;
use crate::symbolic::Index;
use crate::syntax::literal;

/// The number of rows, and their length.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) sizes: [Index; 2],
    /// As they are written.
    pub(crate) texts: [String; 2],
}

/// The second size of numbers with two indices, if it is none of vectors: of those it is a small literal.
pub(super) fn row_length(declared: Option<&Expr>) -> Option<&Expr> {
    declared.filter(|size| literal(size).is_none_or(|size| size > *COMPONENTS.end()))
}

impl Grid {
    /// The number of all entries, with its text between brackets.
    pub(super) fn entries(&self) -> (Index, String) {
        let Self { sizes: [rows, length], texts } = self;
        (rows.product(length), texts.join("]["))
    }
}

impl Model {
    pub(super) fn grid(&mut self, name: &Ident, declared: [&Expr; 2], errors: &mut Errors) -> Grid {
        let (rows, n) = self.read_size(name, declared[0], 1, errors);
        let (length, m) = self.read_size(name, declared[1], rows.as_literal().unwrap_or(1), errors);
        let mut sizes = [rows, length];
        if !sizes.iter().all(Index::is_short) {
            errors.push(declared[1], "these are more coordinates than there are integers");
            self.lost_coordinates = true;
            sizes = [1, 1].map(Index::literal);
        }
        Grid { sizes, texts: [n, m] }
    }

    /// The number by which a system knows the length of the rows of a block: those of the blocks themselves
    /// are before.
    pub(crate) fn number_of_rows(&self, block: usize) -> usize {
        self.blocks.len() + block
    }
}

impl Block {
    /// The length of the rows, if it takes two indices.
    pub(crate) fn row_length(&self) -> Option<&Index> {
        self.grid.as_ref().map(|grid| &grid.sizes[1])
    }

    /// The size of an array, or both.
    pub(crate) fn sizes(&self) -> Vec<Index> {
        match (&self.array, &self.grid) {
            (_, Some(grid)) => grid.sizes.to_vec(),
            (array, None) => array.iter().map(|(size, _)| size.clone()).collect(),
        }
    }

    /// The place of an entry with as many indices as there are sizes.
    pub(crate) fn place(&self, indices: &[Index]) -> Index {
        match (indices, self.row_length()) {
            ([row, column], Some(length)) => Index::in_row(row, column, length),
            ([index], None) => index.clone(),
            _ => internal("an array with another number of indices"),
        }
    }

    /// The indices of the entry at a place, as many as there are sizes.
    pub(crate) fn indices(&self, place: &Index) -> Vec<Index> {
        match (&self.array, self.row_length()) {
            (None, _) => Vec::new(),
            (Some(_), Some(length)) => place.row_and_column(length).to_vec(),
            (Some(_), None) => vec![place.clone()],
        }
    }

    /// What stands behind its name in formulas.
    pub(crate) fn letters(&self) -> &'static str {
        match (&self.array, &self.grid) {
            (None, _) => "",
            (Some(_), None) => "[i]",
            (Some(_), Some(_)) => "[i][j]",
        }
    }
}
