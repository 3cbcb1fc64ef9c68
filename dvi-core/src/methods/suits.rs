//! Methods that suit a system, and those among them whose steps may differ in length.

use super::{Carries, Method};
use crate::system::Same;
use crate::{Lagrangian, Real};

/// A [`Method`] for `S` that is `M`: where it is one for systems of another kind, rustc does not know `M`.
pub trait Suits<S: Lagrangian<T>, T: Real, M: Carries<S, T>> {
    /// `M`, of which it is known here that it steps `S`.
    type Method: Method<S, T, Memory = M::Memory>;
    /// The method as it is.
    fn suited(self) -> M;
    /// The method as it is, as what steps `S`.
    fn steps(method: &M) -> &Self::Method;
}

impl<S: Lagrangian<T>, T: Real, M, X> Suits<S, T, M> for X
where
    X: Method<S, T, Suited<X>: Same<X, As = M>>,
    M: Method<S, T>,
{
    type Method = M;
    #[inline]
    fn suited(self) -> M {
        X::Suited::<X>::same(self)
    }
    #[inline]
    fn steps(method: &M) -> &M {
        method
    }
}

/// A method whose memory does not depend on the step, so that steps of different lengths, also negative,
/// may follow one another.
#[diagnostic::on_unimplemented(
    message = "the steps of `{Self}` are all of one length",
    label = "a composition takes steps of different lengths",
    note = "degenerate systems are stepped in any length by `OneStep`, `Projected`, `Gauss` and \
        `RungeKutta`",
    note = "regular systems by `Variational`, `Galerkin`, `Gauss` and `RungeKutta`, or by `Constrained`, \
        `Rattle` and `Geodesic`"
)]
pub trait VariableStep<S: Lagrangian<T>, T: Real>: Method<S, T> {
    /// As [`Method::Suited`].
    type SuitedToAnyStep<M>: Same<M, As = M>;
}

/// A [`VariableStep`] method for `S` that is `M`, as a method [`Suits`] a system.
#[diagnostic::on_unimplemented(
    message = "the steps of `{Self}` are all of one length",
    label = "a step control takes steps of different lengths",
    note = "degenerate systems are stepped in any length by `OneStep`, `Projected`, `Gauss` and \
        `RungeKutta`",
    note = "regular systems by `Variational`, `Galerkin`, `Gauss` and `RungeKutta`, or by `Constrained`, \
        `Rattle` and `Geodesic`"
)]
pub trait SuitsAnyStep<S: Lagrangian<T>, T: Real, M: Carries<S, T>> {
    /// As [`Suits::Method`].
    type Method: VariableStep<S, T, Memory = M::Memory>;
    /// As [`Suits::suited`].
    fn suited(self) -> M;
    /// As [`Suits::steps`].
    fn steps(method: &M) -> &Self::Method;
}

impl<S: Lagrangian<T>, T: Real, M, X> SuitsAnyStep<S, T, M> for X
where
    X: VariableStep<S, T, SuitedToAnyStep<X>: Same<X, As = M>>,
    M: VariableStep<S, T>,
{
    type Method = M;
    #[inline]
    fn suited(self) -> M {
        X::SuitedToAnyStep::<X>::same(self)
    }
    #[inline]
    fn steps(method: &M) -> &M {
        method
    }
}
