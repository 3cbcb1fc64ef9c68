//! The step of a discrete Lagrangian with constraints:
//!
//! p0 = −D₁L_d(q0, q1) − A(q0)ᵀι0      p1 = D₂L_d(q0, q1) + A(q1)ᵀι1, with p1 = ∂L/∂v(q1, v1)
//!
//! for q1 and the impulses ι0 and ι1 of the constraints at both ends. Of constraints of positions, g(q, t) =
//! 0, A is ∂g/∂q, and g(q1) = 0 and A(q1) v1 + ∂g/∂t = 0; of those of velocities, A v + b = 0, what vanishes
//! is A Δ + h b in the middle of the step and A(q1) v1 + b.

mod impulses;

use crate::discrete::{Departing, DiscreteLagrangian, Ends, Interval, Span};
use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::consistent::{self, Among};
use crate::mechanics::constraints::turning::Gradients;
use crate::mechanics::constraints::{
    At, Bordered, ConstrainedLagrangian, ConstraintSolver, Constraints, OfStep, Tangent,
};
use crate::mechanics::orientation::MassOrientation;
use crate::memory::{Memory, lasting};
use crate::methods::InnerScheme;
use crate::methods::{Carries, Here, Method, PreservedForm, Scheme, Step, VariableStep};
use crate::scalar::norm;
use crate::solve::{AtIncrement, Due, Guess, Stopping, from_either_guess, newton, sizes};
use crate::state::Statistics;
use crate::state::rates::is_similar;
use crate::system::Same;
use crate::system::start::evaluate;
use crate::{ConstrainedSystem, Real, Scalar, Space, Vector};

pub(super) use impulses::Impulses;

/// The step of a variational method for systems with constraints, of positions by `constraint = …` or of
/// velocities by `nonholonomic = …`. The method is [`Variational`](crate::methods::Variational) with any
/// rule, fitted to a frequency that is given or not fitted. Its solver, its `stopping` and its summation
/// would have no effect here, and are errors of the start if they are not left at their defaults.
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
/// trapezoidal rule and holonomic constraints this is RATTLE (Andersen 1983), with the positions of SHAKE;
/// [`Rattle`](crate::methods::Rattle) takes the same steps faster where L is separable. With nonholonomic
/// constraints it is the discrete principle of Lagrange and d'Alembert (Cortés & Martínez 2001). Each step
/// is solved by Newton's method for q1 and ι0 together; along a chain its equations are banded.
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
/// let method = Constrained::new(Variational::trapezoid());
/// let mut run = Integrator::new(&pendulum, method, 0.01, start)?;
/// run.take_steps(10_000)?;
/// let PendulumState { x, y, dot_x, dot_y } = run.state();
/// assert!((x * x + y * y - 1.0).abs() < 1e-14);
/// assert!((x * dot_x + y * dot_y).abs() < 1e-14);
/// assert!(run.energy().abs() < 1e-3 * 9.81);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constrained<M> {
    /// What has a discrete Lagrangian.
    pub scheme: M,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<M> Constrained<M> {
    /// The method with default options.
    pub fn new(scheme: M) -> Self {
        Self { scheme, stopping: Stopping::default() }
    }
}

/// Where a constrained run is, what its next step is guessed from, and work space.
#[derive(Debug)]
pub struct ConstrainedMemory<S: ConstrainedSystem, L, T: Real> {
    here: Place<S, T>,
    /// Δ − h v0 of the last step, and h.
    bend: Vector<S, T>,
    last_step: T,
    /// Of constraints of positions.
    gradients: Option<Gradients<S, T>>,
    /// Whether the determinant of the equations for the velocity is positive.
    is_positive: bool,
    /// If the mass matrix depends on the state.
    orientation: Option<MassOrientation<S, T>>,
    l_d: L,
    solver: ConstraintSolver<S, T>,
    arrival: Arrival<S, T>,
}

/// The momentum and the velocity at a point of a run, and the impulses of the step that has led there.
#[derive(Debug)]
struct Place<S: ConstrainedSystem, T: Real> {
    p: Vector<S, T>,
    v: Vector<S, T>,
    impulses: Impulses<S, T>,
}

/// The end of a step as it is being found.
#[derive(Debug)]
struct Arrival<S: ConstrainedSystem, T: Real> {
    increment: Vector<S, T>,
    /// In which the iteration judges coordinates.
    weights: Vector<S, T>,
    q: Vector<S, T>,
    place: Place<S, T>,
    work: Vector<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    fn new(system: &S) -> Self {
        let [p, v] = system.space().vectors();
        Self { p, v, impulses: Impulses::new(system) }
    }
}

