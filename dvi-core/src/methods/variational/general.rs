//! Any L: Newton's method, or where L is separable and only the frequency asks for derivatives, a fixed
//! point with the matrix of the fitted oscillator, −(h/κ)M⁻¹ in place of (D₁D₂L_d)⁻¹.

use super::Step;
use super::coefficients::Coefficients;
use super::lagrangian::Interpolated;
use super::memory::{Parts, Work};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::quadrature::Rule;
use crate::discrete::{DiscreteLagrangian, Ends, solve_by_newton};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::{Arrival, Increments, PhasePoint};
use crate::scalar::norm;
use crate::solve::{Convergence, Guess, iterate, sizes};
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{Linear, NondegenerateLagrangian, Real, Vector};

/// A step by Newton's method from a guess.
#[inline(never)]
pub(super) fn by_newton<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    parts: &mut Parts<'_, S, T>,
    solver: &mut Linear<S, T>,
    guess: Guess,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Parts { coefficients, ends, phase, inertial, work, weights, q } = parts;
    let mass = inertial.constant();
    guess.begin(&mut work.increment, |increment| phase.guess(mass, &phase.p, step.h, increment));
    newton(step, coefficients, ends, mass, phase, (work, weights), q, solver, statistics)?;
    finish(step, parts, statistics)
}

/// A step by the fixed point Δ ← Δ + (h/κ)M⁻¹(p0 + D₁L_d), for separable L.
#[inline(never)]
pub(super) fn by_fixed_point<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    parts: &mut Parts<'_, S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Parts { coefficients, ends, phase, inertial, work, weights, q } = parts;
    let Some(mass) = inertial.constant() else { return Err(StepFailure::NO_MATRIX) };
    phase.guess(Some(mass), &phase.p, step.h, &mut work.increment);
    let Work { node, next, increment, trial, sum } = &mut **work;
    let (method, p, force) = (step.method, &phase.p, &phase.force);
    let mut l_d = Interpolated { method, coefficients, ends, mass: Some(mass), p, force, node, next };
    let stopping = match step.method.summation {
        Summation::Plain => step.method.stopping,
        Summation::Compensated => step.method.stopping.exhaustive(),
    };
    let convergence = Convergence::fixed_point(stopping, stopping.max_iterations);
    iterate(convergence, statistics, |due, statistics| {
        due.prepare(step.system, weights, q, increment);
        trial.copy_from_slice(p);
        let ends = Ends { q0: q, delta: increment };
        l_d.derivatives(step.span(ends), trial, sum, statistics)?;
        let inverse_kappa = l_d.coefficients.sums.inverse_kappa;
        mass.solve(trial, &mut l_d.node.velocity);
        for velocity in l_d.node.velocity.iter_mut() {
            *velocity *= -(step.h * inverse_kappa);
        }
        Ok(sizes::reduce(step.system, weights, increment, &l_d.node.velocity))
    })?;
    norm::finite(increment)?;
    sum.fill(T::lift(0.0));
    l_d.derivatives(step.span(Ends { q0: q, delta: increment }), trial, sum, statistics)?;
    finish(step, parts, statistics)
}

/// Sets `work.increment` to Δ and `work.sum` to (D₁ + D₂)L_d.
#[allow(clippy::too_many_arguments)]
fn newton<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &mut Coefficients<T>,
    ends: &mut [Local<S, T>; 2],
    mass: Option<&Mass<S, T>>,
    phase: &PhasePoint<S, T>,
    (work, weights): (&mut Work<S, T>, &mut Vector<S, T>),
    q: &[T],
    solver: &mut Linear<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Work { node, next, increment, trial, sum } = work;
    let (method, p, force) = (step.method, &*phase.p, &*phase.force);
    let l_d = &mut Interpolated { method, coefficients, ends, mass, p, force, node, next };
    let (interval, stopping) = (step.interval(), step.method.stopping);
    let storage = (solver, [&mut *trial, weights]);
    solve_by_newton(l_d, step.system, interval, [q, p], increment, storage, stopping, statistics)?;
    sum.fill(T::lift(0.0));
    l_d.derivatives(step.span(Ends { q0: q, delta: increment }), trial, sum, statistics)
}

/// Moves to q1 = q0 + Δ and p1 = p0 + (D₁ + D₂)L_d.
fn finish<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    Parts { phase, inertial, work, q, .. }: &mut Parts<'_, S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Work { node, next, increment, trial, sum } = &mut **work;
    phase.reach(q, increment, next);
    phase.kick(sum, &mut node.momentum);
    norm::finite(next).and(norm::finite(&node.momentum))?;
    let end = step.node_time(1.0);
    if S::SEPARABLE {
        step.force(next, 1.0, trial);
        statistics.gradients += 1;
    }
    inertial.check(step.system, [next, increment], [end, step.h], &mut node.velocity)?;
    let by = Increments { q: increment, p: sum };
    phase.advance(q, &Arrival { q: next, p: &node.momentum, force: trial }, by, step.h)
}
