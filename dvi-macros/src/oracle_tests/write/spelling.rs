//! Spellings that mean the same, of which sometimes one is taken and sometimes another.

use std::cell::Cell;

/// Where the language has two spellings, sometimes the other one is taken: the same ones for the same
/// system.
pub(in crate::oracle_tests) struct Spelling(Cell<u32>);

impl Spelling {
    pub(super) fn new(seed: u32) -> Self {
        Self(Cell::new(seed))
    }

    pub(in crate::oracle_tests) fn is_other(&self) -> bool {
        let next = self.0.get().wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0.set(next);
        next >> 30 == 0
    }

    pub(super) fn is_rare(&self) -> bool {
        self.is_other() && self.is_other()
    }
}

/// Whether a text has a name in brackets, where indices stand.
pub(super) fn is_in_brackets(text: &str, name: &str) -> bool {
    let (mut depth, mut word, mut found) = (0_u32, String::new(), false);
    for letter in text.chars().chain([' ']) {
        if letter.is_alphanumeric() || letter == '_' {
            word.push(letter);
            continue;
        }
        found |= depth > 0 && word == name;
        word.clear();
        depth = match letter {
            '[' => depth + 1,
            ']' => depth - 1,
            _ => depth,
        };
    }
    found
}