impl<S: ConstrainedSystem, L, T: Real> ConstrainedMemory<S, L, T> {
    /// The discrete momentum at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.here.p
    }

    /// The Lagrange multipliers λ of the last step, one for each constraint, so that G(q)ᵀλ is the force of
    /// the constraints. With a symmetric rule they are those in the middle of the step, to order h². Zero
    /// before the first.
    pub fn multipliers(&self) -> impl Iterator<Item = T> + '_ {
        self.here.impulses.over(self.last_step)
    }

    /// The impulses G(q)ᵀι of the constraints at the beginning and at the end of the last step, as numbers
    /// ι, one for each constraint.
    pub fn impulses(&self) -> [&[T]; 2] {
        let Impulses { first, last } = &self.here.impulses;
        [first, last]
    }
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Place<S, T> {
    lasting!(T; numbers p, numbers v, part impulses);
}

impl<S: ConstrainedSystem, L, T: Real> Memory<T> for ConstrainedMemory<S, L, T> {
    lasting!(T; part here, numbers bend, number last_step, part solver, parts gradients, parts orientation);
}

impl<M: Scheme> Scheme for Constrained<M> {
    fn order(&self) -> usize {
        self.scheme.order()
    }
    fn is_symmetric(&self) -> bool {
        self.scheme.is_symmetric()
    }
    fn preserved_form(&self) -> PreservedForm {
        self.scheme.preserved_form()
    }
}

impl<S: ConstrainedLagrangian<T>, T: Real, M: InnerScheme<S, T>> Carries<S, T> for Constrained<M> {
    type Memory = ConstrainedMemory<S, M::Inside, T>;
}

/// Where a step begins, and how it is solved.
struct Begin<'a, S, T> {
    system: &'a S,
    interval: Interval<T>,
    q: &'a [T],
    stopping: Stopping,
}

impl<S: ConstrainedLagrangian<T>, L: DiscreteLagrangian<S, T>, T: Real> ConstrainedMemory<S, L, T> {
    /// Sets Δ to a guess: that of the velocity, bent as in the step before. Newton's method finds the
    /// nearest of several solutions, so that no guess is extrapolated far.
    fn guess(&mut self, h: T, guess: Guess) {
        let Self { here: Place { v, impulses, .. }, bend, last_step, arrival, .. } = self;
        let ratio = match guess {
            Guess::Extrapolated if is_similar(h, *last_step) => h / *last_step,
            Guess::Extrapolated | Guess::Zero => T::lift(0.0),
        };
        for ((delta, &v), &bend) in arrival.increment.iter_mut().zip(v.iter()).zip(bend.iter()) {
            *delta = h * v + ratio * ratio * bend;
        }
        for (impulse, &last) in arrival.place.impulses.first.iter_mut().zip(impulses.first.iter()) {
            *impulse = ratio * last;
        }
    }

    /// Improves Δ and ι0 until q1 is on the constraints, and on the branch of the motion.
    fn solve(&mut self, begin: &Begin<'_, S, T>, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Begin { system, interval, q, stopping } = *begin;
        let Self { here: Place { p, .. }, l_d, solver, is_positive, gradients, arrival, .. } = self;
        let Arrival { increment, weights, q: next, place, work } = arrival;
        let impulse = &mut place.impulses.first;
        newton(stopping, statistics, |due, statistics| {
            due.prepare(system, weights, q, increment);
            statistics.linearizations += 1;
            statistics.factorisations += 1;
            let span = Span { system, interval, ends: Ends { q0: q, delta: increment } };
            let departing = &mut Departing { l_d, system, interval, q0: q };
            let upper = AtIncrement { equations: departing, p0: p, delta: increment, statistics };
            let lower = OfStep { span, work: [next, work] };
            let forces = Some(At { q, t: interval.t });
            let (multipliers, active) = (&**impulse, impulse.len());
            let equations = &mut Bordered { system, upper, lower, multipliers, forces, active };
            if *due == Due::Residual {
                let of = |k: usize| if k < q.len() { p[k] } else { T::lift(0.0) };
                let size = |k: usize| match k.checked_sub(q.len()) {
                    None => Scalar::abs(q[k]) + Scalar::abs(increment[k]),
                    Some(k) => impulse[k],
                };
                return solver.residual(equations, size, of);
            }
            solver.solve(equations, Scalar::abs(interval.h))?;
            solver.reduce(increment, impulse);
            Ok(sizes::largest(weights, solver.parts(q.len()).0))
        })?;
        for ((next, &q), &delta) in next.iter_mut().zip(q).zip(increment.iter()) {
            *next = q + delta;
        }
        norm::finite(next)?;
        // On the way from a step of no length the determinant of its equations changes its sign where
        // solutions meet.
        let is_odd = interval.h > T::lift(0.0) && (q.len() + impulse.len()) % 2 == 1;
        if solver.is_positive() != (*is_positive ^ is_odd) {
            return Err(StepFailure::Branch);
        }
        gradients.as_mut().map_or(Ok(()), |gradients| {
            gradients.check(system, q, increment, At { q: next, t: interval.time(T::lift(1.0)) })
        })
    }

