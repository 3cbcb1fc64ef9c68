//! Which entries may be read outside of the loops that a formula reads them in.
//!
//! What a sum says of its terms is moved out of the sum as far as it goes: `x[i]·y[j]` in a loop over j
//! reads `x[i]` once, in front of that loop. Where the loop may be empty, the formula does not read
//! `x[i]` at all, and it need not exist. An index that is not certain to be inside of its array is
//! therefore tied to every loop around it that may be empty: a remainder by one, which is zero, makes it
//! depend on that loop, and so does all that is computed from it.

use super::{Lowering, reach};
use crate::internal::internal;
use crate::symbolic::{Atom, Index, Loop, Size};

impl Lowering<'_> {
    /// The index of an entry of an array of one of these lengths, if any is known.
    pub(super) fn tied(&mut self, index: Index, lengths: &[Index]) -> Index {
        if self.is_inside(&index, lengths) { index } else { self.tied_to_loops(index) }
    }

    /// Whether an index is certain to be inside of an array of one of these lengths.
    pub(super) fn is_inside(&self, index: &Index, lengths: &[Index]) -> bool {
        let around = self.loops_around();
        let is_below = |length: &Index| {
            let rest = length.plus(&Index::literal(1), -1).plus(index, -1);
            self.is_natural(&rest, &around)
        };
        self.is_natural(index, &around) && lengths.iter().any(is_below)
    }

    /// The index, or the place, of what may not be there.
    pub(super) fn tied_to_loops(&mut self, index: Index) -> Index {
        let around = self.loops_around();
        let needed = reach::needed(&around, &index);
        let loose =
            around.iter().filter(|over| needed & (1 << over.depth) == 0 && !self.surely_runs(over, &around));
        let ties: Vec<Index> = loose.map(|over| tie(over.depth)).collect();
        self.ties += ties.len();
        ties.iter().fold(index, |index, tie| index.plus(tie, 1))
    }

    fn surely_runs(&self, over: &Loop, around: &[&Loop]) -> bool {
        let left_out = 1 + over.range.left_out().count() as i64;
        let rest = over.range.upper.plus(&over.range.lower, -1).plus(&Index::literal(left_out), -1);
        let outside: Vec<&Loop> = around.iter().copied().filter(|other| other.depth < over.depth).collect();
        self.is_natural(&rest, &outside)
    }

    /// Whether an index is known not to be negative in any pass of the loops around: the innermost index in
    /// it takes the end of its range where the form is smallest, and so on to the outermost.
    fn is_natural(&self, index: &Index, around: &[&Loop]) -> bool {
        let mut form = index.clone();
        for over in around.iter().rev() {
            let open = Atom::Open(over.depth);
            let Some((_, coefficient)) = form.terms.iter().find(|(atom, _)| *atom == open).cloned() else {
                continue;
            };
            let last = over.range.upper.plus(&Index::literal(1), -1);
            let end = if coefficient > 0 { &over.range.lower } else { &last };
            form = form.plus(&Index::atom(open), -coefficient).plus(end, coefficient);
        }
        let least = form.terms.iter().try_fold(form.constant, |sum, (atom, coefficient)| match atom {
            Atom::Size(size) if *coefficient > 0 => Some(sum + coefficient * least_size(*size, around)),
            Atom::Remainder(..) | Atom::Product(_) | Atom::Row(..) if *coefficient > 0 => Some(sum),
            Atom::Remainder(_, modulus) => Some(sum + coefficient * (modulus.as_literal()? - 1)),
            Atom::Size(_) | Atom::Open(_) | Atom::Product(_) | Atom::Row(..) => None,
            Atom::Bound(_) => internal("an index of a closed sum in the text of a formula"),
        });
        least.is_some_and(|least| least >= 0)
    }
}

/// A size may be zero, but a loop that runs up to it is not empty.
fn least_size(size: Size, around: &[&Loop]) -> i64 {
    let size = Index::size(size);
    i64::from(around.iter().any(|over| over.range.upper == size))
}

/// Zero, in the loop at `depth`.
fn tie(depth: u32) -> Index {
    Index::open(depth).remainder(&Index::literal(1))
}
