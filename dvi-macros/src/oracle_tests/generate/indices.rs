//! Indices and ranges that are known to be in range.

use std::ops::Range;

use super::Generator;
use crate::oracle_tests::formula::{Atom, Formula, Index, Loops};
use crate::oracle_tests::random::Random;
use crate::oracle_tests::system::{SizeKind, System};
use crate::syntax::Factor;

/// What is bound around a formula.
#[derive(Clone, Debug)]
pub(super) struct Scope {
    /// All values that the bound indices take together.
    values: Vec<Vec<i64>>,
    /// The number of bound indices.
    pub(super) level: usize,
    /// Whether each name of a `let` is that of a vector.
    pub(super) names: Vec<bool>,
}

/// No sum in sums runs over more terms.
const MOST_TERMS: usize = 160;
const DEEPEST: usize = 5;

impl Scope {
    pub(super) fn outside() -> Self {
        Self { values: vec![Vec::new()], level: 0, names: Vec::new() }
    }

    pub(super) fn over(&self, range: Range<i64>) -> Self {
        let extended = |outer: &Vec<i64>| {
            let outer = outer.clone();
            range.clone().map(move |index| outer.iter().copied().chain([index]).collect::<Vec<i64>>())
        };
        Self {
            values: self.values.iter().flat_map(extended).collect(),
            level: self.level + 1,
            names: self.names.clone(),
        }
    }

    /// With a name for this value.
    pub(super) fn with_name(&self, value: &Formula) -> Self {
        let mut scope = self.clone();
        scope.names.push(value.is_vector());
        scope
    }

    /// A name for a vector, or for a number.
    pub(super) fn name(&self, random: &mut Random, is_vector: bool) -> Option<usize> {
        let names = self.names.iter().enumerate().filter(|(_, known)| **known == is_vector);
        let names: Vec<usize> = names.map(|(name, _)| name).collect();
        (!names.is_empty()).then(|| *random.pick(&names))
    }

    /// The scope of the body of a sum, or `None` if it has no terms or too many.
    fn inside(&self, loops: Loops, lower: &Index, upper: &Index, sizes: &[i64]) -> Option<Self> {
        let mut values = Vec::new();
        for outer in &self.values {
            let (lower, upper) = (lower.value(sizes, outer)?, upper.value(sizes, outer)?);
            for first in lower..upper {
                let with = |more: &[i64]| outer.iter().chain(more).copied().collect::<Vec<i64>>();
                match loops {
                    Loops::Single | Loops::Product => values.push(with(&[first])),
                    Loops::Pairs => values.extend((first + 1..upper).map(|second| with(&[first, second]))),
                    Loops::OrderedPairs => {
                        let others = (lower..upper).filter(|second| *second != first);
                        values.extend(others.map(|second| with(&[first, second])));
                    }
                }
            }
        }
        let level = self.level + loops.indices();
        let fits = !values.is_empty() && values.len() <= MOST_TERMS && level <= DEEPEST;
        fits.then_some(Self { values, level, names: self.names.clone() })
    }

    /// Whether a formula that was written elsewhere has a meaning here: its names are known and all of its
    /// indices are in range.
    pub(super) fn admits_formula(&self, formula: &Formula, system: &System) -> bool {
        let sizes = system.size_values();
        let admits = |index: &Index, size: usize| self.admits(index, sizes[size], &sizes);
        let here = match formula {
            Formula::Coordinate(block, index)
            | Formula::Velocity(block, index)
            | Formula::Vector(block, index)
            | Formula::VectorVelocity(block, index)
            | Formula::Column(block, index, _) => system.blocks[*block]
                .size
                .zip(index.as_ref())
                .is_none_or(|(size, index)| admits(index, size)),
            Formula::Parameter(field, indices) | Formula::VectorParameter(field, indices) => {
                indices.iter().zip(&system.fields[*field].shape).all(|(index, size)| admits(index, *size))
            }
            Formula::Count(index) => self.admits(index, i64::MAX, &sizes),
            Formula::Name(name) => self.names.get(*name) == Some(&false),
            Formula::VectorName(name) => self.names.get(*name) == Some(&true),
            Formula::Let(name, value, body) => {
                return *name == self.names.len()
                    && self.admits_formula(value, system)
                    && self.with_name(value).admits_formula(body, system);
            }
            Formula::Sum(loops, level, lower, upper, body) => {
                let inside = || self.inside(*loops, lower, upper, &sizes);
                return *level == self.level
                    && inside().is_some_and(|inside| inside.admits_formula(body, system));
            }
            _ => true,
        };
        here && formula.parts().iter().all(|part| self.admits_formula(part, system))
    }

