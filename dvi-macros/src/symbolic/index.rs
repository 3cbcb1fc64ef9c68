//! Index arithmetic: affine combinations of indices and sizes, and remainders of them.
//!
//! An index has one of two kinds of name, and no binder of one kind can capture a name of the other
//! (the locally nameless representation; McBride & McKinna 2004, Charguéraud 2012). Inside of a sum
//! that stands in an expression, its index is [`Atom::Bound`] with the height of that sum: one more
//! than the heights of all sums inside of it, so that the same sum is the same node wherever it
//! stands, and heights fall strictly on the way inwards. The index of a loop that runs around an
//! expression is [`Atom::Open`] with the depth of that loop, and depths rise strictly on the way
//! inwards. A sum becomes a loop, and a loop a sum, by replacing one name with the other.
//!
//! A size times an index is an atom of its own, so that places in a square are affine, too. The first index
//! of an array with two is another one, so that both can be told from the place.
//!
//! Indices are mathematical integers; `%` is the Euclidean remainder. No index is negative: a sum
//! whose range may begin below zero is shifted when it is made.

use crate::internal::internal;

/// A size that is not a literal: an entry of the model's table of sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Size(pub(crate) u32);

#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Atom {
    /// The index of the loop at this depth.
    Open(u32),
    /// The index of the sum of this height, which stands around it in the same expression.
    Bound(u32),
    Size(Size),
    Remainder(Box<Index>, Box<Index>),
    /// Of two factors at least, in order, none of which is a product.
    Product(Vec<Self>),
    /// The place where a row of an array with two indices begins: its number, and the length of the rows.
    Row(Box<Index>, Box<Index>),
}

/// constant + Σ coefficient·atom, atoms in order, no zero coefficient.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Index {
    pub(crate) constant: i64,
    pub(crate) terms: Vec<(Atom, i64)>,
}

/// A place some steps away from that of a loop on a ring.
#[derive(Debug)]
pub(crate) struct OnRing<'a> {
    /// The index where the steps do not lead around the end.
    pub(crate) unturned: Index,
    pub(crate) shift: i64,
    pub(crate) length: &'a Index,
}

/// The values `lower <= index < upper` without some.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Range {
    pub(crate) lower: Index,
    pub(crate) upper: Index,
    /// The value that the formula leaves out.
    pub(crate) except: Option<Index>,
    /// The values whose factors a derivative took out of a product.
    pub(crate) taken: Vec<Index>,
}

/// A loop over the open index at `depth`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Loop {
    pub(crate) depth: u32,
    pub(crate) range: Range,
}

/// The indices that something depends on, a bit for each name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Free {
    /// Depths of loops.
    pub(crate) open: u64,
    /// Heights of sums.
    pub(crate) bound: u64,
}

impl Free {
    pub(crate) fn and(self, other: Self) -> Self {
        Self { open: self.open | other.open, bound: self.bound | other.bound }
    }

    /// The number of loops that must run around what depends on these indices.
    pub(crate) fn depth(self) -> u32 {
        u64::BITS - self.open.leading_zeros()
    }
}

/// One name instead of another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Renaming {
    pub(crate) from: Atom,
    pub(crate) to: Atom,
}

fn whole(sum: Option<i64>) -> i64 {
    sum.unwrap_or_else(|| internal("an index has more than 63 bits"))
}

impl Index {
    pub(crate) fn literal(constant: i64) -> Self {
        Self { constant, terms: Vec::new() }
    }

    /// Whether sums and products with another such one have no more than 63 bits.
    pub(crate) fn is_short(&self) -> bool {
        let mut coefficients = self.terms.iter().map(|(_, coefficient)| coefficient).chain([&self.constant]);
        coefficients.all(|coefficient| coefficient.unsigned_abs() < 1 << 31)
    }

    pub(crate) fn atom(atom: Atom) -> Self {
        Self { constant: 0, terms: vec![(atom, 1)] }
    }

    pub(crate) fn open(depth: u32) -> Self {
        Self::atom(Atom::Open(depth))
    }

    pub(crate) fn size(size: Size) -> Self {
        Self::atom(Atom::Size(size))
    }

    pub(crate) fn as_literal(&self) -> Option<i64> {
        self.terms.is_empty().then_some(self.constant)
    }

