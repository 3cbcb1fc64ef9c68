//! What the compiler can decide about a system before any number is known: the structure of Ω for a
//! degenerate system, of the mass matrix for a regular one.

use crate::model::Model;
use crate::symbolic::{Coordinate, Expr, Graph, Loop};

mod class;
pub(crate) mod gauge;
mod mass;
mod one_form;
mod pairs;
mod singular;

pub(crate) use class::{Class, Components};
pub(crate) use mass::MassMatrix;
pub(crate) use one_form::OneForm;
pub(crate) use pairs::PairSum;

/// An entry of M, or of Ω above its diagonal.
struct Entry {
    loops: Vec<Loop>,
    row: Coordinate,
    column: Coordinate,
    value: Expr,
}

impl Entry {
    /// The blocks of its row and of its column.
    fn blocks(&self) -> [usize; 2] {
        [&self.row, &self.column].map(|coordinate| coordinate.block as usize)
    }
}

/// Each entry once, without those that cancel.
fn collected(graph: &mut Graph, entries: impl IntoIterator<Item = Entry>) -> Vec<Entry> {
    let mut collected: Vec<Entry> = Vec::new();
    for entry in entries {
        let same = |known: &&mut Entry| {
            known.row == entry.row && known.column == entry.column && known.loops == entry.loops
        };
        match collected.iter_mut().find(same) {
            Some(known) => known.value = graph.add(known.value, entry.value),
            None => collected.push(entry),
        }
    }
    collected.retain(|entry| !entry.value.is_zero());
    collected
}

/// Whether each row of a symmetric matrix with entries at these places, and their mirror images, can have
/// a column of its own, by augmenting paths. Among arrays this is not decided: true.
fn has_matching(model: &Model, places: &[[usize; 2]]) -> bool {
    fn assign(row: usize, columns: &[Vec<usize>], seen: &mut [bool], row_of: &mut [Option<usize>]) -> bool {
        columns[row].iter().any(|&column| {
            if std::mem::replace(&mut seen[column], true) {
                return false;
            }
            let free = row_of[column].is_none_or(|other| assign(other, columns, seen, row_of));
            if free {
                row_of[column] = Some(row);
            }
            free
        })
    }
    let dimension = model.blocks.len();
    if model.blocks.iter().any(|block| block.array.is_some()) {
        return true;
    }
    let mut columns = vec![Vec::new(); dimension];
    for &[row, column] in places {
        columns[row].push(column);
        columns[column].push(row);
    }
    let mut row_of = vec![None; dimension];
    (0..dimension).all(|row| assign(row, &columns, &mut vec![false; dimension], &mut row_of))
}
