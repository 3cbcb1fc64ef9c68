//! Newmark's method with γ = ½, which is variational in coordinates of its own.
//!
//! x1 = x0 + h v0 + h²[(½ − β) a0 + β a1]      v1 = v0 + (h/2)(a0 + a1)      a = M⁻¹F(x, t), F = −∇V
//!
//! In q = x − βh² a(x) this is Störmer–Verlet with the acceleration a(x), which as a function of q is that
//! of the potential Ṽ(q) = V(x) + ½βh² ∇V·M⁻¹∇V: dṼ = ∇V·(1 + βh² M⁻¹V″)dx = ∇V·dq. So the method is
//! symplectic, for dq ∧ dp (Kane, Marsden, Ortiz & West 2000, section 3.2; Newmark 1959). Here it is written
//! with momenta, as p½ = p0 + (h/2)F0, x1 = x0 + h M⁻¹[p½ + βh(F1 − F0)], p1 = p½ + (h/2)F1,
//!
//! which are the equations of the discrete Lagrangian in x divided by η′ᵀ, so that no second derivatives are
//! left in them. Of the increment Δ = x1 − x0 they are
//!
//! 0 = p0 + (h/2)F0 + βh(F1 − F0) − MΔ/h      p1 = p0 + (h/2)(F0 + F1)

use crate::discrete::{Interval, NodeWork};
use crate::error::{StartError, StepFailure};
use crate::methods::step::{Attempt, Begin, Equations, PhaseMemory, Share, set_force};
use crate::methods::{Carries, Here, Method, PreservedForm, Step, scheme};
use crate::scalar::norm::reported;
use crate::scalar::passes::subtract;
use crate::solve::{Solver, Stopping};
use crate::space::Sink;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::system::Same;
use crate::{Real, RegularLagrangian, Separable, System, Vector, Weights};

