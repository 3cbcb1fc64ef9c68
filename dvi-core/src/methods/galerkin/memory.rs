//! What a run with interior displacements carries from step to step.

use super::Step;
use super::coefficients::{Coefficients, differentiation};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::quadrature::Quadrature;
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::mechanics::phase::{Arrival, Increments, Inertial, PhasePoint};
use crate::scalar::norm;
use crate::solve::{Ladder, Solver};
use crate::state::Statistics;
use crate::state::history::History;
use crate::state::memory::{Memory, lasting};
use crate::{Coupled, Lagrangian, NondegenerateLagrangian, Real, Space, System, Vector};

/// The phase point of a run with interior displacements, its path between the points and its work space.
#[derive(Debug)]
pub struct GalerkinMemory<const NODES: usize, S: System, T: Real> {
    pub(super) ladder: Ladder<Coupled<NODES, S, T>>,
    pub(super) path: Path<NODES, S, T>,
}

/// Where the run is, and how it goes on from there.
#[derive(Debug)]
pub(super) struct Path<const NODES: usize, S: System, T: Real> {
    pub(super) rule: Quadrature,
    differentiation: [[f64; NODES]; NODES],
    pub(super) coefficients: Coefficients<NODES, T>,
    /// The frequencies at both ends of the step.
    ends: [Local<S, T>; 2],
    pub(super) phase: PhasePoint<S, T>,
    pub(super) inertial: Inertial<S, T>,
    /// δ/h² of each interior node, of the last steps; the first and the last entry are not used.
    displacements: [History<S, T>; NODES],
    pub(super) work: Work<NODES, S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<const NODES: usize, S: System, T: Real> {
    /// q0, the displacements of the interior nodes, and Δ.
    pub(super) unknowns: [Vector<S, T>; NODES],
    /// (D₁ + D₂)L_d, ∂L_d/∂δ of the interior nodes, and p0 + D₁L_d; then the corrections of the unknowns.
    pub(super) residuals: [Vector<S, T>; NODES],
    pub(super) point: Vector<S, T>,
    pub(super) velocity: Vector<S, T>,
    /// ∂L/∂q at a node.
    pub(super) gradient: Vector<S, T>,
    /// ∂L/∂v at a node, or p1.
    pub(super) momentum: Vector<S, T>,
    pub(super) next: Vector<S, T>,
    /// ∂L/∂q at q1.
    pub(super) next_force: Vector<S, T>,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real> GalerkinMemory<NODES, S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.path.phase.p
    }

    pub(super) fn new<F: FrequencyIn<T>>(
        step: &Step<'_, NODES, S, F, T>,
        q: &Vector<S, T>,
        v: &[T],
    ) -> Result<Self, StartError> {
        let Step { system, method, t, .. } = *step;
        let rule = Quadrature::lobatto_of::<NODES>();
        let a = differentiation(&rule);
        let solver = match method.solver.in_numbers::<T>() {
            // Any L has no fixed point.
            Solver::Automatic if !S::SEPARABLE => Solver::Newton,
            solver => solver,
        };
        let reading = method.frequency.reading();
        let mut path = Path {
            rule,
            differentiation: a,
            coefficients: Coefficients::new(&rule, &a, T::lift(0.0)).map_err(StartError::Starter)?,
            ends: [Local::new(system, reading), Local::new(system, reading)],
            phase: PhasePoint::new(system, q, v, t, method.summation)?,
            inertial: Inertial::new(system, q, v, t)?,
            displacements: core::array::from_fn(|_| History::new(system, None)),
            work: Work::new(system),
        };
        if reading.is_none() {
            path.fit(method.frequency.fixed(0) * step.h).map_err(StartError::Starter)?;
        }
        let ladder = Ladder::new(solver, || coupled_by_second_derivatives(system, q, v, t, solver.storing()));
        Ok(Self { ladder, path })
    }
}

impl<const NODES: usize, S: System, T: Real> Memory<T> for GalerkinMemory<NODES, S, T> {
    lasting!(T; part path, part ladder);
}

impl<const NODES: usize, S: System, T: Real> Memory<T> for Path<NODES, S, T> {
    lasting!(T; part phase, part inertial, parts displacements);
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real> Path<NODES, S, T> {
    /// Sets `v` to the velocity at the present point.
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.inertial.velocity(system, &self.phase, q, t, v)
    }

