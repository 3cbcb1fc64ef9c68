//! The Legendre transform backwards: the velocity v with ∂L/∂v(q, v, t) = p.
//!
//! Newton's method with the mass matrix ∂²L/∂v∂v, which is one linear solve if L is quadratic in v
//! (Marsden & West 2001, section 1.4).

use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::{LinearEquations, LinearSolver, Sink, Storing};
use crate::state::Statistics;
use crate::{Lagrangian, Linear, Real, Space, System, Vector, Weights};

/// Storage for the transform.
#[derive(Debug)]
pub(crate) struct Legendre<S: System, T: Real> {
    solver: Linear<S, T>,
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
            solver: of_second_derivatives(system, q, v, t, Storing::Always),
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
        let Self { solver, residual, correction, l_q } = self;
        for _ in 0..HALVINGS {
            system.gradient(q, v, t, l_q, residual);
            if norm::finite(residual).is_ok() {
                break;
            }
            for (v, correction) in v.iter_mut().zip(correction.iter_mut()) {
                *correction *= T::lift(0.5);
                *v += *correction;
            }
        }
        solver.solve(&mut Equations { system, points: [q, v, p], t, l_q }, correction)?;
        for (v, &correction) in v.iter_mut().zip(correction.iter()) {
            *v -= correction;
        }
        Ok(norm::largest(correction))
    }
}

/// ∂²L/∂v∂v d = ∂L/∂v − p
struct Equations<'a, S, T> {
    system: &'a S,
    /// q, v and p.
    points: [&'a [T]; 3],
    t: T,
    l_q: &'a mut [T],
}

impl<S: Lagrangian<T>, T: Real> LinearEquations<T> for Equations<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let (zero, [q, v, p]) = (T::lift(0.0), self.points);
        let mass = Weights { qq: zero, qv: zero, vq: zero, vv: T::lift(1.0) };
        self.system.linearize(q, v, self.t, mass, self.l_q, b, sink);
        for (b, &p) in b.iter_mut().zip(p) {
            *b -= p;
        }
        Ok(())
    }
}