    pub(crate) fn plus(&self, other: &Self, factor: i64) -> Self {
        let mut sum = self.clone();
        sum.constant =
            whole(other.constant.checked_mul(factor).and_then(|term| sum.constant.checked_add(term)));
        for (atom, coefficient) in &other.terms {
            let coefficient = whole(coefficient.checked_mul(factor));
            match sum.terms.iter_mut().find(|(known, _)| known == atom) {
                Some((_, known)) => *known = whole(known.checked_add(coefficient)),
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

    /// The product with another index, multiplied out.
    pub(crate) fn product(&self, other: &Self) -> Self {
        let mut product = self.times(other.constant).plus(other, self.constant);
        product.constant = whole(self.constant.checked_mul(other.constant));
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let factors = left.factors().iter().chain(right.factors()).cloned().collect();
                product = product.plus(&Self::atom(Atom::product(factors)), whole(a.checked_mul(*b)));
            }
        }
        product
    }

    pub(crate) fn remainder(&self, modulus: &Self) -> Self {
        match (self.as_literal(), modulus.as_literal()) {
            (Some(value), Some(modulus)) if modulus > 0 => Self::literal(value.rem_euclid(modulus)),
            _ => Self::atom(Atom::Remainder(Box::new(self.clone()), Box::new(modulus.clone()))),
        }
    }

    /// The place of an entry of an array with two indices, whose rows of this length follow each other.
    pub(crate) fn in_row(row: &Self, column: &Self, length: &Self) -> Self {
        match (row.as_literal(), column.as_literal(), length.as_literal()) {
            (Some(row), Some(column), Some(length)) => {
                Self::literal(whole(row.checked_mul(length))).plus(&Self::literal(column), 1)
            }
            (Some(0), ..) => column.clone(),
            _ => Self::atom(Atom::Row(Box::new(row.clone()), Box::new(length.clone()))).plus(column, 1),
        }
    }

    /// The two indices of such a place.
    pub(crate) fn row_and_column(&self, length: &Self) -> [Self; 2] {
        if let (Some(place), Some(length)) = (self.as_literal(), length.as_literal()) {
            return [place.div_euclid(length), place.rem_euclid(length)].map(Self::literal);
        }
        let row = self.terms.iter().find_map(|(atom, _)| match atom {
            Atom::Row(row, _) => Some((atom.clone(), (**row).clone())),
            Atom::Open(_) | Atom::Bound(_) | Atom::Size(_) | Atom::Remainder(..) | Atom::Product(_) => None,
        });
        let (row, column) = match row {
            Some((atom, row)) => (row, self.plus(&Self::atom(atom), -1)),
            None => (Self::default(), self.clone()),
        };
        // Where there is no pass of a loop, neither index is read.
        let ties = self.terms.iter().filter(|(atom, _)| atom.is_tie()).cloned().collect();
        [row.plus(&Self { constant: 0, terms: ties }, 1), column]
    }

    pub(crate) fn free(&self) -> Free {
        let of = |atom: &Atom| match atom {
            Atom::Open(depth) => Free { open: 1 << depth, bound: 0 },
            Atom::Bound(height) => Free { open: 0, bound: 1 << height },
            Atom::Size(_) => Free::default(),
            Atom::Remainder(value, other) | Atom::Row(value, other) => value.free().and(other.free()),
            Atom::Product(factors) => factors
                .iter()
                .fold(Free::default(), |free, factor| free.and(Self::atom(factor.clone()).free())),
        };
        self.terms.iter().fold(Free::default(), |free, (atom, _)| free.and(of(atom)))
    }

    pub(crate) fn renamed(&self, renaming: &Renaming) -> Self {
        let terms = self.terms.iter().map(|(atom, coefficient)| (atom.renamed(renaming), *coefficient));
        terms.fold(Self::literal(self.constant), |sum, (atom, coefficient)| {
            sum.plus(&Self::atom(atom), coefficient)
        })
    }

    /// The value where those of loops, sums and sizes are, as far as these are known.
    pub(crate) fn value(&self, known: &impl Fn(&Atom) -> Option<i64>) -> Option<i64> {
        self.terms.iter().try_fold(self.constant, |sum, (atom, coefficient)| {
            sum.checked_add(atom.value(known)?.checked_mul(*coefficient)?)
        })
    }

    /// The value where those of the loops at these depths are known; none if a size or a sum has a say.
    pub(crate) fn value_in(&self, open: &[(u32, i64)]) -> Option<i64> {
        self.value(&|atom| match atom {
            Atom::Open(depth) => open.iter().find(|(known, _)| known == depth).map(|(_, value)| *value),
            _ => None,
        })
    }

    /// The terms that have a value: not those that are there to depend on a loop.
    pub(crate) fn counted_terms(&self) -> impl Iterator<Item = &(Atom, i64)> {
        self.terms.iter().filter(|(atom, _)| !atom.is_tie())
    }

    /// Whether this index goes on by one with that of the loop at `depth`.
    pub(crate) fn follows(&self, depth: u32) -> bool {
        let mut with_it =
            self.terms.iter().filter(|(atom, _)| Self::atom(atom.clone()).free().open & (1 << depth) != 0);
        matches!((with_it.next(), with_it.next()), (Some((Atom::Open(_), 1)), None))
    }

    /// The place on a ring, if this index is (j + c) % n with that of a loop, j.
    pub(crate) fn on_ring(&self) -> Option<OnRing<'_>> {
        let (0, [(Atom::Remainder(value, length), 1)]) = (self.constant, self.terms.as_slice()) else {
            return None;
        };
        let mut opens = value.terms.iter().filter(|(atom, _)| matches!(atom, Atom::Open(_)));
        let (Some((open, 1)), None) = (opens.next(), opens.next()) else { return None };
        let beside = value.plus(&Self::atom(open.clone()), -1);
        // Which are several where the length is a number: the shorter way.
        let shifts = [0, 1, -1].into_iter().filter_map(|turns| beside.plus(length, -turns).as_literal());
        let shift = shifts.min_by_key(|shift| shift.unsigned_abs())?;
        Some(OnRing { unturned: Self::atom(open.clone()).plus(&Self::literal(shift), 1), shift, length })
    }

