//! Arrays that are written with two indices: with another size, which is 1 in the test, before their own or
//! behind it.

use super::Writer;
use crate::oracle_tests::formula::Index;
use crate::oracle_tests::system::{SizeKind, System};

/// The other size, a field of the struct.
pub(in super::super) const ONE: &str = "one";

impl System {
    /// Whether an array of numbers has another size before its own; `None` if it has none.
    fn is_behind(&self, block: usize) -> Option<bool> {
        let size = self.blocks[block].size.filter(|_| self.axes(block) == 1 && !self.is_whole(block))?;
        // A literal second size is that of vectors.
        let can_be_behind = self.sizes[size].kind != SizeKind::Literal;
        match (block + self.fields.len() + self.sizes.len()) % 5 {
            0 => Some(false),
            1 if can_be_behind => Some(true),
            _ => None,
        }
    }

    pub(in super::super) fn has_grids(&self) -> bool {
        (0..self.blocks.len()).any(|block| self.is_behind(block).is_some())
    }

    /// `[own]`, with `other` in brackets before it or behind it.
    pub(in super::super) fn bracketed(&self, block: usize, own: &str, other: &str) -> String {
        match self.is_behind(block) {
            None => format!("[{own}]"),
            Some(false) => format!("[{own}][{other}]"),
            Some(true) => format!("[{other}][{own}]"),
        }
    }

    /// The indices of a component.
    pub(super) fn bars(&self, block: usize) -> &'static str {
        match self.is_behind(block) {
            None => "|i| ",
            Some(false) => "|i, _| ",
            Some(true) => "|_, i| ",
        }
    }
}

impl Writer<'_> {
    pub(in super::super) fn place(&self, block: usize, index: Option<&Index>) -> String {
        if self.system.is_rotation(block) {
            return self.entry(block, index);
        }
        let component = self.system.blocks[block].axis.map(|[number, _]| format!("[{number}]"));
        format!("{}{}", self.whole(block, index), component.unwrap_or_default())
    }

    /// Without the index of a component.
    pub(in super::super) fn whole(&self, block: usize, index: Option<&Index>) -> String {
        let name = self.system.blocks[block].name;
        let bracketed = |index| self.system.bracketed(block, &self.index(index), "0");
        format!("{name}{}", index.map_or_else(String::new, bracketed))
    }
}
