//! The entries of a state one after the other, with names: for the columns of a table.

use super::{CoordinateBlock, System};
use crate::name::Name;

/// The names of all entries of the states of `system`, coordinates first.
pub(super) fn names<S: System>(system: &S) -> impl Iterator<Item = Name> {
    let halves: &[bool] = if S::REGULAR { &[false, true] } else { &[false] };
    halves.iter().flat_map(move |&is_velocity| {
        S::REPORT.coordinates.iter().enumerate().flat_map(move |(number, block)| {
            let &CoordinateBlock { name: block, size } = block;
            let is_array = !size.is_empty();
            (0..system.block_len(number)).map(move |index| Name {
                block,
                is_velocity,
                index: is_array.then_some(index),
            })
        })
    })
}