    /// Sets the unknowns to their guess: extrapolated from the steps before if they had about this length; else
    /// the path is straight, and its velocity is taken from the momentum if L is separable.
    #[inline(always)]
    pub(super) fn guess<F>(&mut self, step: &Step<'_, NODES, S, F, T>, q: &[T]) {
        let similar = self.phase.extrapolates_to(step.h);
        let [start, interior @ .., increment] = &mut self.work.unknowns[..] else { return };
        start.copy_from_slice(q);
        for (displacement, history) in interior.iter_mut().zip(&self.displacements[1..]) {
            if similar {
                history.extrapolate(displacement);
                scale(displacement, step.h * step.h);
            } else {
                displacement.fill(T::lift(0.0));
            }
        }
        self.phase.guess(self.inertial.constant(), &self.phase.p, step.h, increment);
    }

    /// max|q0| + max|Δ|, by which errors are measured.
    #[inline(always)]
    pub(super) fn scale(&self) -> T {
        norm::largest(&self.work.unknowns[0]) + norm::largest(&self.work.unknowns[NODES - 1])
    }

    /// The coefficients for the frequency at the current unknowns.
    #[inline(always)]
    pub(super) fn read_frequency<F: FrequencyIn<T>>(
        &mut self,
        step: &Step<'_, NODES, S, F, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let frequency = &step.method.frequency;
        let ([start, end], Some(mass), Some(_)) =
            (&mut self.ends, self.inertial.constant(), frequency.reading())
        else {
            return self.fit(frequency.fixed(0) * step.h);
        };
        let Work { unknowns, velocity, next, next_force, .. } = &mut self.work;
        let (q, increment, per_h) = (&unknowns[0], &unknowns[NODES - 1], T::lift(1.0) / step.h);
        for i in 0..q.len() {
            next[i] = q[i] + increment[i];
            velocity[i] = increment[i] * per_h;
        }
        step.system.force(next, &[], step.node_time(1.0), next_force);
        statistics.gradients += 1;
        start.evaluate(frequency, mass, q, velocity, &self.phase.force)?;
        end.evaluate(frequency, mass, next, velocity, next_force)?;
        let omega = T::lift(0.5) * (start.omega + end.omega);
        self.fit(omega * step.h)
    }

    /// Makes the coefficients those for `u` = ωh, if they are not.
    #[inline(always)]
    fn fit(&mut self, u: T) -> Result<(), StepFailure> {
        if !self.coefficients.is_for(u) {
            self.coefficients = Coefficients::new(&self.rule, &self.differentiation, u)?;
        }
        Ok(())
    }

    /// Moves to `work.next`, `work.momentum` and `work.next_force` at the time `end`, if they are numbers and the mass
    /// matrix has kept its orientation. The increments are the last of the unknowns, and the first of the residuals.
    #[inline(always)]
    pub(super) fn complete(
        &mut self,
        system: &S,
        [h, end]: [T; 2],
        q: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        let Work { next, momentum, next_force, velocity, unknowns, residuals, .. } = &mut self.work;
        let by = Increments { q: &unknowns[NODES - 1], p: &residuals[0] };
        norm::finite(next).and(norm::finite(momentum))?;
        self.inertial.check(system, [next, by.q], [end, h], velocity)?;
        let similar = self.phase.extrapolates_to(h);
        self.phase.advance(q, &Arrival { q: next, p: momentum, force: next_force }, by, h)?;
        let per_h = T::lift(1.0) / h;
        for (history, displacement) in self.displacements.iter_mut().zip(unknowns).take(NODES - 1).skip(1) {
            if !similar {
                history.clear();
            }
            history.push_scaled(displacement, per_h * per_h);
        }
        Ok(())
    }
}

#[inline(always)]
fn scale<T: Real>(x: &mut [T], factor: T) {
    for x in x {
        *x *= factor;
    }
}

impl<const NODES: usize, S: Lagrangian<T>, T: Real> Work<NODES, S, T> {
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            unknowns: core::array::from_fn(|_| vector()),
            residuals: core::array::from_fn(|_| vector()),
            point: vector(),
            velocity: vector(),
            gradient: vector(),
            momentum: vector(),
            next: vector(),
            next_force: vector(),
        }
    }
}
