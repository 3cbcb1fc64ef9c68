//! The entries of a state one after the other, with names: for the columns of a table.

use super::{CoordinateBlock, System};
use crate::name::Name;

/// The names of all entries of the states of `system`, coordinates first, each with its place among the coordinates or among the
/// velocities.
pub(crate) fn entries<S: System>(system: &S) -> impl Iterator<Item = (Name, usize)> {
    let halves: &[bool] = if S::REGULAR { &[false, true] } else { &[false] };
    halves.iter().flat_map(move |&is_velocity| {
        let mut first = 0;
        S::REPORT.coordinates.iter().enumerate().flat_map(move |(number, block)| {
            let &CoordinateBlock { name: block, size, factor } = block;
            let coordinates = system.block_len(number);
            let count = if is_velocity { factor.velocities(coordinates) } else { coordinates };
            let begin = first;
            first += coordinates;
            let is_array = !size.is_empty();
            (0..count).map(move |index| {
                let name = Name { block, is_velocity, index: is_array.then_some(index), factor };
                (name, begin + index)
            })
        })
    })
}
