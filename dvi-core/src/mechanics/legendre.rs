//! The Legendre transform backwards: the velocity v with ∂L/∂v(q, v, t) = p.
//!
//! Newton's method with the mass matrix ∂²L/∂v∂v, which is one linear solve if L is quadratic in v
//! (Marsden & West 2001, section 1.4).

use crate::error::StepFailure;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::scalar::passes::subtract;
use crate::solve::{Due, Stopping, newton, sizes};
use crate::space::{LinearEquations, LinearSolver, Sink, Storing, linear, scratch};
use crate::state::Statistics;
use crate::{Lagrangian, Linear, NondegenerateLagrangian, Real, Space, System, Vector, Weights};

/// Storage for the transform.
#[derive(Debug)]
pub(crate) struct Legendre<S: System, T: Real> {
    solver: Linear<S, T>,
    /// By how much the velocity has changed in the last iteration.
    correction: Vector<S, T>,
    /// By how much it is to change in the next.
    next: Vector<S, T>,
    l_q: Vector<S, T>,
    /// In which the iteration judges velocities.
    weights: Vector<S, T>,
}

/// How often a correction that leads out of the domain of L is halved.
const HALVINGS: usize = 60;

impl<S: NondegenerateLagrangian<T>, T: Real> Legendre<S, T> {
    /// For points of which (`q`, `v`, `t`) is one.
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T) -> Self {
        let space = system.space();
        Self {
            solver: of_second_derivatives(system, q, v, t, Storing::Always),
            correction: space.vector(),
            next: space.vector(),
            l_q: space.vector(),
            weights: space.vector(),
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
    ) -> Result<(), StepFailure> {
        self.correction.fill(T::lift(0.0));
        Due::Sizes.prepare_alone(system, &mut self.weights, v);
        self.improve(system, q, p, t, v)?;
        if S::QUADRATIC {
            return norm::finite(v);
        }
        newton(Stopping::default(), &mut Statistics::default(), &mut |due, _| {
            due.prepare_alone(system, &mut self.weights, v);
            if *due == Due::Residual {
                let Self { correction, l_q, weights, .. } = self;
                let (points, sums) = ([q, &*v, p], [&mut correction[..], &mut weights[..]]);
                let equations = &mut Equations { system, points, t, l_q };
                return linear::residual(equations, |j| v[j], |i| p[i], sums);
            }
            self.improve(system, q, p, t, v)?;
            Ok(sizes::largest(&self.weights, &self.correction))
        })?;
        norm::finite(v)
    }

    /// One iteration, from `v` or, where L is not defined there, from nearer to where the last one began,
    /// which leaves its correction.
    fn improve(&mut self, system: &S, q: &[T], p: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        let mut solved = self.solve_once(system, [q, v, p], t);
        for _ in 0..HALVINGS {
            if !matches!(solved, Err(StepFailure::NotFinite { .. })) {
                break;
            }
            for (v, correction) in v.iter_mut().zip(self.correction.iter_mut()) {
                *correction *= T::lift(0.5);
                *v += *correction;
            }
            solved = self.solve_once(system, [q, v, p], t);
        }
        solved?;
        core::mem::swap(&mut self.correction, &mut self.next);
        subtract(v, &self.correction);
        Ok(())
    }

    /// Sets `next` to the correction of v at (q, v), p.
    ///
    /// # Errors
    /// [`StepFailure::NotFinite`] where L is not defined, [`StepFailure::Singular`] where the mass matrix
    /// is.
    fn solve_once(&mut self, system: &S, points: [&[T]; 3], t: T) -> Result<(), StepFailure> {
        let Self { solver, weights, next, l_q, .. } = self;
        let solved = solver.solve(&mut Equations { system, points, t, l_q }, weights, next);
        solved.map_err(|failure| failure.of(StepFailure::MASS))?;
        norm::finite(next)
    }
}

/// ∂²L/∂v∂v d = ∂L/∂v − p
pub(crate) struct Equations<'a, S, T> {
    pub(crate) system: &'a S,
    /// q, v and p.
    pub(crate) points: [&'a [T]; 3],
    pub(crate) t: T,
    /// Work space.
    pub(crate) l_q: &'a mut [T],
}

impl<S: Lagrangian<T>, T: Real> LinearEquations<T> for Equations<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let [q, v, p] = self.points;
        // On the stack, where nobody reads it, ∂L/∂q is not computed.
        scratch!(l_q = self.system, *self.l_q);
        self.system.linearize(q, v, self.t, Weights::mass(), l_q, b, sink);
        subtract(b, p);
        Ok(())
    }
}
