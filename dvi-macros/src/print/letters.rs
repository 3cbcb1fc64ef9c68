//! Names, letters of indices, and places in arrays, as text.

use crate::internal::internal;
use crate::model::Model;
use crate::symbolic::{Atom, Coordinate, Index, Range};
use crate::syntax::{Factor, Kind};

/// How a formula is written.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Notation {
    Paper,
    /// As the attribute reads it.
    Language,
}

pub(super) fn letter(number: usize) -> String {
    match "ijkl".chars().nth(number) {
        Some(letter) => letter.to_string(),
        None => format!("i{number}"),
    }
}

/// The letter, or with underscores that which nothing else is called.
fn free_letter(number: usize, model: &Model) -> String {
    let mut name = letter(number);
    while model.is_taken(&name) {
        name.push('_');
    }
    name
}

/// The letters of the indices: open ones by depth, then those of the sums around a place.
#[derive(Clone)]
pub(super) struct Letters<'a> {
    pub(super) model: &'a Model,
    pub(super) depth: usize,
    /// Heights of the sums around, from the outside.
    pub(super) sums: Vec<u32>,
    pub(super) notation: Notation,
}

impl Letters<'_> {
    pub(super) fn inside(&self, height: u32) -> Self {
        let sums = self.sums.iter().copied().chain([height]).collect();
        Self { sums, ..self.clone() }
    }

    /// A name that is a keyword of Rust is one on paper without more ado.
    pub(super) fn name(&self, name: &str) -> String {
        match self.notation {
            Notation::Paper => name.replace("r#", ""),
            Notation::Language => name.to_string(),
        }
    }

    pub(super) fn letter(&self, number: usize) -> String {
        match self.notation {
            Notation::Paper => letter(number),
            Notation::Language => free_letter(number, self.model),
        }
    }

    pub(super) fn times(&self) -> &'static str {
        match self.notation {
            Notation::Paper => "·",
            Notation::Language => " * ",
        }
    }

    fn atom(&self, atom: &Atom) -> String {
        match atom {
            Atom::Open(depth) => self.letter(*depth as usize),
            Atom::Bound(height) => match self.sums.iter().rposition(|known| known == height) {
                Some(position) => self.letter(self.depth + position),
                None => internal("an index outside of its sum"),
            },
            Atom::Size(size) => self.name(&self.model.sizes[size.0 as usize].text),
            Atom::Remainder(value, modulus) => {
                let [value, modulus] = [value, modulus].map(|index| self.index(index));
                match self.notation {
                    Notation::Paper => format!("({value}) % {modulus}"),
                    Notation::Language => format!("(({value}) % ({modulus}))"),
                }
            }
            // Sizes in front of the index.
            Atom::Product(factors) => {
                let factors = factors.iter().rev().map(|factor| match factor {
                    Atom::Remainder(..) => format!("({})", self.atom(factor)),
                    Atom::Open(_) | Atom::Bound(_) | Atom::Size(_) | Atom::Product(_) | Atom::Row(..) => {
                        self.atom(factor)
                    }
                });
                factors.collect::<Vec<_>>().join(self.times())
            }
            Atom::Row(..) => internal("a place in a row is written with its two indices"),
        }
    }

    pub(super) fn index(&self, index: &Index) -> String {
        // An index of the language begins with what is added.
        let begins_negative = index.counted_terms().next().is_some_and(|(_, coefficient)| *coefficient < 0);
        let leads = begins_negative && self.notation == Notation::Language;
        let mut text = if leads { index.constant.to_string() } else { String::new() };
        for (atom, coefficient) in index.counted_terms() {
            let name = self.atom(atom);
            let sign = match (*coefficient < 0, text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            };
            text += sign;
            if coefficient.abs() != 1 {
                text += &format!("{}{}", coefficient.abs(), self.times());
            }
            text += &name;
        }
        match (if leads { 0 } else { index.constant }, text.is_empty()) {
            (constant, true) => constant.to_string(),
            (0, false) => text,
            (constant, false) if constant < 0 => format!("{text} - {}", -constant),
            (constant, false) => format!("{text} + {constant}"),
        }
    }

    pub(super) fn range(&self, letter: &str, range: &Range) -> String {
        let (lower, upper) = (self.index(&range.lower), self.index(&range.upper));
        let except: Vec<String> = range.left_out().map(|index| self.index(index)).collect();
        let except =
            if except.is_empty() { String::new() } else { format!(" without {}", except.join(", ")) };
        format!("{letter} in {lower}..{upper}{except}")
    }

    pub(super) fn coordinate(&self, coordinate: &Coordinate) -> String {
        let Coordinate { block, index } = coordinate;
        if let Some((name, entry)) = self.of_rotation(coordinate) {
            return format!("{name}[{}][{}]", entry / 3, entry % 3);
        }
        let declared = &self.model.blocks[*block as usize];
        let name = if declared.is_spinor() { declared.spinor() } else { declared.name.to_string() };
        let index = match declared.row_length() {
            Some(length) => {
                index.row_and_column(length).map(|index| format!("[{}]", self.index(&index))).concat()
            }
            None if declared.array.is_some() => format!("[{}]", self.index(index)),
            None => String::new(),
        };
        let component = declared.axis.map_or_else(String::new, |axis| format!("[{}]", axis.number));
        format!("{}{index}{component}", self.name(&name))
    }

    pub(super) fn velocity(&self, coordinate: &Coordinate) -> String {
        match self.of_rotation(coordinate) {
            Some((name, entry)) => format!("omega({name})[{entry}]"),
            None => {
                let velocity = match self.model.kind {
                    Kind::Degenerate => "d",
                    Kind::Regular => "dot",
                };
                format!("{velocity}({})", self.coordinate(coordinate))
            }
        }
    }

    /// The rotation that a coordinate is an entry of, or that a velocity is of, and which of them it is.
    fn of_rotation(&self, Coordinate { block, index }: &Coordinate) -> Option<(String, i64)> {
        let declared = &self.model.blocks[*block as usize];
        if declared.factor != Factor::Rotation {
            return None;
        }
        let name = self.name(&declared.name.to_string());
        Some(match declared.axis {
            Some(axis) => (format!("{name}[{}]", self.index(index)), axis.number as i64),
            None => (name, index.as_literal()?),
        })
    }
}