    /// Finds p1 = p0 + (D₁ + D₂)L_d + G(q0)ᵀι0 + G(q1)ᵀι1 and v1.
    fn arrive(&mut self, begin: &Begin<'_, S, T>, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Begin { system, interval, q, .. } = *begin;
        let Self { here: Place { p: p0, .. }, l_d, solver, arrival, orientation, .. } = self;
        let Arrival { increment, q: next, place, work, .. } = arrival;
        let Place { p, v, impulses: Impulses { first, last } } = place;
        p.fill(T::lift(0.0));
        work.fill(T::lift(0.0));
        let span = Span { system, interval, ends: Ends { q0: q, delta: increment } };
        l_d.derivatives(span, work, p, statistics)?;
        solver.add_impulse(system, At { q, t: interval.t }, first, p);
        for ((p, &p0), (v, &delta)) in p.iter_mut().zip(p0.iter()).zip(v.iter_mut().zip(increment.iter())) {
            *p += p0;
            *v = delta / interval.h;
        }
        let at = At { q: next, t: interval.time(T::lift(1.0)) };
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        solver.tangent(system, at, Tangent { p, v, impulse: last, work })?;
        orientation.as_mut().map_or(Ok(()), |orientation| orientation.check(system, next, v, at.t))
    }

    /// Moves to the end of the step.
    fn keep(&mut self, q: &mut [T], h: T) {
        let Self { here, bend, last_step, gradients, arrival, .. } = self;
        for ((bend, &delta), &v) in bend.iter_mut().zip(arrival.increment.iter()).zip(here.v.iter()) {
            *bend = delta - h * v;
        }
        if let Some(gradients) = gradients {
            gradients.keep();
        }
        q.copy_from_slice(&arrival.q);
        here.restore(&arrival.place);
        *last_step = h;
    }
}

/// `X` if `S` has constraints, and unknown if it has none: rustc asks nothing of the scheme then.
type IfConstrained<S, X, T> = <<S as ConstrainedLagrangian<T>>::Suited<X> as Same<X>>::As;

impl<S: ConstrainedLagrangian<T>, T: Real, M> Method<S, T> for Constrained<M>
where
    IfConstrained<S, M, T>: InnerScheme<S, T>,
{
    type Suited<X> = <IfConstrained<S, M, T> as InnerScheme<S, T>>::Suited<IfConstrained<S, X, T>>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        self.scheme.admit(system)?;
        let l_d = self.scheme.inside(system)?;
        evaluate(system, q, v, t)?;
        consistent::check(system, [q, v], t, Among::Steps { h, tolerance: self.stopping.tolerance })?;
        let [bend, increment, weights, next, mut work] = system.space().vectors();
        let (mut here, mut solver) = (Place::new(system), ConstraintSolver::new(system, q, v, t));
        let Place { p, v: velocity, impulses: Impulses { last: impulse, .. } } = &mut here;
        system.gradient(q, v, t, &mut work, p);
        velocity.copy_from_slice(v);
        let tangent = Tangent { p, v: velocity, impulse, work: &mut work };
        solver.tangent(system, At { q, t }, tangent).map_err(StartError::Starter)?;
        impulse.fill(T::lift(0.0));
        let orientation = (!S::CONSTANT_MASS).then(|| MassOrientation::new(system, q, v, t));
        Ok(ConstrainedMemory {
            here,
            bend,
            last_step: T::lift(0.0),
            gradients: S::Kind::OF_POSITIONS.then(|| Gradients::new(system, At { q, t }, v)),
            is_positive: solver.is_positive(),
            orientation: orientation.transpose().map_err(StartError::Starter)?,
            l_d,
            solver,
            arrival: Arrival { increment, weights, q: next, place: Place::new(system), work },
        })
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let begin = Begin { system, interval: Interval { t, h }, q, stopping: self.stopping };
        from_either_guess(|guess| {
            memory.guess(h, guess);
            memory.solve(&begin, statistics)
        })?;
        memory.arrive(&begin, statistics)?;
        memory.keep(q, h);
        Ok(())
    }

    fn velocity(
        &self,
        _here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        v.copy_from_slice(&memory.here.v);
        Ok(())
    }
}

impl<S: ConstrainedLagrangian<T>, T: Real, M> VariableStep<S, T> for Constrained<M>
where
    IfConstrained<S, M, T>: InnerScheme<S, T>,
{
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}
