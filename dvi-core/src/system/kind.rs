//! What decides which equations of motion a system has.

use core::fmt::Debug;

/// What decides which equations of motion a system has: [`Degenerate`], [`Regular`], [`Manifold`],
/// [`Holonomic`], [`Nonholonomic`] or [`Unilateral`].
pub trait Kind: Debug {
    /// Whether the mass matrix is regular.
    const REGULAR: bool;
}

macro_rules! kinds {
    ($($(#[$doc:meta])* $Kind:ident, $is_regular:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub enum $Kind {}

        impl Kind for $Kind {
            const REGULAR: bool = $is_regular;
        }
    )*};
}

kinds! {
    /// The kind of L = α(q, t)·v − H(q, t): the equations of motion are of first order on Q.
    Degenerate, false;
    /// The kind of L(q, v, t) with a regular mass matrix: the equations of motion are of second order, or of
    /// first order on T*Q.
    Regular, true;
    /// The kind of L(q, v, t) with a regular mass matrix on a manifold: some coordinates are rotation
    /// matrices or unit vectors.
    Manifold, true;
    /// The kind of L(q, v, t) with a regular mass matrix and holonomic constraints g(q, t) = 0.
    Holonomic, true;
    /// The kind of L(q, v, t) with a regular mass matrix and constraints of the velocities,
    /// A(q, t) v + b(q, t) = 0.
    Nonholonomic, true;
    /// The kind of L(q, v, t) with a regular mass matrix whose motion stays where g(q, t) ≥ 0: between
    /// impacts that of [`Regular`].
    Unilateral, true;
}

/// The kinds of systems whose motion is a smooth curve of numbers, between two of which one may interpolate:
/// all but [`Unilateral`] and [`Manifold`].
#[diagnostic::on_unimplemented(
    message = "the motion of the system jumps at impacts, or has rotations or unit vectors, and this \
        interpolates numbers",
    label = "it would go through the impacts, or leave the manifold",
    note = "the memory of a run with `Impacts` has the impacts of the last step, with their times and states"
)]
pub trait Smooth: Kind {}

impl Smooth for Degenerate {}
impl Smooth for Regular {}
impl Smooth for Holonomic {}
impl Smooth for Nonholonomic {}
