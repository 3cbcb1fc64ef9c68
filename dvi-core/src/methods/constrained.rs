//! The step of a discrete Lagrangian with constraints.

mod memory;
mod reduced;
mod step;

use crate::discrete::quadrature::{Quadrature, Rule, Trapezoid};
use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::consistent::check;
use crate::mechanics::constraints::{ConstrainedLagrangian, Constraints};
#[cfg(doc)]
use crate::methods::Scheme;
use crate::methods::{Carries, Clock, Here, Method, PreservedForm, Step, Steps, VariableStep, scheme};
use crate::solve::Stopping;
use crate::system::start::evaluate;
use crate::{Real, Vector};

use memory::ConstrainedMemory;

/// The step of a quadrature rule with linear interpolation, as that of
/// [`Variational`](crate::methods::Variational), for systems with constraints, of positions by `constraint =
/// …` or of velocities by `nonholonomic = …`. What watches the steps goes around it, as in `EnergyLimit {
/// method: Constrained::new(Midpoint), limit }`.
///
/// ```math
/// p_0 = -D_1 L_d(q_0, q_1) - A(q_0)^\mathsf{T} \iota_0, \qquad p_1 = D_2 L_d(q_0, q_1) + A(q_1)^\mathsf{T} \iota_1
/// ```
///
/// The impulses ι are those of the constraints at the two ends of the step, one number for each; p1 =
/// ∂L/∂v(q1, v1).
///
/// | constraints | A | q1 and ι0 | v1 and ι1 |
/// |---|---|---|---|
/// | g(q, t) = 0 | ∂g/∂q | g(q1, t1) = 0 | A(q1) v1 + ∂g/∂t = 0 |
/// | A(q, t) v + b(q, t) = 0 | A | A Δ + h b = 0 at (q0 + Δ/2, t + h/2) | A(q1) v1 + b(q1) = 0 |
///
/// So positions are on holonomic constraints and velocities agree with both, to rounding errors. With the
/// trapezoidal rule and holonomic constraints this is RATTLE (Andersen 1983), with the positions of SHAKE
/// (Ryckaert, Ciccotti & Berendsen 1977). With nonholonomic constraints it is the discrete principle of
/// Lagrange and d'Alembert (Cortés & Martínez 2001). Each step is solved by Newton's method for q1 and ι0
/// together; along a chain its equations are banded. RATTLE with up to ten constraints and a separable L, as
/// [`Rattle`], evaluates the force once and no second derivative of L: its equations are those for ι0 alone,
/// with a full matrix. A run that begins where a coordinate is light against others, or where the
/// constraints leave several coordinates no way to move, as six rods and more that hang in a line, solves
/// for all.
///
/// On holonomic constraints the steps preserve dq ∧ dp, and the momentum maps of symmetries that act
/// linearly and leave L and g as they are (Marsden & West 2001, section 3.5.2; Wendlandt & Marsden 1997).
/// With nonholonomic ones neither the motion nor the steps preserve a two-form or, as a rule, momenta,
/// whatever [`preserved_form`](Scheme::preserved_form) says, which knows the method only; symmetric steps
/// are reversible. In a chaotic motion the energy of a nonholonomic run may drift: [what can go
/// wrong](crate::guide::what_can_go_wrong) measures one. The order is that of the rule, 1 or 2; a
/// [`Composition`](crate::methods::Composition) of symmetric steps has a higher one. A run begins at a state
/// that the constraints admit: [`projected`](crate::mechanics::OnConstraints::projected) finds one.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A mass on a rod.
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - g * y,
///     constraint = x * x + y * y - length * length,
/// )]
/// struct Pendulum {
///     g: f64,
///     length: f64,
/// }
///
/// let pendulum = Pendulum { g: 9.81, length: 1.0 };
/// let start = PendulumState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
/// let mut run = Integrator::new(&pendulum, Constrained::new(Trapezoid), 0.01, start)?;
/// run.take_steps(10_000)?;
/// let PendulumState { x, y, dot_x, dot_y } = run.state();
/// assert!((x * x + y * y - 1.0).abs() < 1e-14);
/// assert!((x * dot_x + y * dot_y).abs() < 1e-14);
/// assert!(run.energy().abs() < 1e-3 * 9.81);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constrained<R> {
    /// Nodes and weights.
    pub rule: R,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

