//! A statement is a loop nest, a place and a value: what generated functions are made of.

use crate::symbolic::{Coordinate, Count, Expr, Loop};

/// An array that a generated function writes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Output {
    /// ∂L/∂q + F
    Lq,
    /// ∂L/∂v
    Lv,
    /// The only vector of a function that sets one.
    Vector,
}

#[derive(Clone, Debug)]
pub(crate) enum Place {
    /// The value that the function returns.
    Result,
    Entry(Output, Coordinate),
    MatrixEntry(Coordinate, Coordinate),
    /// An entry of g or a.
    Constraint(Row),
    /// An entry of a derivative of g or a.
    ConstraintDerivative(Row, Coordinate),
}

#[derive(Clone, Debug)]
pub(crate) struct Statement {
    pub(crate) loops: Vec<Loop>,
    pub(crate) place: Place,
    pub(crate) value: Expr,
}

/// An entry of g or a: the number of a declared constraint, and that of a member of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) constraint: u32,
    pub(crate) member: Count,
}

impl Place {
    /// The array and the coordinate, if it is an entry of an array.
    pub(crate) fn entry(&self) -> Option<(Output, &Coordinate)> {
        match self {
            Self::Entry(output, coordinate) => Some((*output, coordinate)),
            Self::Result | Self::MatrixEntry(..) | Self::Constraint(_) | Self::ConstraintDerivative(..) => {
                None
            }
        }
    }
}