/// Newmark's method with γ = ½ for L = ½ v·M v − V(q, t): for [`Separable`] systems.
///
/// ```math
/// \begin{aligned}
/// q_1 &= q_0 + h v_0 + h^2 \left[ (\tfrac12 - \beta) a_0 + \beta a_1 \right] \\
/// v_1 &= v_0 + \tfrac{h}{2} (a_0 + a_1), \qquad\qquad a = -M^{-1} \nabla V(q, t)
/// \end{aligned}
/// ```
///
/// The method is symmetric and of order 2. With β = 0 it is Störmer–Verlet, and explicit. With β = ¼ it is
/// the average acceleration method, which is stable on linear oscillators at every step. With other β > 0 it
/// is implicit too, and stable on them for (¼ − β)(ωh)² < 1. An iteration evaluates ∂L/∂q once.
///
/// It preserves d(q − βh² a(q)) ∧ dp, a form that depends on h. Steps of different lengths would preserve
/// nothing, so the method is no [`VariableStep`](crate::methods::VariableStep) and cannot be composed.
/// Momenta of symmetries that act linearly are preserved in the form that they have at q − βh² a(q).
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - (100.0 * x).powi(2) / 2.0)]
/// struct Stiff;
///
/// // A hundred times the step up to which Störmer–Verlet is stable.
/// let start = StiffState { x: 1.0, dot_x: 0.0 };
/// let mut run = Integrator::new(&Stiff, Newmark::new(0.25), 2.0, start)?;
/// let energy = run.energy();
/// run.take_steps(1000)?;
/// assert!((run.energy() / energy - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newmark<T = f64> {
    /// β, from 0 to ½.
    pub beta: T,
    /// How steps are solved; of no concern for β = 0.
    pub solver: Solver,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Plain`].
    pub summation: Summation,
}

impl<T> Newmark<T> {
    /// The method with the parameter β; a run refuses one that is not in \[0, ½\].
    pub fn new(beta: T) -> Self {
        Self {
            beta,
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::default(),
        }
    }
}

impl<T: Real> Newmark<T> {
    /// Adds h[½F0 + β(F1 − F0)] to `r`.
    fn add_impulse(&self, h: T, [f0, f1]: [&[T]; 2], r: &mut [T]) {
        for ((r, &f0), &f1) in r.iter_mut().zip(f0).zip(f1) {
            *r += h * (T::lift(0.5) * f0 + self.beta * (f1 - f0));
        }
    }

    fn is_verlet(&self) -> bool {
        self.beta == T::lift(0.0)
    }
}

impl<S: Separable<T>, T: Real> Equations<S, T> for Newmark<T> {
    type Coefficients = ();

    fn begin(&mut self, _begin: &Begin<'_, S, T>, _node: &mut NodeWork<S, T>) -> Result<(), StepFailure> {
        Ok(())
    }

    fn evaluate(
        &mut self,
        Begin { system, interval, q, phase, .. }: &Begin<'_, S, T>,
        delta: &[T],
        share: Share<'_, T>,
        ((), NodeWork { point, gradient, .. }): (&mut (), &mut NodeWork<S, T>),
        to: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        match share {
            Share::Left => {
                let mut force: &[T] = &phase.force;
                if !self.is_verlet() {
                    phase.reach(q, delta, point);
                    set_force(*system, point, interval.time(T::lift(1.0)), gradient);
                    statistics.gradients += 1;
                    force = gradient;
                }
                self.add_impulse(interval.h, [&phase.force, force], to);
            }
            Share::Both { force } => {
                for ((sum, &f0), &f1) in to.iter_mut().zip(phase.force.iter()).zip(force) {
                    *sum += T::lift(0.5) * interval.h * (f0 + f1);
                }
            }
        }
        Ok(())
    }

    /// ∂r/∂Δ = −M/h + βh F1′
    fn linearize<K: Sink<T>>(
        &mut self,
        Begin { system, interval, q, phase, .. }: &Begin<'_, S, T>,
        delta: &[T],
        ((), node): (&mut (), &mut NodeWork<S, T>),
        r: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let NodeWork { point, velocity, gradient, momentum } = node;
        let (h, zero, per_h) = (interval.h, T::lift(0.0), T::lift(1.0) / interval.h);
        phase.reach(q, delta, point);
        for (v, &delta) in velocity.iter_mut().zip(delta) {
            *v = delta * per_h;
        }
        let weights = Weights { qq: self.beta * h, qv: zero, vq: zero, vv: -per_h };
        // ∂L/∂q and ∂L/∂v come along: F1 and MΔ/h.
        system.linearize(point, velocity, interval.time(T::lift(1.0)), weights, gradient, momentum, sink);
        self.add_impulse(h, [&phase.force, gradient], r);
        subtract(r, momentum);
        Ok(())
    }

    fn is_explicit(&self) -> bool {
        self.is_verlet()
    }
}

scheme! {
    [T: Real] Newmark<T>, |method|
    order: 2,
    is_symmetric: true,
    preserved_form: if method.is_verlet() { PreservedForm::Canonical } else { PreservedForm::Conjugate },
}

impl<S: System, T: Real> Carries<S, T> for Newmark<T> {
    type Memory = PhaseMemory<S, T>;
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> Method<S, T> for Newmark<T> {
    type Suited<X> = <S as Separable<T>>::Suited<<<S as RegularLagrangian<T>>::Suited<X> as Same<X>>::As>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        let in_range = self.beta >= T::lift(0.0) && self.beta <= T::lift(0.5);
        StartError::unless(in_range, "beta", reported(self.beta), "0 <= beta <= 1/2")?;
        self.stopping.validate()?;
        let solver = if self.is_verlet() { Solver::FixedPoint } else { self.solver.in_numbers::<T>() };
        PhaseMemory::new(system, (q, v, t), (solver, self.summation), ())
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let PhaseMemory { carried, ladder, .. } = memory;
        let (Self { stopping, summation, .. }, interval) = (*self, Interval { t, h });
        Attempt { system, interval, stopping, summation, q, carried }.take(
            &mut { *self },
            ladder,
            statistics,
        )
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }
}
