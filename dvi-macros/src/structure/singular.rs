//! Mass matrices that are singular whatever the parameters: with an empty row in an array, or of numbers.

use super::Entry;
use crate::model::Model;
use crate::symbolic::{Atom, Index, Loop};

/// For each array of literal size, the first of its coordinates whose velocity M certainly does not involve
/// while it involves others of that array.
pub(super) fn skipped(model: &Model, mass: &[Entry]) -> Vec<(usize, i64)> {
    let first_skipped = |block: usize| {
        let size = model.velocities(block).as_literal()?;
        let mut involved = Vec::new();
        for entry in mass {
            for coordinate in [&entry.row, &entry.column] {
                if coordinate.block as usize == block {
                    involved.push(reach(&coordinate.index, &entry.loops)?);
                }
            }
        }
        involved.sort_unstable();
        let further = |reached: i64, &(least, beyond): &(i64, i64)| {
            if least <= reached { reached.max(beyond) } else { reached }
        };
        let reached = involved.iter().fold(0, further);
        (!involved.is_empty() && reached < size).then_some((block, reached))
    };
    (0..model.blocks.len())
        .filter(|block| model.blocks[*block].array.is_some())
        .filter_map(first_skipped)
        .collect()
}

/// The range of an index that takes each value of a literal range.
fn reach(index: &Index, loops: &[Loop]) -> Option<(i64, i64)> {
    match index.terms.as_slice() {
        [] => Some((index.constant, index.constant.saturating_add(1))),
        [(Atom::Open(depth), 1)] => {
            let over =
                loops.iter().find(|over| over.depth == *depth && over.range.left_out().next().is_none())?;
            let (lower, upper) = (over.range.lower.as_literal()?, over.range.upper.as_literal()?);
            Some((lower.saturating_add(index.constant), upper.saturating_add(index.constant)))
        }
        _ => None,
    }
}

/// Where no arrays are involved and the entries are numbers times one common factor: whether the numbers
/// make a singular matrix, by elimination with complete pivoting. What rounding may have left of a
/// difference counts as zero.
pub(super) fn is_numerically_singular(model: &Model, mass: &[Entry]) -> bool {
    if mass.iter().all(|entry| entry.row == entry.column) {
        return false;
    }
    let dimension = model.blocks.len();
    let common = mass.first().map(|entry| entry.value.node);
    if model.blocks.iter().any(|block| block.array.is_some())
        || mass.iter().any(|entry| Some(entry.value.node) != common)
    {
        return false;
    }
    // Each entry with the size of what it was added up from.
    let mut matrix = vec![vec![(0.0_f64, 0.0_f64); dimension]; dimension];
    for entry in mass {
        let ([row, column], value) = (entry.blocks(), entry.value.scale);
        matrix[row][column] = (value, value.abs());
        matrix[column][row] = (value, value.abs());
    }
    while let Some((row, column)) = pivot(&matrix) {
        let pivoted = matrix.swap_remove(row);
        for other in &mut matrix {
            let factor = other[column].0 / pivoted[column].0;
            for ((value, size), (subtracted, _)) in other.iter_mut().zip(&pivoted) {
                *value -= factor * subtracted;
                *size += (factor * subtracted).abs();
            }
            other[column] = (0.0, 0.0);
        }
    }
    !matrix.is_empty()
}

/// The largest entry that is more than rounding.
fn pivot(matrix: &[Vec<(f64, f64)>]) -> Option<(usize, usize)> {
    let columns = matrix.iter().enumerate().flat_map(|(row, entries)| {
        entries.iter().enumerate().map(move |(column, (value, size))| (row, column, value.abs(), *size))
    });
    let significant = columns.filter(|(_, _, value, size)| *value > 64.0 * f64::EPSILON * size);
    significant.max_by(|a, b| a.2.total_cmp(&b.2)).map(|(row, column, ..)| (row, column))
}
