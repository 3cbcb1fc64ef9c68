//! Where a run begins, or a part of a step: with a defect, or without.

use super::Sigma;
use super::memory::{Carried, Leaps, SigmaMemory, Work};
use super::parasitic_mode::{Monitor, Pace};
use crate::discrete::{Interval, OneNode, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::combination::{Combination, Inverse, Product};
use crate::mechanics::orientation::FormOrientation;
use crate::mechanics::pattern::of_second_derivatives;
use crate::scalar::norm;
use crate::scalar::passes::{add, multiply, negate, subtract};
use crate::solve::{Ladder, Solver};
use crate::state::history::History;
use crate::state::{Statistics, summation};
use crate::{DegenerateLagrangian, Real, Space, Vector};

impl<S: DegenerateLagrangian<T>, T: Real> SigmaMemory<S, T> {
    /// For a run on the constraint p = α(q) that stays on it.
    pub(super) fn without_defect(
        system: &S,
        method: &Sigma<T>,
        q: &Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let mut memory = Self::new(system, method, q, t, h)?;
        let Carried { defect_vanishes, inverse, history, l_d, work, .. } = &mut memory.carried;
        *defect_vanishes = true;
        if S::AFFINE && method.sigma != T::lift(1.0) {
            // The first increment is about that of the field where the run begins.
            system.hamiltonian_gradient(q, t, &mut l_d.work.gradient);
            inverse.solve(system, &l_d.work.gradient, &mut work.increment);
            history.begin_again(&work.increment);
        }
        Ok(memory)
    }

    /// For a run whose first step leads from `q0` to `q1`: p0 = −D₁L_d(q0, q1).
    pub(super) fn between(
        system: &S,
        method: &Sigma<T>,
        [q0, q1]: [&Vector<S, T>; 2],
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let mut memory = Self::new(system, method, q0, t, h)?;
        let Carried { defect, one_form, l_d, work: Work { increment, sum, .. }, .. } = &mut memory.carried;
        for i in 0..q0.len() {
            increment[i] = q1[i] - q0[i];
        }
        // c0 = p0 − α(q0) = −D₁L_d − α(q0).
        defect.copy_from_slice(one_form);
        let span = Span { system, interval: Interval { t, h }, q0, delta: increment };
        l_d.derivatives(span, defect, sum, &mut Statistics::default());
        negate(defect);
        norm::finite(defect).map_err(StartError::Starter)?;
        memory.aim(system, method, q0);
        Ok(memory)
    }

    fn new(system: &S, method: &Sigma<T>, q: &Vector<S, T>, t: T, h: T) -> Result<Self, StartError> {
        let (space, sigma) = (system.space(), method.sigma);
        let (scale, matrix) = scaled::<S, T>(method, h);
        let mut inverse = Inverse::new(system, q, t, matrix);
        let [shift, increment, mut trial, weights, sum, next, rest, mut one_form] = space.vectors();
        if S::AFFINE {
            let unused = &mut Statistics::default();
            inverse.prepare(system, q, t, matrix, &mut trial, unused).map_err(StartError::Starter)?;
        }
        let product = || Product::new(system, q, t, Combination { a: sigma - T::lift(1.0), b: sigma });
        let leaps = (S::AFFINE && sigma == T::lift(0.0))
            .then(|| Leaps { product: product(), before: space.vector() });
        let product = (S::AFFINE && leaps.is_none() && !method.is_midpoint()).then(product);
        let solver = if method.is_end() { Solver::FixedPoint } else { method.solver.in_numbers::<T>() };
        let newton = || of_second_derivatives(system, q, &rest, t, solver.storing());
        system.one_form(q, t, &mut one_form);
        let (limit, pace) = match method.parasitic_limit {
            // The mode is only reversed.
            Some(_) if S::AFFINE && method.is_midpoint() => (None, Pace::Seldom),
            None => (None, Pace::Seldom),
            // K' = −K: c is reversed, and a gradient added to it.
            limit if S::AFFINE => (limit, Pace::WithTheFlow),
            limit => (limit, Pace::EachStep),
        };
        Ok(Self {
            ladder: Ladder::new(solver, newton),
            monitor: Monitor::new(system, limit, pace),
            carried: Carried {
                defect: space.vector(),
                defect_vanishes: false,
                one_form,
                history: History::new(system, None),
                inverse,
                scale,
                product,
                leaps,
                l_d: OneNode::new(system, sigma),
                orientation: FormOrientation::new(system, q, t),
                rest: summation::Carried::new(system, method.summation),
                work: Work { shift, increment, trial, weights, sum, next },
            },
        })
    }

    /// Prepares the first step from `q` with the present defect, by about `work.increment`.
    fn aim(&mut self, system: &S, method: &Sigma<T>, q: &[T]) {
        let carried = &mut self.carried;
        if S::AFFINE && method.sigma != T::lift(1.0) {
            carried.shift_by_defect(system);
            let Work { shift, increment, .. } = &mut carried.work;
            subtract(increment, shift);
            if let Some(Leaps { before, .. }) = &mut carried.leaps {
                add(q, shift, before);
            }
        }
        carried.history.begin_again(&carried.work.increment);
    }

    /// Prepares a step of length `h` that is a part of one of the length `whole`. On a smooth orbit the
    /// defect is of first order in that length and, if σ = ½, of second, so that its first term is taken for
    /// the whole.
    pub(super) fn shorten(
        &mut self,
        system: &S,
        method: &Sigma<T>,
        q: &Vector<S, T>,
        t: T,
        [h, whole]: [T; 2],
    ) -> Result<(), StepFailure> {
        let Carried { defect, inverse, scale, work, .. } = &mut self.carried;
        if S::AFFINE {
            let matrix;
            (*scale, matrix) = scaled::<S, T>(method, h);
            inverse.prepare(system, q, t, matrix, &mut work.trial, &mut Statistics::default())?;
        }
        let part = h / whole;
        let factor = if method.is_midpoint() { part * part } else { part };
        multiply(defect, factor);
        work.increment.fill(T::lift(0.0));
        self.ladder.begin_again();
        self.aim(system, method, q);
        Ok(())
    }
}

/// The scale of the matrix that is inverted, and the matrix, K times it. If α is affine and σ ≠ 1, the scale
/// is −1/((1−σ)h), so that the inverse maps ∇H to s; else one.
pub(super) fn scaled<S: DegenerateLagrangian<T>, T: Real>(method: &Sigma<T>, h: T) -> (T, Combination<T>) {
    let (sigma, one) = (method.sigma, T::lift(1.0));
    let left = one - sigma;
    let scale = if S::AFFINE && sigma != one { -one / (left * h) } else { one };
    (scale, Combination { a: sigma * scale, b: -left * scale })
}