    /// The index without the turns around a ring: j + c for (j + c) % n.
    pub(crate) fn unturned(&self) -> Self {
        self.on_ring().map_or_else(|| self.clone(), |ring| ring.unturned)
    }

    /// Whether no value of this index is negative, because nothing is subtracted in it.
    pub(crate) fn is_natural(&self) -> bool {
        self.constant >= 0 && self.terms.iter().all(|(_, coefficient)| *coefficient > 0)
    }
}

impl Atom {
    fn product(mut factors: Vec<Self>) -> Self {
        factors.sort();
        Self::Product(factors)
    }

    fn factors(&self) -> &[Self] {
        match self {
            Self::Product(factors) => factors,
            Self::Open(_) | Self::Bound(_) | Self::Size(_) | Self::Remainder(..) | Self::Row(..) => {
                std::slice::from_ref(self)
            }
        }
    }

    fn value(&self, known: &impl Fn(&Self) -> Option<i64>) -> Option<i64> {
        match self {
            Self::Open(_) | Self::Bound(_) | Self::Size(_) => known(self),
            Self::Remainder(of, modulus) => of.value(known)?.checked_rem_euclid(modulus.value(known)?),
            Self::Row(row, length) => row.value(known)?.checked_mul(length.value(known)?),
            Self::Product(factors) => {
                factors.iter().try_fold(1_i64, |product, factor| product.checked_mul(factor.value(known)?))
            }
        }
    }

    fn renamed(&self, renaming: &Renaming) -> Self {
        match self {
            known if *known == renaming.from => renaming.to.clone(),
            Self::Remainder(value, modulus) => {
                Self::Remainder(Box::new(value.renamed(renaming)), Box::new(modulus.renamed(renaming)))
            }
            Self::Row(row, length) => {
                Self::Row(Box::new(row.renamed(renaming)), Box::new(length.renamed(renaming)))
            }
            Self::Product(factors) => {
                Self::product(factors.iter().map(|factor| factor.renamed(renaming)).collect())
            }
            Self::Open(_) | Self::Bound(_) | Self::Size(_) => self.clone(),
        }
    }

    /// Whether it is zero, and there to depend on a loop.
    fn is_tie(&self) -> bool {
        matches!(self, Self::Remainder(_, modulus) if modulus.as_literal() == Some(1))
    }

    /// Whether it is a size, or a product of sizes.
    fn is_size(&self) -> bool {
        self.factors().iter().all(|factor| matches!(factor, Self::Size(_)))
    }
}

impl Range {
    /// `0..upper`
    pub(crate) fn up_to(upper: Index) -> Self {
        Self { lower: Index::literal(0), upper, except: None, taken: Vec::new() }
    }

    /// The indices that the bounds depend on.
    pub(crate) fn free(&self) -> Free {
        let bounds = self.lower.free().and(self.upper.free());
        self.left_out().fold(bounds, |free, index| free.and(index.free()))
    }

    pub(crate) fn renamed(&self, renaming: &Renaming) -> Self {
        Self {
            lower: self.lower.renamed(renaming),
            upper: self.upper.renamed(renaming),
            except: self.except.as_ref().map(|except| except.renamed(renaming)),
            taken: self.taken.iter().map(|index| index.renamed(renaming)).collect(),
        }
    }

    pub(crate) fn left_out(&self) -> impl Iterator<Item = &Index> {
        self.except.iter().chain(&self.taken)
    }

    /// The range that the formula names.
    pub(crate) fn as_written(&self) -> Self {
        Self { taken: Vec::new(), ..self.clone() }
    }

    /// The same values without that of a factor that a derivative takes out.
    pub(crate) fn without(&self, index: Index) -> Self {
        let mut rest = self.clone();
        rest.taken.push(index);
        rest
    }

    /// Whether the range is known to be empty.
    pub(crate) fn is_empty(&self) -> bool {
        self.upper.plus(&self.lower, -1).as_literal().is_some_and(|length| length <= 0)
    }

    /// Whether the range is known to have a value, no size being zero.
    pub(crate) fn is_filled(&self) -> bool {
        let length = self.upper.plus(&self.lower, -1);
        let least = length.terms.iter().try_fold(length.constant, |sum, (atom, coefficient)| match atom {
            size if size.is_size() && *coefficient > 0 => sum.checked_add(*coefficient),
            Atom::Size(_)
            | Atom::Open(_)
            | Atom::Bound(_)
            | Atom::Remainder(..)
            | Atom::Product(_)
            | Atom::Row(..) => None,
        });
        self.left_out().next().is_none() && least.is_some_and(|least| least > 0)
    }
}
