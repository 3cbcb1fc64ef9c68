//! Parts of formulas that a system writes once, in `let = { … }`: values, and functions of indices.

use std::cell::RefCell;

use super::{INDICES, Writer, is_in_brackets};
use crate::oracle_tests::formula::{Atom, Formula, Index};

/// What is defined so far, as (formula, name, definition).
#[derive(Default)]
pub(super) struct Definitions(RefCell<Vec<(Formula, String, String)>>);

impl Definitions {
    /// The name that a formula has.
    pub(super) fn name_of(&self, formula: &Formula) -> Option<String> {
        let known = self.0.borrow();
        known.iter().find(|(known, ..)| known == formula).map(|(_, name, _)| name.clone())
    }

    /// The name that a formula gets, which stands in front of its definition.
    pub(super) fn add(&self, formula: &Formula, definition: &str) -> String {
        let mut known = self.0.borrow_mut();
        let name = format!("part{}", known.len());
        known.push((formula.clone(), name.clone(), format!("let {name} = {definition};")));
        name
    }

    /// The argument of the attribute, if there is one.
    pub(super) fn argument(&self) -> Option<String> {
        let known = self.0.borrow();
        let definitions: Vec<&str> = known.iter().map(|(.., definition)| definition.as_str()).collect();
        (!definitions.is_empty()).then(|| format!("let = {{ {} }}", definitions.join(" ")))
    }
}

impl Writer<'_> {
    /// Sometimes, a formula by a name that all formulas share.
    pub(super) fn by_definition(&self, formula: &Formula) -> Option<String> {
        const SMALLEST: usize = 4;
        let levels = if formula.weight() < SMALLEST { None } else { formula.open_levels() }?;
        let indices = levels.iter().map(|level| INDICES[*level]).collect::<Vec<_>>().join(", ");
        let call = |name: String| if levels.is_empty() { name } else { format!("{name}({indices})") };
        if let Some(known) = self.definitions.name_of(formula) {
            return Some(call(known));
        }
        if !self.spelling.is_rare() {
            return None;
        }
        let (text, _) = self.written_here(formula);
        let are_read = levels.iter().all(|level| is_in_brackets(&text, INDICES[*level]));
        let definition = if levels.is_empty() { text } else { format!("|{indices}| {text}") };
        are_read.then(|| call(self.definitions.add(formula, &definition)))
    }
}

impl Formula {
    /// The levels of the indices that are bound around it; `None` if it depends on a `let` of a formula.
    fn open_levels(&self) -> Option<Vec<usize>> {
        let mut levels = Vec::new();
        for part in self.parts() {
            levels.extend(part.open_levels()?);
        }
        match self {
            Self::Name(_) | Self::VectorName(_) => return None,
            Self::Sum(loops, level, ..) => {
                levels.retain(|open| !(*level..level + loops.indices()).contains(open));
            }
            _ => {}
        }
        levels.extend(self.indices().iter().flat_map(Index::levels));
        levels.sort_unstable();
        levels.dedup();
        Some(levels)
    }
}

impl Index {
    fn levels(&self) -> Vec<usize> {
        let of_atom = |(atom, _): &(Atom, i64)| match atom {
            Atom::Bound(level) | Atom::Times(_, level) => vec![*level],
            Atom::Size(_) => Vec::new(),
            Atom::Remainder(value, modulus) => [value.levels(), modulus.levels()].concat(),
        };
        self.terms.iter().flat_map(of_atom).collect()
    }
}
