//! The entries of a state one after the other, with names: for the columns of a table.

use super::spinors::is_spinor;
use super::{CoordinateBlock, System};
use crate::name::{Axis, Name};
use crate::scalar::spinor;

/// The names of all entries of the states of `system`, coordinates first, each with its place among the
/// coordinates or among the velocities. Those of unit vectors of a degenerate system stand where
/// [`lower_all`](super::spinors::lower_all) puts them.
pub(crate) fn entries<S: System>(system: &S) -> Entries<'_, S> {
    Entries { system, is_velocity: false, block: 0, first: 0, index: 0 }
}

/// Stands before an entry.
pub(crate) struct Entries<'a, S> {
    system: &'a S,
    is_velocity: bool,
    /// The number of a block of coordinates, the first of a vector, and the place of its first coordinate.
    block: usize,
    first: usize,
    /// The number of an entry within the block, or within all blocks of a vector.
    index: usize,
}

impl<S: System> Iterator for Entries<'_, S> {
    type Item = (Name, usize);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Some(declared) = S::REPORT.coordinates.get(self.block) else {
                if self.is_velocity || !S::REGULAR {
                    return None;
                }
                *self = Self { is_velocity: true, ..entries(self.system) };
                continue;
            };
            let &CoordinateBlock { name, size, axis, factor } = declared;
            let &mut Self { system, is_velocity, block, first, index } = self;
            let coordinates = system.block_len(block);
            let blocks = axis.map_or(1, |axis| usize::from(axis.of));
            // Of the components of an array, or of the entries of one, not all have velocities.
            let velocities = |of| if is_velocity { factor.velocities(of) } else { of };
            let [components, count] = match axis {
                Some(_) if is_spinor(declared, S::REGULAR) => [spinor::COMPONENTS, coordinates],
                Some(_) => [velocities(blocks), coordinates],
                None => [1, velocities(coordinates)],
            };
            if index < components * count {
                self.index += 1;
                let (entry, number) = (index / components, index % components);
                let index = (!size.is_empty()).then_some(entry);
                let length = system.block_len(S::REPORT.coordinates.len() + block);
                let row = index.and_then(|index| index.checked_div(length));
                let index = index.map(|index| index.checked_rem(length).unwrap_or(index));
                let axis = axis.map(|_| Axis { number: number as u8, of: components as u8 });
                return Some((
                    Name { block: name, is_velocity, row, index, axis, factor },
                    first + number * coordinates + entry,
                ));
            }
            (self.block, self.first, self.index) = (block + blocks, first + blocks * coordinates, 0);
        }
    }
}