/// RATTLE (Andersen 1983), the step of the trapezoidal rule with constraints.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Two masses on a rigid rod, in the plane.
/// #[lagrangian(
///     coordinates(x[2], y[2]),
///     lagrangian = sum(0..2, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
///     constraint = (x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2) - 1.0,
/// )]
/// struct Dumbbell;
///
/// let start = DumbbellState { x: [0.0, 1.0], y: [0.0; 2], dot_x: [0.0; 2], dot_y: [0.0, 1.0] };
/// let mut run = Integrator::new(&Dumbbell, Rattle::default(), 0.01, start)?;
/// run.take_steps(1000)?;
/// // The centre of mass moves uniformly, and the ends around it.
/// assert!((run.state().y.iter().sum::<f64>() / 2.0 - 5.0).abs() < 1e-12);
/// let tension: Vec<f64> = run.memory().multipliers().collect();
/// assert!((tension[0] + 0.25).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Rattle = Constrained<Trapezoid>;

impl<R: Rule> Constrained<R> {
    /// Any rule.
    pub fn new(rule: R) -> Self {
        Self { rule, stopping: Stopping::default() }
    }
}

scheme! {
    [R: Rule] Constrained<R>, |method|
    order: if method.rule.is_exact_for_linear() { 2 } else { 1 },
    is_symmetric: method.rule.is_symmetric(),
    preserved_form: PreservedForm::Canonical,
}

impl<S: ConstrainedLagrangian<T>, R, T: Real> Carries<S, T> for Constrained<R> {
    type Memory = ConstrainedMemory<S, R, T>;
}

impl<S: ConstrainedLagrangian<T>, R: Rule, T: Real> Method<S, T> for Constrained<R> {
    type Suited<X> = <S as ConstrainedLagrangian<T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        Quadrature::new(self.rule.nodes(), self.rule.weights())?;
        self.stopping.validate()?;
        evaluate(system, q, v, t)?;
        check(system, [q, v], t, Some((h, self.stopping.tolerance)))?;
        let mut memory = ConstrainedMemory::new(system, self.rule, [q, v], t)?;
        if S::SEPARABLE && R::TRAPEZOIDAL && S::Kind::OF_POSITIONS {
            memory.reduce(system, [q, v], t);
        }
        Ok(memory)
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        if S::SEPARABLE && R::TRAPEZOIDAL && S::Kind::OF_POSITIONS {
            let one = Steps { system, q, clock: Clock::new(t, h), count: 1, statistics };
            if memory.stride(one, self.stopping) == Some(1) {
                return Ok(());
            }
        }
        memory.take(Step { system, q, t, h, statistics }, self.stopping)
    }

    #[inline]
    fn steps(&self, steps: Steps<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Steps { system, q, clock, count, statistics } = steps;
        let (mut taken, mut strides) = (0, true);
        while taken < count {
            if S::SEPARABLE && R::TRAPEZOIDAL && S::Kind::OF_POSITIONS && strides {
                let (clock, count) = (clock.after(taken), count - taken);
                let more = memory.stride(Steps { system, q, clock, count, statistics }, self.stopping);
                // What leads to no number is taken again step by step, to see where it arises.
                strides = more.is_some();
                taken += more.unwrap_or(0);
                statistics.steps += more.unwrap_or(0);
            }
            if taken < count {
                let (t, h) = (clock.after(taken).time(), clock.step_size());
                self.step(Step { system, q, t, h, statistics }, memory)?;
                taken += 1;
                statistics.steps += 1;
            }
        }
        Ok(())
    }

    fn velocity(&self, _: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        memory.velocity(v);
        Ok(())
    }
}

impl<S: ConstrainedLagrangian<T>, R: Rule, T: Real> VariableStep<S, T> for Constrained<R> {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
