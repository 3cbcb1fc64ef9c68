//! What decides which equations of motion a system has.

use core::fmt::Debug;

/// What decides which equations of motion a system has: [`Degenerate`], [`Regular`], [`Holonomic`] or [`Nonholonomic`].
pub trait Kind: Debug {
    /// Whether the mass matrix is regular.
    const REGULAR: bool;
}

/// The kind of L = α(q, t)·v − H(q, t): the equations of motion are of first order on Q.
#[derive(Clone, Copy, Debug)]
pub enum Degenerate {}

/// The kind of L(q, v, t) with a regular mass matrix: the equations of motion are of second order, or of first order on
/// T*Q.
#[derive(Clone, Copy, Debug)]
pub enum Regular {}

/// The kind of L(q, v, t) with a regular mass matrix and holonomic constraints g(q, t) = 0.
#[derive(Clone, Copy, Debug)]
pub enum Holonomic {}

/// The kind of L(q, v, t) with a regular mass matrix and constraints of the velocities, A(q, t) v + b(q, t) = 0.
#[derive(Clone, Copy, Debug)]
pub enum Nonholonomic {}

impl Kind for Degenerate {
    const REGULAR: bool = false;
}

impl Kind for Regular {
    const REGULAR: bool = true;
}

impl Kind for Holonomic {
    const REGULAR: bool = true;
}

impl Kind for Nonholonomic {
    const REGULAR: bool = true;
}

/// The kinds of systems without constraints.
#[diagnostic::on_unimplemented(
    message = "the system has constraints, and this would not keep them",
    label = "it does not know constraints",
    note = "systems with `constraint = …` or `nonholonomic = …` are stepped by `Constrained` around a variational method, and by `Rattle`"
)]
pub trait Unconstrained: Kind {}

impl Unconstrained for Degenerate {}
impl Unconstrained for Regular {}