    /// Whether an index stays in 0..length.
    fn admits(&self, index: &Index, length: i64, sizes: &[i64]) -> bool {
        self.values
            .iter()
            .all(|bound| index.value(sizes, bound).is_some_and(|value| (0..length).contains(&value)))
    }
}

impl Generator<'_> {
    /// Loops with their bounds and the scope inside.
    pub(super) fn loops(&mut self, scope: &Scope, loops: Loops) -> Option<(Index, Index, Scope)> {
        let sizes = self.system.size_values();
        for _ in 0..8 {
            let (lower, upper) = self.range(scope);
            if let Some(inside) = scope.inside(loops, &lower, &upper, &sizes) {
                return Some((lower, upper, inside));
            }
        }
        None
    }

    /// A sum of what `body` makes inside of it, if there is a range for it.
    pub(super) fn summed(
        &mut self,
        scope: &Scope,
        loops: Loops,
        body: impl FnOnce(&mut Self, &Scope) -> Formula,
    ) -> Option<Formula> {
        let (lower, upper, inside) = self.loops(scope, loops)?;
        Some(Formula::Sum(loops, scope.level, lower, upper, Box::new(body(self, &inside))))
    }

    /// Over entries beside one another, or over pairs of them, and arithmetic alone: what loops over packs
    /// take, and threads share.
    pub(super) fn sum_in_packs(&mut self, scope: &Scope) -> Option<Formula> {
        let blocks = self.system.blocks.iter().enumerate();
        let arrays: Vec<(usize, usize)> = blocks
            .filter(|(_, block)| block.factor == Factor::Line)
            .filter_map(|(number, block)| Some((number, block.size?)))
            .collect();
        let (block, size) = *arrays.get(self.random.below(arrays.len().max(1)))?;
        let (lower, upper, first) =
            (Index::literal(0), Index::atom(Atom::Size(size)), Index::bound(scope.level));
        let (loops, upper, second) = match self.random.chance(50) {
            true => (Loops::Pairs, upper, Index::bound(scope.level + 1)),
            false => (Loops::Single, upper.plus(-1), first.clone().plus(1)),
        };
        let inside = scope.inside(loops, &lower, &upper, &self.system.size_values())?;
        let [one, other] = [first, second].map(|index| Formula::Coordinate(block, Some(index)));
        let term = match self.random.below(3) {
            0 => one.times(other),
            1 => one.power(2).times(other),
            _ => one.minus(other).power(2),
        };
        let term = if self.random.chance(40) { self.parameter(&inside).times(term) } else { term };
        Some(Formula::Sum(loops, scope.level, lower, upper, Box::new(term)))
    }

    /// A value with a name in what `body` makes.
    pub(super) fn named(
        &mut self,
        scope: &Scope,
        value: Formula,
        body: impl FnOnce(&mut Self, &Scope) -> Formula,
    ) -> Formula {
        let body = body(self, &scope.with_name(&value));
        Formula::Let(scope.names.len(), Box::new(value), Box::new(body))
    }

    fn range(&mut self, scope: &Scope) -> (Index, Index) {
        let size = Index::atom(Atom::Size(self.random.below(self.system.sizes.len())));
        let whole = (Index::literal(0), size.clone());
        if scope.level == 0 || self.random.chance(45) {
            return match self.random.below(10) {
                0 => match self.random.below(3) {
                    0 => (Index::literal(-1), Index::literal(2)),
                    1 => (Index::literal(-2), Index::literal(1)),
                    _ => (Index::literal(-1), size.plus(-1)),
                },
                1 => (Index::literal(0), Index::literal(2)),
                2 => (Index::literal(1), size),
                _ => whole,
            };
        }
        let outer = Atom::Bound(self.random.below(scope.level));
        let j = Index::atom(outer.clone());
        match self.random.below(8) {
            0 => (j, size),
            1 => (j.plus(1), size),
            2 => (Index::literal(0), j),
            3 => (Index::literal(0), j.plus(1)),
            4 => (Index::literal(0), size.with(outer, -1)),
            5 => (j.clone().plus(-1), j.plus(2)),
            6 => (j.clone(), j.plus(2)),
            _ => (Index::literal(0), j.plus(2)),
        }
    }

    /// An index into an array of a size of the table.
    pub(super) fn index(&mut self, scope: &Scope, size: usize) -> Index {
        let sizes = self.system.size_values();
        for _ in 0..8 {
            let index = self.any_index(scope, size);
            if scope.admits(&index, sizes[size], &sizes) {
                return index;
            }
        }
        Index::literal(0)
    }

    /// An index of a number in a block; that of an entry of a rotation is a literal.
    pub(super) fn index_of(&mut self, scope: &Scope, block: usize, entries: usize) -> Option<Index> {
        if self.system.is_rotation(block) && self.system.is_single_factor(block) {
            return Some(Index::literal(self.random.below(entries) as i64));
        }
        self.system.blocks[block].size.map(|size| self.index(scope, size))
    }

    fn any_index(&mut self, scope: &Scope, size: usize) -> Index {
        let length = Index::atom(Atom::Size(size));
        if let (SizeKind::Product(_, columns), 1..) = (&self.system.sizes[size].kind, scope.level) {
            let [row, column] = [0; 2].map(|_| self.random.below(scope.level));
            let place = Index::bound(column).with(Atom::Times(*columns, row), 1);
            match self.random.below(4) {
                0 | 1 => return place,
                2 => return place.plus(1).modulo(length),
                _ => {}
            }
        }
        let entry = Index::literal(self.random.below(self.system.sizes[size].value as usize) as i64);
        if scope.level == 0 {
            return if self.random.chance(15) { length.plus(-1) } else { entry };
        }
        let bound = |random: &mut Random| Atom::Bound(random.below(scope.level));
        let (i, j) = (bound(self.random), bound(self.random));
        let j_alone = Index::atom(j.clone());
        let shift = self.random.below(5) as i64 - 2;
        match self.random.below(16) {
            0..=5 => j_alone,
            6..=7 => j_alone.plus(shift),
            8..=9 => j_alone.plus(shift).modulo(length),
            10 => Index { constant: 1, terms: vec![(j, 2)] }.modulo(length),
            11 if i != j => j_alone.with(i, 1).modulo(length),
            12 if i != j => j_alone.with(i, -1).plus(shift),
            13 if i != j => j_alone.with(i, 1),
            14 => length.with(j, -1).plus(-1),
            _ => entry,
        }
    }

    /// An index as a number: small, and never negative in all of its terms.
    pub(super) fn count(&mut self, scope: &Scope) -> Index {
        let size = Index::atom(Atom::Size(self.random.below(self.system.sizes.len())));
        if scope.level == 0 || self.random.chance(20) {
            return size;
        }
        let j = Index::bound(self.random.below(scope.level));
        match self.random.below(4) {
            0 => j.plus(1),
            1 => size.with(Atom::Bound(self.random.below(scope.level)), -1),
            _ => j,
        }
    }
}
