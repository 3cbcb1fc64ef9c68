//! Methods whose steps may differ in length.

use super::{Carries, Method, Tolerance};
#[cfg(doc)]
use super::{Scheme, Suits};
use crate::discrete::Span;
use crate::error::StepFailure;
use crate::state::Statistics;
use crate::system::Same;
use crate::{Lagrangian, Real, Vector};

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

    /// Whether [`discrete_energy`](Self::discrete_energy) is known.
    fn has_discrete_energy(&self) -> bool {
        false
    }

    /// The discrete energy E_d = −∂L_d/∂h of a step, for L that does not depend on time (Marsden & West
    /// 2001, section 4.2); `None` if it is not known. `work` is storage for a point and a velocity.
    fn discrete_energy(&self, _span: Span<'_, S, T>, _work: &mut [Vector<S, T>; 2]) -> Option<T> {
        None
    }

    /// Whether [`local_error`](Self::local_error) is known.
    fn estimates_local_error(&self) -> bool {
        false
    }

    /// An estimate of the error of the last step, which was taken from time `t` with length `h`, in units of
    /// `tolerance`, without allocation; `None` if the method has none. It is of the order h<sup>p+1</sup> of
    /// the error, with the [order](Scheme::order) p. `usual` is the length that steps had before: a step
    /// that begins at rest may have the error that is allowed in what its force makes in that time.
    ///
    /// # Errors
    /// [`StepFailure`] if the equations of motion cannot be evaluated where the step began.
    fn local_error(
        &self,
        _system: &S,
        _memory: &mut Self::Memory,
        _t: T,
        [_h, _usual]: [T; 2],
        _tolerance: Tolerance,
        _statistics: &mut Statistics,
    ) -> Result<Option<T>, StepFailure> {
        Ok(None)
    }
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
