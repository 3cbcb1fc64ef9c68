//! Gauss collocation of a degenerate Lagrangian in class, for the increments Wₖ = h Vₖ of all stages at
//! once, by Newton's method:
//!
//! rᵢ = α(Qᵢ) − p − h Σⱼ aᵢⱼ Fⱼ = 0,   Qᵢ = q + Σₖ aᵢₖ Wₖ,   F = ∂L/∂q(Q, V)
//! ∂rᵢ/∂Wₖ = aᵢₖ Dα(Qᵢ) − aᵢₖ L_qv(Qₖ) − h Σⱼ aᵢⱼ aⱼₖ L_qq(Qⱼ)
//! x1 = x0 + Σᵢ bᵢ Wᵢ,   p1 = p0 + h Σᵢ bᵢ Fᵢ along x,   ϑ(x1, y1) = p1
//!
//! As A is regular and α has no component along y, the rows of y say that F vanishes along y at each stage.

use super::split::{Split, is_x};
use crate::error::{StartError, StepFailure};
use crate::memory::lasting;
use crate::methods::collocation::Collocation;
use crate::methods::collocation::stages::{Departure, NewtonStages, weighted};
use crate::methods::one_point::OnePoint;
use crate::methods::{Carries, Method, PreservedForm, Step, Tabulated, VariableStep, scheme};
use crate::scalar::norm;
use crate::scalar::passes::{divide, multiply};
use crate::solve::{Convergence, Guess, Stopping, from_either_guess};
use crate::space::Storing;
use crate::system::Regular;
use crate::{ProperlyDegenerate, Real, Space, System, Vector};

/// Gauss collocation of a degenerate Lagrangian in class ([`ProperlyDegenerate`]) with `S` stages, 1 ≤ `S` ≤
/// 4.
///
/// ```math
/// \alpha(Q_i) = p_0 + h \sum_j a_{ij} F_j, \quad Q_i = q_0 + h \sum_j a_{ij} V_j, \quad
/// F_j = \partial_q L(Q_j, V_j), \qquad \vartheta(q_1) = p_0 + h \sum_i b_i F_i
/// ```
///
/// The order is 2`S`, the method is symmetric, and it preserves Ω whether α is affine or not. With `S` = 1
/// it is [`OneStep::midpoint`](super::OneStep::midpoint). A step is solved by Newton's method for all stages
/// at once, with all second derivatives of L.
///
/// Out of class the same equations have order `S` only and preserve nothing; they are no method then.
///
/// ```
#[doc = include_str!("../../../docs/hidden/predators.txt")]
/// let mut run = Integrator::new(&Predators, OneStepGauss::<3>::new(), 0.1, start)?;
/// assert_eq!(run.method().order(), 6);
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OneStepGauss<const S: usize> {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<const S: usize> OneStepGauss<S> {
    /// The method with default options. A number of stages other than 1, 2, 3 or 4 does not compile.
    pub fn new() -> Self
    where
        Self: Tabulated,
    {
        Self::default()
    }
}

scheme! {
    [const S: usize] OneStepGauss<S>, |_|
    order: 2 * S,
    is_symmetric: true,
    preserved_form: PreservedForm::Omega,
}

/// What a run of a method with `STAGES` stages carries.
#[derive(Debug)]
pub struct OneStepGaussMemory<const STAGES: usize, S: System, T: Real> {
    /// With the velocities V of each stage. α is zero along y.
    point: OnePoint<S, T, STAGES>,
    split: Split<S, T>,
    stages: NewtonStages<STAGES, S, T>,
    zero: Vector<S, T>,
    /// The end of the step, and halfway to it.
    next: Vector<S, T>,
    momentum: Vector<S, T>,
    middle: Vector<S, T>,
}

lasting!([const STAGES: usize, S: System, T: Real] OneStepGaussMemory<STAGES, S, T>, T; part point);

impl<const STAGES: usize, S: System, T: Real> Carries<S, T> for OneStepGauss<STAGES> {
    type Memory = OneStepGaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> Method<S, T> for OneStepGauss<STAGES> {
    type Suited<X> = <S as ProperlyDegenerate<T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, _: &[T], t: T, _: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let [zero, next, momentum, middle] = system.space().vectors();
        Ok(OneStepGaussMemory {
            point: OnePoint::new(system, q, t, |rates| core::array::from_fn(|_| rates.clone()))?,
            split: Split::new(system),
            stages: NewtonStages::new(system, [q, &[]], t, Storing::Always),
            zero,
            next,
            momentum,
            middle,
        })
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let (Step { system, q, t, h, statistics }, stopping) = (step, self.stopping);
        let OneStepGaussMemory { point, split, stages, zero, next, momentum, middle } = memory;
        from_either_guess(|guess: Guess| {
            let OnePoint { p, rates, orientation } = &mut *point;
            rates.guess(h, guess, stages.increments.each_mut());
            stages.increments.iter_mut().for_each(|w| multiply(w, h));
            let (from, search) = (Departure { q: [q, zero], p: [p, zero], t, h }, (guess, stopping));
            // Between two branches Ω changes its sign.
            stages.solve::<Regular>(system, from, search, statistics, |_, time, node, _, _| {
                orientation.compare(system, &node.point, time)
            })?;
            let NewtonStages { tableau: Collocation { b, .. }, increments, forces, .. } = &*stages;
            for i in 0..q.len() {
                next[i] = q[i] + weighted(b, increments, i);
                let kick = if is_x(system, i) { h * weighted(b, forces, i) } else { T::lift(0.0) };
                momentum[i] = p[i] + kick;
            }
            split.solve_y::<Convergence<T>>(system, next, t + h, momentum, stopping, statistics)?;
            norm::finite(next)?;
            norm::mean(q, next, middle);
            orientation.pass(system, &[(middle, t + T::lift(0.5) * h)], (next, t + h))
        })?;
        stages.increments.iter_mut().for_each(|w| divide(w, h));
        point.arrive(q, (next, momentum), h, stages.increments.each_ref());
        Ok(())
    }
}

impl<const STAGES: usize, S: ProperlyDegenerate<T>, T: Real> VariableStep<S, T> for OneStepGauss<STAGES> {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
