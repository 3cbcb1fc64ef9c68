//! The parts of a formula: what walks and rebuilds the tree.

use super::formula::{Atom, Condition, Formula, Index};

impl Formula {
    /// The formulas directly inside, those of conditions included.
    pub(super) fn parts(&self) -> Vec<Self> {
        let mut copy = self.clone();
        copy.parts_mut().into_iter().map(|part| std::mem::replace(part, Self::Pi)).collect()
    }

    /// The same, to be changed.
    pub(super) fn parts_mut(&mut self) -> Vec<&mut Formula> {
        match self {
            Self::Number(_)
            | Self::Pi
            | Self::Time
            | Self::Coordinate(..)
            | Self::Velocity(..)
            | Self::Vector(..)
            | Self::VectorVelocity(..)
            | Self::Column(..)
            | Self::Parameter(..)
            | Self::VectorParameter(..)
            | Self::Count(_)
            | Self::Name(_)
            | Self::VectorName(_) => Vec::new(),
            Self::Negative(a)
            | Self::Norm(a)
            | Self::NormSquared(a)
            | Self::Component(a, _)
            | Self::Power(a, _)
            | Self::Unary(_, a)
            | Self::Own(_, a)
            | Self::Sum(.., a) => vec![a],
            Self::Add(a, b)
            | Self::Subtract(a, b)
            | Self::Multiply(a, b)
            | Self::Divide(a, b)
            | Self::Cross(a, b)
            | Self::Dot(a, b)
            | Self::Binary(_, a, b)
            | Self::Let(_, a, b) => vec![a, b],
            Self::MultiplyAdd(a, b, c) => vec![a, b, c],
            Self::ScalarField(_, at) | Self::List(at) => at.iter_mut().collect(),
            Self::If(condition, a, b) => {
                condition.parts_mut().into_iter().chain([&mut **a, &mut **b]).collect()
            }
        }
    }

    /// The indices of the node itself.
    pub(super) fn indices(&self) -> Vec<Index> {
        self.clone().indices_mut().into_iter().map(|index| index.clone()).collect()
    }

    fn indices_mut(&mut self) -> Vec<&mut Index> {
        match self {
            Self::Coordinate(_, Some(index))
            | Self::Velocity(_, Some(index))
            | Self::Vector(_, Some(index))
            | Self::VectorVelocity(_, Some(index))
            | Self::Column(_, Some(index), _)
            | Self::Count(index) => {
                vec![index]
            }
            Self::Parameter(_, indices) | Self::VectorParameter(_, indices) => indices.iter_mut().collect(),
            Self::Sum(_, _, lower, upper, _) => vec![lower, upper],
            _ => Vec::new(),
        }
    }

    /// Whether it, or a formula inside, is such a one.
    pub(super) fn has(&self, is_one: &dyn Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().iter().any(|part| part.has(is_one))
    }

    pub(super) fn has_velocities(&self) -> bool {
        self.has(&|part| matches!(part, Self::Velocity(..) | Self::VectorVelocity(..)))
    }

    /// Whether it is a vector.
    pub(super) fn is_vector(&self) -> bool {
        match self {
            Self::Vector(..)
            | Self::VectorVelocity(..)
            | Self::Column(..)
            | Self::VectorParameter(..)
            | Self::VectorName(_)
            | Self::List(_)
            | Self::Cross(..) => true,
            Self::Multiply(a, b) => a.is_vector() || b.is_vector(),
            Self::Negative(a) | Self::Add(a, _) | Self::Subtract(a, _) | Self::Divide(a, _) => a.is_vector(),
            Self::If(_, value, _) | Self::Let(_, _, value) | Self::Sum(.., value) => value.is_vector(),
            _ => false,
        }
    }

    /// The number of nodes; a leaf that is no number counts twice.
    pub(super) fn weight(&self) -> usize {
        let own = match self {
            Self::Number(_) => 1,
            _ => 2,
        };
        own + self.parts().iter().map(Self::weight).sum::<usize>()
    }

    /// The body of a sum as it is where the index of this level is zero.
    pub(super) fn without_level(mut self, level: usize) -> Self {
        if let Self::Sum(_, own, ..) = &mut self
            && *own > level
        {
            *own -= 1;
        }
        self.indices_mut().into_iter().for_each(|index| *index = index.without_level(level));
        self.parts_mut().into_iter().for_each(|part| {
            let inner = std::mem::replace(part, Self::Pi);
            *part = inner.without_level(level);
        });
        self
    }
}

impl Condition {
    fn parts_mut(&mut self) -> Vec<&mut Formula> {
        match self {
            Self::Compare(left, _, right) => vec![left, right],
            Self::And(a, b) | Self::Or(a, b) => a.parts_mut().into_iter().chain(b.parts_mut()).collect(),
            Self::Not(of) => of.parts_mut(),
        }
    }
}

impl Index {
    fn without_level(&self, level: usize) -> Self {
        let is_it = |atom: &Atom| matches!(atom, Atom::Bound(of) | Atom::Times(_, of) if *of == level);
        let terms = self.terms.iter().filter(|(atom, _)| !is_it(atom));
        let atom = |atom: &Atom| match atom {
            Atom::Bound(other) if *other > level => Atom::Bound(other - 1),
            Atom::Times(size, other) if *other > level => Atom::Times(*size, other - 1),
            Atom::Remainder(value, modulus) => {
                Atom::Remainder(Box::new(value.without_level(level)), Box::new(modulus.without_level(level)))
            }
            other => other.clone(),
        };
        Self {
            constant: self.constant,
            terms: terms.map(|(known, coefficient)| (atom(known), *coefficient)).collect(),
        }
    }
}
