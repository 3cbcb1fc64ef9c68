//! Formulas as a tree of their own: what the attribute's text is printed from and what the oracle
//! evaluates.
//!
//! An index that a sum binds is named by the number of indices that are bound around it, so that sums
//! side by side use the same letters; a `let` is named by the number of names around it.
//!
//! Some formulas are vectors. Sums, differences, choices, `let`s and sums over indices are what their parts
//! are; a product with a number is a vector if the other factor is.

use super::functions::{BinaryFunction, UnaryFunction};

/// A size: an entry of the system's table.
pub(super) type SizeId = usize;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Atom {
    /// The index of the sum at this level.
    Bound(usize),
    Size(SizeId),
    Remainder(Box<Index>, Box<Index>),
    /// A size times the index of the sum at this level.
    Times(SizeId, usize),
}

/// constant + Σ coefficient·atom
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Index {
    pub(super) constant: i64,
    pub(super) terms: Vec<(Atom, i64)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Relation {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Condition {
    Compare(Formula, Relation, Formula),
    And(Box<Condition>, Box<Condition>),
    Or(Box<Condition>, Box<Condition>),
    Not(Box<Condition>),
}

/// `sum`, `product`, `sum_pairs` over j < k, `sum_ordered_pairs` over j ≠ k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Loops {
    Single,
    Product,
    Pairs,
    OrderedPairs,
}

impl Loops {
    /// How many indices they bind.
    pub(super) fn indices(self) -> usize {
        match self {
            Self::Single | Self::Product => 1,
            Self::Pairs | Self::OrderedPairs => 2,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Formula {
    /// A literal as it is written.
    Number(&'static str),
    Pi,
    Time,
    /// A block of coordinates, with an index if it is an array.
    Coordinate(usize, Option<Index>),
    Velocity(usize, Option<Index>),
    /// All of a vector: an array of a few coordinates, or an entry of an array of vectors, of which this is
    /// the first block.
    Vector(usize, Option<Index>),
    VectorVelocity(usize, Option<Index>),
    /// A column of a rotation.
    Column(usize, Option<Index>, usize),
    /// A field of the struct and its indices.
    Parameter(usize, Vec<Index>),
    /// The same with an index less: its last ones are those of components.
    VectorParameter(usize, Vec<Index>),
    /// `index as f64`
    Count(Index),
    /// The value of a `let`.
    Name(usize),
    /// The same, of a vector.
    VectorName(usize),
    List(Vec<Formula>),
    Cross(Box<Formula>, Box<Formula>),
    Dot(Box<Formula>, Box<Formula>),
    Norm(Box<Formula>),
    NormSquared(Box<Formula>),
    Component(Box<Formula>, usize),
    Negative(Box<Formula>),
    Add(Box<Formula>, Box<Formula>),
    Subtract(Box<Formula>, Box<Formula>),
    Multiply(Box<Formula>, Box<Formula>),
    Divide(Box<Formula>, Box<Formula>),
    Power(Box<Formula>, i32),
    Unary(UnaryFunction, Box<Formula>),
    Binary(BinaryFunction, Box<Formula>, Box<Formula>),
    MultiplyAdd(Box<Formula>, Box<Formula>, Box<Formula>),
    /// A function of the user's.
    Own(usize, Box<Formula>),
    /// A function of several variables.
    ScalarField(usize, Vec<Formula>),
    If(Box<Condition>, Box<Formula>, Box<Formula>),
    /// `{ let name = …; … }`
    Let(usize, Box<Formula>, Box<Formula>),
    /// Over `lower..upper`, with the level of its first index.
    Sum(Loops, usize, Index, Index, Box<Formula>),
}

impl Index {
    pub(super) fn literal(constant: i64) -> Self {
        Self { constant, terms: Vec::new() }
    }

    pub(super) fn atom(atom: Atom) -> Self {
        Self { constant: 0, terms: vec![(atom, 1)] }
    }

    pub(super) fn bound(level: usize) -> Self {
        Self::atom(Atom::Bound(level))
    }

    pub(super) fn plus(mut self, constant: i64) -> Self {
        self.constant += constant;
        self
    }

    pub(super) fn with(mut self, atom: Atom, coefficient: i64) -> Self {
        self.terms.push((atom, coefficient));
        self
    }

    pub(super) fn modulo(self, modulus: Self) -> Self {
        Self::atom(Atom::Remainder(Box::new(self), Box::new(modulus)))
    }

    /// Its value where the bound indices have these values, or `None` for one that no sum binds.
    pub(super) fn value(&self, sizes: &[i64], bound: &[i64]) -> Option<i64> {
        self.terms.iter().try_fold(self.constant, |sum, (atom, coefficient)| {
            let value = match atom {
                Atom::Bound(level) => *bound.get(*level)?,
                Atom::Size(size) => sizes[*size],
                Atom::Times(size, level) => sizes[*size] * *bound.get(*level)?,
                Atom::Remainder(value, modulus) => {
                    value.value(sizes, bound)?.checked_rem_euclid(modulus.value(sizes, bound)?)?
                }
            };
            Some(sum + coefficient * value)
        })
    }
}

/// Formulas from formulas, for those that write them in Rust.
impl Formula {
    pub(super) fn plus(self, other: Self) -> Self {
        Self::Add(Box::new(self), Box::new(other))
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self::Subtract(Box::new(self), Box::new(other))
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self::Multiply(Box::new(self), Box::new(other))
    }

    pub(super) fn over(self, other: Self) -> Self {
        Self::Divide(Box::new(self), Box::new(other))
    }

    pub(super) fn dot(self, other: Self) -> Self {
        Self::Dot(Box::new(self), Box::new(other))
    }

    pub(super) fn power(self, exponent: i32) -> Self {
        Self::Power(Box::new(self), exponent)
    }
}
