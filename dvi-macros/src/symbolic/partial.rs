//! Which derivative of a function of several variables.

use crate::internal::internal;

/// A function of several variables, or one of its partial derivatives; axes are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Partial {
    Value,
    First(usize),
    /// The smaller axis first: the order of differentiation does not matter.
    Second(usize, usize),
}

impl Partial {
    /// Its derivative along `axis`. There are no third derivatives: gauges, which need them, do not contain
    /// such functions.
    pub(super) fn along(self, axis: usize) -> Self {
        match self {
            Self::Value => Self::First(axis),
            Self::First(first) => Self::Second(first.min(axis), first.max(axis)),
            Self::Second(..) => internal("a third derivative of a function of several variables"),
        }
    }

    /// The axes along which the function is differentiated.
    pub(crate) fn axes(self) -> Vec<usize> {
        match self {
            Self::Value => Vec::new(),
            Self::First(axis) => vec![axis],
            Self::Second(first, second) => vec![first, second],
        }
    }
}
