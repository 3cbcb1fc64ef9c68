//! The Legendre transform backwards: the velocity v with ∂L/∂v(q, v, t) = p.
//!
//! Newton's method with the mass matrix ∂²L/∂v∂v, which is one linear solve if L is quadratic in v
//! (Marsden & West 2001, section 1.4).

use crate::error::StepFailure;
use crate::solve::{Convergence, Stopping, iterate};
use crate::statistics::Statistics;
use crate::{Matrix, Real, RegularLagrangian, Space, Vector, Weights, elimination, norm};

/// Storage for the transform.
#[derive(Debug)]
pub(crate) struct Legendre<S: RegularLagrangian, T: Real> {
    matrix: Matrix<S, T>,
    residual: Vector<S, T>,
    l_q: Vector<S, T>,
}

impl<S: RegularLagrangian, T: Real> Legendre<S, T> {
    pub(crate) fn new(system: &S) -> Self {
        let space = system.space();
        Self { matrix: space.matrix(), residual: space.vector(), l_q: space.vector() }
    }

    /// Improves the guess `v` until ∂L/∂v = `p`.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] where the mass matrix is, [`StepFailure::NotConverged`] where there is no
    /// such velocity near the guess.
    pub(crate) fn solve(
        &mut self,
        system: &S,
        q: &[T],
        p: &[T],
        t: T,
        v: &mut [T],
    ) -> Result<(), StepFailure> {
        self.improve(system, q, p, t, v)?;
        if S::QUADRATIC {
            return norm::finite(v);
        }
        let stopping = Stopping::default();
        let convergence = Convergence::new(stopping, norm::largest(v), v, stopping.max_iterations);
        iterate(convergence, &mut Statistics::default(), |_| self.improve(system, q, p, t, v))?;
        norm::finite(v)
    }

    /// One iteration; returns the size of its correction.
    fn improve(&mut self, system: &S, q: &[T], p: &[T], t: T, v: &mut [T]) -> Result<T, StepFailure> {
        let zero = T::lift(0.0);
        let mass = Weights { qq: zero, qv: zero, vq: zero, vv: T::lift(1.0) };
        self.matrix.fill(zero);
        system.linearize(q, v, t, mass, &mut self.l_q, &mut self.residual, &mut self.matrix);
        for (r, &p) in self.residual.iter_mut().zip(p) {
            *r -= p;
        }
        norm::finite(&self.residual)?;
        elimination::eliminate(&mut self.matrix, &mut self.residual)?;
        for (v, &correction) in v.iter_mut().zip(self.residual.iter()) {
            *v -= correction;
        }
        Ok(norm::largest(&self.residual))
    }
}
