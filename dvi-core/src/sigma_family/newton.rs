//! Newton's method on r(Δ) = p0 − α(q_σ) + (1−σ)h ∂L/∂q(q_σ, Δ/h).
//!
//! ∂r/∂Δ = −σDα + (1−σ)(Dα)ᵀ + σ(1−σ)h ∂²L/∂q∂q, which is ∂²L_d/∂q0∂q1 (Rowley & Marsden 2002, eq. 17).

use super::Step;
use super::memory::Work;
use crate::error::StepFailure;
use crate::solver::{Convergence, Verdict};
use crate::statistics::Statistics;
use crate::{DegenerateLagrangian, Lagrangian, Matrix, Real, Vector, Weights, elimination, norm};

/// Where Newton begins.
#[derive(Clone, Copy, Debug)]
pub(super) enum Guess {
    /// The extrapolated increment, which is best as a rule.
    Extrapolated,
    /// No increment: Newton's first iterate is then the linearly implicit step, which is safer where steps
    /// are so long that extrapolation is off.
    Zero,
}

/// The weights with which the second derivatives of L make ∂²L_d/∂q0∂q1, for affine L.
pub(crate) fn mixed_weights<T: Real>(sigma: T, h: T) -> Weights<T> {
    let left = T::lift(1.0) - sigma;
    Weights { qq: sigma * left * h, qv: left, vq: -sigma, vv: T::lift(0.0) }
}

/// Improves `work.increment`, which holds the guess of Δ, until r(Δ) = 0.
#[inline]
pub(super) fn solve<S: DegenerateLagrangian, T: Real>(
    step: &Step<'_, S, T>,
    storage: &mut Option<Matrix<S, T>>,
    work: &mut Work<S, T>,
    q: &Vector<S, T>,
    defect: &Vector<S, T>,
    one_form: &Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let sigma = step.method.sigma;
    let scale = norm::largest(q) + norm::largest(&work.increment);
    let stopping = step.method.stopping;
    let mut convergence = Convergence::new(stopping, scale, q, stopping.max_iterations);
    // Only a run by fixed point alone has no storage, and it never comes here.
    let Some(matrix) = storage else { return Err(convergence.failure()) };
    let (weights, left_h) = (mixed_weights(sigma, step.h), (T::lift(1.0) - sigma) * step.h);
    let per_h = T::lift(1.0) / step.h;
    let verdict = loop {
        step.place(work, q, per_h);
        matrix.fill(T::lift(0.0));
        let Work { point, velocity, gradient, momentum, trial, increment, .. } = work;
        step.system.linearize(point, velocity, step.node_time(), weights, gradient, momentum, matrix);
        for i in 0..trial.len() {
            trial[i] = defect[i] + one_form[i] - momentum[i] + left_h * gradient[i];
        }
        let residual = norm::finite(trial);
        if let Err(singular) = elimination::eliminate(matrix, trial) {
            return Err(residual.err().unwrap_or(singular));
        }
        for (delta, &correction) in increment.iter_mut().zip(trial.iter()) {
            *delta -= correction;
        }
        match convergence.judge(norm::largest(trial)) {
            Verdict::Continue => {}
            verdict => break verdict,
        }
    };
    let iterations = convergence.iterations as u64;
    *statistics += Statistics {
        iterations,
        linearizations: iterations,
        factorisations: iterations,
        ..Default::default()
    };
    match verdict {
        Verdict::GiveUp => Err(convergence.failure()),
        _ => norm::finite(&work.increment),
    }
}

impl<S: Lagrangian, T: Real> Step<'_, S, T> {
    /// Sets `point` to q_σ and `velocity` to Δ/h.
    #[inline(always)]
    pub(super) fn place(&self, work: &mut Work<S, T>, q: &[T], per_h: T) {
        let Work { point, velocity, increment, .. } = work;
        for i in 0..q.len() {
            point[i] = q[i] + self.method.sigma * increment[i];
            velocity[i] = increment[i] * per_h;
        }
    }
}
