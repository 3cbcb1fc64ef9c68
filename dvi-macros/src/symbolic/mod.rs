//! The symbolic core: an expression graph, its simplifier and its derivatives.
//!
//! Pure: no tokens, no spans, no errors. Formulas enter through the constructors of [`Graph`] and
//! leave as statements of a [`program`](crate::program); everything in between is arithmetic on ids.

mod antiderivative;
mod asked;
mod bind;
mod count;
mod derivative;
mod differential;
mod domain;
mod energy;
mod factored;
mod functions;
mod graph;
mod index;
mod limits;
mod partial;
mod polynomial;
mod powers;
mod rebuild;
mod rules;
mod simplify;
#[cfg(test)]
mod tests;
mod variables;

pub(crate) use antiderivative::Terms;
pub(crate) use count::{Count, Rows};
pub(crate) use derivative::{Contribution, SecondContribution};
pub(crate) use functions::{Unary, unary_by_name, unary_names};
pub(crate) use graph::{
    Binary, Coordinate, Expr, Fold, Graph, Id, Node, Parameter, Relation, Variable, Weight, leaf,
};
pub(crate) use index::{Atom, Free, Index, Loop, Range, Renaming, Size};
pub(crate) use partial::Partial;
pub(crate) use rules::{binary_by_name, binary_names};
