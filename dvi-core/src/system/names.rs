//! The entries of a state one after the other, with names: for the columns of a table.

use super::spinors::is_spinor;
use super::{CoordinateBlock, System};
use crate::name::{Axis, Name};
use crate::scalar::spinor;

/// The names of all entries of the states of `system`, coordinates first, each with its place among the
/// coordinates or among the velocities. Those of unit vectors of a degenerate system stand where
/// [`lower_all`](super::spinors::lower_all) puts them.
pub(crate) fn entries<S: System>(system: &S) -> impl Iterator<Item = (Name, usize)> {
    let mut place = Place::default();
    core::iter::from_fn(move || {
        place.pass(S::REPORT.coordinates, S::REGULAR, &|block| system.block_len(block))
    })
}

/// Stands before an entry.
#[derive(Default)]
struct Place {
    is_velocity: bool,
    /// The number of a block of coordinates, the first of a vector, and the place of its first coordinate.
    block: usize,
    first: usize,
    /// The number of an entry within the block, or within all blocks of a vector.
    index: usize,
}

impl Place {
    /// The entry behind, in blocks of these lengths.
    fn pass(
        &mut self,
        declared: &[CoordinateBlock],
        is_regular: bool,
        len: &dyn Fn(usize) -> usize,
    ) -> Option<(Name, usize)> {
        loop {
            let &mut Self { is_velocity, block, first, index } = self;
            let Some(here) = declared.get(block) else {
                if is_velocity || !is_regular {
                    return None;
                }
                *self = Self { is_velocity: true, ..Self::default() };
                continue;
            };
            let &CoordinateBlock { name, size, axis, factor } = here;
            let coordinates = len(block);
            let blocks = axis.map_or(1, |axis| usize::from(axis.of));
            // Of the components of an array, or of the entries of one, not all have velocities.
            let velocities = |of| if is_velocity { factor.velocities(of) } else { of };
            let [components, count] = match axis {
                Some(_) if is_spinor(here, is_regular) => [spinor::COMPONENTS, coordinates],
                Some(_) => [velocities(blocks), coordinates],
                None => [1, velocities(coordinates)],
            };
            if index < components * count {
                self.index += 1;
                let (entry, number) = (index / components, index % components);
                let index = (!size.is_empty()).then_some(entry);
                let length = len(declared.len() + block);
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
