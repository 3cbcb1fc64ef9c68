//! The second derivatives of a discrete Lagrangian L_d(q0, q1).

use crate::discrete::{DiscreteLagrangian, Ends, Interval, Span};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
use crate::{Lagrangian, Matrix, Real, Space, System, Vector};

/// D₁D₁L_d, D₁D₂L_d, D₂D₁L_d and D₂D₂L_d at a pair of points, row-major, of the discrete Lagrangian `L`; on
/// a system with forces, the derivatives of D₁L_d + F⁻ and D₂L_d + F⁺.
///
/// D₁D₂ with entries ∂²L_d/∂q0ⁱ∂q1ʲ is the matrix of the two-form D₁D₂ dq0 ∧ dq1 on Q×Q that each step
/// preserves (Marsden & West 2001, section 1.3.2; Rowley & Marsden 2002, eq. 17).
#[derive(Debug)]
pub struct DiscreteHessian<S: System, L, T: Real = f64> {
    /// D₁D₁L_d.
    pub d11: Matrix<S, T>,
    /// D₁D₂L_d: row i belongs to q0ⁱ, column j to q1ʲ.
    pub d12: Matrix<S, T>,
    /// D₂D₁L_d, the transpose of D₁D₂L_d unless forces act.
    pub d21: Matrix<S, T>,
    /// D₂D₂L_d.
    pub d22: Matrix<S, T>,
    discrete: L,
    start: Vector<S, T>,
    delta: Vector<S, T>,
}

impl<S: Lagrangian<T>, L: DiscreteLagrangian<S, T>, T: Real> DiscreteHessian<S, L, T> {
    /// Storage for the discrete Lagrangian of `method` on `system`, with zeros.
    pub fn new(system: &S, method: &impl VariationalMethod<S, T, DiscreteLagrangian = L>) -> Self {
        let space = system.space();
        Self {
            d11: space.matrix(),
            d12: space.matrix(),
            d21: space.matrix(),
            d22: space.matrix(),
            discrete: method.discrete_lagrangian(system),
            start: space.vector(),
            delta: space.vector(),
        }
    }

    /// Evaluates the matrices for the step over `interval` from `q0` to `q1`. Slices shorter than the
    /// dimension count as continued by zeros.
    ///
    /// # Errors
    /// Those of the discrete Lagrangian.
    pub fn evaluate(
        &mut self,
        system: &S,
        interval: Interval<T>,
        q0: &[T],
        q1: &[T],
    ) -> Result<(), StepFailure> {
        self.start.fill(T::lift(0.0));
        self.delta.fill(T::lift(0.0));
        for (start, &q0) in self.start.iter_mut().zip(q0) {
            *start = q0;
        }
        for (delta, &q1) in self.delta.iter_mut().zip(q1) {
            *delta = q1;
        }
        for (delta, &q0) in self.delta.iter_mut().zip(self.start.iter()) {
            *delta -= q0;
        }
        let Self { d11, d12, d21, d22, discrete, start, delta } = self;
        for matrix in [&mut *d11, d12, d21, d22] {
            matrix.fill(T::lift(0.0));
        }
        let ends = Ends { q0: start, delta };
        discrete.hessian(Span { system, interval, ends }, [d11, d12, d21, d22])
    }
}
