//! Vectors of the text: lists of numbers, on which each operation is that on the numbers.

use syn::{Expr, ExprMethodCall};

use super::super::functions;
use super::super::jet::Jet;
use super::{Evaluation, Value, unknown};

/// What an expression of the text is at a point.
#[derive(Clone, Debug)]
pub(in super::super) enum Quantity {
    Number(Jet),
    Vector(Vec<Jet>),
    /// Zero: a sum without terms, of which no term says whether it is of numbers or of vectors.
    Empty(Jet),
}

impl Quantity {
    /// The number that it is; all components of a sum of vectors without terms are the same.
    fn as_number(&self) -> Option<&Jet> {
        match self {
            Self::Number(jet) | Self::Empty(jet) => Some(jet),
            Self::Vector(_) => None,
        }
    }

    pub(super) fn number(self, of: &Expr) -> Jet {
        match self {
            Self::Number(jet) | Self::Empty(jet) => jet,
            Self::Vector(_) => unknown(of),
        }
    }

    fn components(&self, count: usize) -> Vec<Jet> {
        match self {
            Self::Vector(components) => components.clone(),
            Self::Number(jet) | Self::Empty(jet) => vec![jet.clone(); count],
        }
    }

    pub(super) fn is_huge(&self) -> bool {
        match self {
            Self::Number(jet) | Self::Empty(jet) => jet.is_huge(),
            Self::Vector(components) => components.iter().any(Jet::is_huge),
        }
    }

    pub(super) fn map(self, f: impl Fn(&Jet) -> Jet) -> Self {
        match self {
            Self::Number(jet) => Self::Number(f(&jet)),
            Self::Vector(components) => Self::Vector(components.iter().map(f).collect()),
            Self::Empty(jet) => Self::Empty(f(&jet)),
        }
    }

    /// `f` of both, entry by entry.
    pub(super) fn with(self, other: &Self, f: impl Fn(&Jet, &Jet) -> Jet) -> Self {
        match (&self, other) {
            (Self::Vector(a), b) => {
                let b = b.components(a.len());
                Self::Vector(a.iter().zip(&b).map(|(a, b)| f(a, b)).collect())
            }
            (Self::Number(a) | Self::Empty(a), Self::Vector(b)) => {
                Self::Vector(b.iter().map(|b| f(a, b)).collect())
            }
            (Self::Empty(a), Self::Empty(b)) => Self::Empty(f(a, b)),
            (Self::Number(a) | Self::Empty(a), Self::Number(b) | Self::Empty(b)) => Self::Number(f(a, b)),
        }
    }

    pub(super) fn component(&self, index: i64) -> Option<Jet> {
        match self {
            Self::Vector(components) => components.get(usize::try_from(index).ok()?).cloned(),
            Self::Empty(jet) => Some(jet.clone()),
            Self::Number(_) => None,
        }
    }
}

/// The sum of the products of the entries.
fn product(a: &[Jet], b: &[Jet]) -> Jet {
    a.iter().zip(b).fold(Jet::number(0.0), |sum, (a, b)| sum.plus(&a.times(b)))
}

impl Evaluation<'_> {
    /// `v.norm()` and its like; `None` of what is no vector.
    pub(super) fn vector_method(
        &mut self,
        name: &str,
        call: &ExprMethodCall,
        receiver: &Quantity,
    ) -> Value<Option<Quantity>> {
        if !["norm", "norm_squared", "dot", "cross"].contains(&name) {
            return Ok(None);
        }
        let other = match call.args.first() {
            Some(argument) => self.quantity(argument)?,
            None => receiver.clone(),
        };
        let count = match (receiver, &other) {
            (Quantity::Vector(a), _) => a.len(),
            (_, Quantity::Vector(b)) => b.len(),
            _ => 3,
        };
        let [a, b] = [receiver, &other].map(|side| side.components(count));
        Ok(Some(match (name, a.as_slice(), b.as_slice()) {
            ("dot" | "norm_squared", ..) => Quantity::Number(product(&a, &b)),
            ("norm", ..) => {
                let root = functions::unary("sqrt", &product(&a, &b));
                Quantity::Number(root.unwrap_or_else(|| unknown(call)))
            }
            (_, [a0, a1, a2], [b0, b1, b2]) => {
                let minor = |a: &Jet, b: &Jet, c: &Jet, d: &Jet| a.times(d).minus(b.times(c));
                Quantity::Vector(vec![minor(a1, a2, b1, b2), minor(a2, a0, b2, b0), minor(a0, a1, b0, b1)])
            }
            _ => unknown(call),
        }))
    }

    /// The quotient or the product of two expressions, of which one may be a vector.
    pub(super) fn scaled(&self, left: Quantity, right: &Quantity, is_quotient: bool) -> Quantity {
        match (is_quotient, right.as_number()) {
            (true, Some(number)) => left.with(&Quantity::Number(number.reciprocal()), Jet::times),
            _ => left.with(right, Jet::times),
        }
    }
}
