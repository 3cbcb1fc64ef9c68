//! Index arithmetic: affine combinations of bound indices and sizes, and remainders of them.
//!
//! Bound indices are named by their nesting level, so that the same sum written twice is the same
//! node. Indices are mathematical integers; `%` is the Euclidean remainder.

/// A size that is not a literal: an entry of the model's table of sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Size(pub(crate) u32);

#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Atom {
    /// The index of the sum at this nesting level.
    Bound(u32),
    Size(Size),
    Remainder(Box<Index>, Box<Index>),
}

/// constant + Σ coefficient·atom, atoms in order, no zero coefficient.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Index {
    pub(crate) constant: i64,
    pub(crate) terms: Vec<(Atom, i64)>,
}

/// Σ over `lower <= index < upper`, leaving out `except`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Binder {
    pub(crate) level: u32,
    pub(crate) lower: Index,
    pub(crate) upper: Index,
    pub(crate) except: Option<Index>,
}

impl Index {
    pub(crate) fn literal(constant: i64) -> Self {
        Self { constant, terms: Vec::new() }
    }

    pub(crate) fn atom(atom: Atom) -> Self {
        Self { constant: 0, terms: vec![(atom, 1)] }
    }

    pub(crate) fn bound(level: u32) -> Self {
        Self::atom(Atom::Bound(level))
    }

    pub(crate) fn size(size: Size) -> Self {
        Self::atom(Atom::Size(size))
    }

    pub(crate) fn as_literal(&self) -> Option<i64> {
        self.terms.is_empty().then_some(self.constant)
    }

    pub(crate) fn plus(&self, other: &Self, factor: i64) -> Self {
        let mut sum = self.clone();
        sum.constant = sum.constant.saturating_add(other.constant.saturating_mul(factor));
        for (atom, coefficient) in &other.terms {
            let coefficient = coefficient.saturating_mul(factor);
            match sum.terms.iter_mut().find(|(known, _)| known == atom) {
                Some((_, known)) => *known = known.saturating_add(coefficient),
                None => sum.terms.push((atom.clone(), coefficient)),
            }
        }
        sum.terms.retain(|(_, coefficient)| *coefficient != 0);
        sum.terms.sort();
        sum
    }

    pub(crate) fn times(&self, factor: i64) -> Self {
        Self::default().plus(self, factor)
    }

    pub(crate) fn remainder(&self, modulus: &Self) -> Self {
        match (self.as_literal(), modulus.as_literal()) {
            (Some(value), Some(modulus)) if modulus > 0 => Self::literal(value.rem_euclid(modulus)),
            _ => Self::atom(Atom::Remainder(Box::new(self.clone()), Box::new(modulus.clone()))),
        }
    }

    /// The set of bound levels that this index depends on, a bit each.
    pub(crate) fn free(&self) -> u64 {
        let of = |atom: &Atom| match atom {
            Atom::Bound(level) => 1 << level,
            Atom::Size(_) => 0,
            Atom::Remainder(value, modulus) => value.free() | modulus.free(),
        };
        self.terms.iter().fold(0, |free, (atom, _)| free | of(atom))
    }

    /// Whether this is a bound index, a remainder or a literal as it stands, without an offset.
    ///
    /// What is computed from `x[i + 1]` in a loop over j may be moved out of that loop, where it is read
    /// even if there is no j for the last i. So an index with an offset is checked in the passes of all loops
    /// around it, and read, where it is out of range, as zero, which no pass uses. An index without one is
    /// checked in all passes of its own loops, and needs no care when it is read.
    pub(crate) fn is_plain(&self) -> bool {
        match self.terms.as_slice() {
            [] => true,
            [(Atom::Bound(_) | Atom::Remainder(..), 1)] => self.constant == 0,
            _ => false,
        }
    }

    /// Moves the levels from `from` on by `by`.
    pub(crate) fn shift(&self, from: u32, by: u32) -> Self {
        let shifted = |atom: &Atom| match atom {
            Atom::Bound(level) if *level >= from => Atom::Bound(level + by),
            Atom::Remainder(value, modulus) => {
                Atom::Remainder(Box::new(value.shift(from, by)), Box::new(modulus.shift(from, by)))
            }
            other => other.clone(),
        };
        let mut index = Self {
            constant: self.constant,
            terms: self.terms.iter().map(|(atom, coefficient)| (shifted(atom), *coefficient)).collect(),
        };
        index.terms.sort();
        index
    }
}

impl Binder {
    /// The levels that the range depends on.
    pub(crate) fn free(&self) -> u64 {
        self.lower.free() | self.upper.free() | self.except.as_ref().map_or(0, Index::free)
    }

    pub(crate) fn shift(&self, from: u32, by: u32) -> Self {
        Self {
            level: if self.level >= from { self.level + by } else { self.level },
            lower: self.lower.shift(from, by),
            upper: self.upper.shift(from, by),
            except: self.except.as_ref().map(|except| except.shift(from, by)),
        }
    }

    /// Whether the range is known to be empty.
    pub(crate) fn is_empty(&self) -> bool {
        self.upper.plus(&self.lower, -1).as_literal().is_some_and(|length| length <= 0)
    }
}
