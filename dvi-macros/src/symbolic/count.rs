//! How many passes loops have: one, or one inside of another whose range goes with the outer index.

use super::index::{Atom, Index, Loop};

/// The sum of the rows, if there are some, and `rest`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) rows: Option<Rows>,
    /// Below zero it stands for zero.
    pub(crate) rest: Index,
}

/// Σ max(0, first + step·k) for k from 0 to below `count`: the passes of an inner loop, in each of the outer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Rows {
    pub(crate) first: Index,
    pub(crate) step: i64,
    pub(crate) count: Index,
}

/// Longer sums are not added up here.
const MOST_ROWS: i64 = 1 << 16;

impl From<Index> for Count {
    fn from(rest: Index) -> Self {
        Self { rows: None, rest }
    }
}

impl Count {
    /// All passes of loops, two at most; one if there is none.
    pub(crate) fn of_passes(loops: &[Loop]) -> Self {
        match loops {
            [] => Index::literal(1).into(),
            [only] => length(only).into(),
            [outer, inner, ..] => {
                Self { rows: Some(Rows::of(length(outer), outer, inner)), rest: Index::default() }
            }
        }
    }

    /// The passes of loops before the one that is under way.
    pub(crate) fn of_passes_before(loops: &[Loop]) -> Self {
        match loops {
            [] => Index::default().into(),
            [only] => place(only).into(),
            [outer, inner, ..] => {
                Self { rows: Some(Rows::of(place(outer), outer, inner)), rest: place(inner) }
            }
        }
    }

    pub(crate) fn as_literal(&self) -> Option<i64> {
        self.value(Index::as_literal)
    }

    /// Its value where indices have these, if all are known and there are not too many rows.
    pub(crate) fn value(&self, index: impl Fn(&Index) -> Option<i64>) -> Option<i64> {
        let rest = index(&self.rest)?;
        let Some(Rows { first, step, count }) = &self.rows else { return Some(rest) };
        let (first, count) = (index(first)?, index(count)?);
        let rows =
            (0..count).map(|row| step.checked_mul(row)?.checked_add(first).map(|length| length.max(0)));
        let sum = |sum: i64, row: Option<i64>| sum.checked_add(row?);
        if count > MOST_ROWS { None } else { rows.into_iter().try_fold(0, sum)?.checked_add(rest) }
    }

    /// Whether it is known not to need the zero that stands for less.
    pub(crate) fn is_natural(&self) -> bool {
        self.rest.is_natural()
    }
}

impl Rows {
    fn of(count: Index, outer: &Loop, inner: &Loop) -> Self {
        let (length, index) = (length(inner), Atom::Open(outer.depth));
        let step = length.terms.iter().find(|(atom, _)| *atom == index).map_or(0, |(_, step)| *step);
        let first = length.plus(&Index::atom(index), -step).plus(&outer.range.lower, step);
        Self { first, step, count }
    }
}

fn length(over: &Loop) -> Index {
    over.range.upper.plus(&over.range.lower, -1)
}

fn place(over: &Loop) -> Index {
    Index::open(over.depth).plus(&over.range.lower, -1)
}
