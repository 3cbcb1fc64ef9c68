//! The Legendre transform backwards: the velocity v with ∂L/∂v(q, v, t) = p.
//!
//! Newton's method with the mass matrix ∂²L/∂v∂v, which is one linear solve if L is quadratic in v
//! (Marsden & West 2001, section 1.4).

use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::square::{SquareMatrix, of_second_derivatives};
use crate::state::Statistics;
use crate::{Lagrangian, Real, Space, Square, System, Vector, Weights};

/// Storage for the transform.
#[derive(Debug)]
pub(crate) struct Legendre<S: System, T: Real> {
    matrix: Square<S, T>,
    residual: Vector<S, T>,
    /// By how much the velocity has changed in the last iteration.
    correction: Vector<S, T>,
    l_q: Vector<S, T>,
}

/// How often a correction that leads out of the domain of L is halved.
const HALVINGS: usize = 60;

impl<S: Lagrangian<T>, T: Real> Legendre<S, T> {
    /// For points of which (`q`, `v`, `t`) is one.
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T) -> Self {
        let space = system.space();
        Self {
            matrix: of_second_derivatives(system, q, v, t),
            residual: space.vector(),
            correction: space.vector(),
            l_q: space.vector(),
        }
    }

    /// Improves the guess `v` until ∂L/∂v = `p`; once, where L is quadratic in v.
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
        is_quadratic: bool,
    ) -> Result<(), StepFailure> {
        self.correction.fill(T::lift(0.0));
        self.improve(system, q, p, t, v)?;
        if is_quadratic {
            return norm::finite(v);
        }
        let stopping = Stopping::default();
        let convergence = Convergence::new(stopping, norm::largest(v), v, stopping.max_iterations);
        iterate(convergence, &mut Statistics::default(), |_| self.improve(system, q, p, t, v))?;
        norm::finite(v)
    }

    /// One iteration, from `v` or, where L is not defined there, from nearer to where the last one began; returns the size
    /// of its correction.
    fn improve(&mut self, system: &S, q: &[T], p: &[T], t: T, v: &mut [T]) -> Result<T, StepFailure> {
        let mut defined = self.linearize(system, q, p, t, v);
        for _ in 0..HALVINGS {
            if defined.is_ok() {
                break;
            }
            for (v, correction) in v.iter_mut().zip(self.correction.iter_mut()) {
                *correction *= T::lift(0.5);
                *v += *correction;
            }
            defined = self.linearize(system, q, p, t, v);
        }
        defined?;
        self.matrix.eliminate(&mut self.residual)?;
        self.correction.copy_from_slice(&self.residual);
        for (v, &correction) in v.iter_mut().zip(self.correction.iter()) {
            *v -= correction;
        }
        Ok(norm::largest(&self.correction))
    }

    /// Sets `residual` to ∂L/∂v − p and `matrix` to the mass matrix.
    fn linearize(&mut self, system: &S, q: &[T], p: &[T], t: T, v: &[T]) -> Result<(), StepFailure> {
        let zero = T::lift(0.0);
        let mass = Weights { qq: zero, qv: zero, vq: zero, vv: T::lift(1.0) };
        system.linearize(q, v, t, mass, &mut self.l_q, &mut self.residual, self.matrix.cleared());
        for (r, &p) in self.residual.iter_mut().zip(p) {
            *r -= p;
        }
        norm::finite(&self.residual)
    }
}
