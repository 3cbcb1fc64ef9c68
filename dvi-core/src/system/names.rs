//! The entries of a state one after the other, with names: for the columns of a table.

use core::fmt;

use super::{CoordinateBlock, System};

/// The name of an entry of a state: `x`, `x[3]`, `dot_x[3]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the block of coordinates.
    pub block: &'static str,
    /// Whether it is the velocity.
    pub is_velocity: bool,
    /// The index in an array of coordinates.
    pub index: Option<usize>,
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = if self.is_velocity { "dot_" } else { "" };
        match self.index {
            Some(index) => write!(f, "{prefix}{}[{index}]", self.block),
            None => write!(f, "{prefix}{}", self.block),
        }
    }
}

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
