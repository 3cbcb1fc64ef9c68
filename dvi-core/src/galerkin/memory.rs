//! What a run with interior displacements carries from step to step.

use super::Step;
use super::coefficients::{Coefficients, differentiation};
use crate::error::{StartError, StepFailure};
use crate::frequency::{FrequencyIn, Local};
use crate::history::{History, is_similar};
use crate::legendre::Legendre;
use crate::mass::Mass;
use crate::orientation::MassOrientation;
use crate::quadrature::Quadrature;
use crate::solver::Solver;
use crate::statistics::Statistics;
use crate::{Lagrangian, Matrix, Permutation, Real, RegularLagrangian, Space, Vector, norm};

/// The momentum of a run with interior displacements, its guesses and its work space.
#[derive(Debug)]
pub struct GalerkinMemory<const NODES: usize, S: Lagrangian, T: Real> {
    pub(super) rule: Quadrature,
    differentiation: [[f64; NODES]; NODES],
    pub(super) coefficients: Coefficients<NODES, T>,
    /// The frequencies at both ends of the step.
    ends: [Local<S, T>; 2],
    /// p at the current point.
    pub(super) p: Vector<S, T>,
    /// ∂L/∂q at the current point; kept if L is separable.
    pub(super) force: Vector<S, T>,
    /// Kept if L is separable.
    pub(super) mass: Option<Mass<S, T>>,
    /// Kept if L is not separable.
    orientation: Option<MassOrientation<S, T>>,
    /// δ/h² of each interior node and Δ/h, of the last steps; entry 0 is not used.
    histories: [History<S, T>; NODES],
    /// The length of the step before; zero before the first.
    last_step: T,
    /// Kept unless the solver is the fixed point.
    pub(super) newton: Option<Newton<NODES, S, T>>,
    /// How many steps Newton takes before the fixed point is tried again.
    pub(super) newton_steps: u32,
    pub(super) work: Work<NODES, S, T>,
}

/// Storage for the Newton matrix.
#[derive(Debug)]
pub(super) struct Newton<const NODES: usize, S: Lagrangian, T: Real> {
    /// The block of equation r and unknown k, transposed, in row r and column k, both from 1. Row 0 begins with
    /// ∂²L/∂q∂q, ∂²L/∂q∂v and ∂²L/∂v∂v of a node.
    pub(super) blocks: [[Matrix<S, T>; NODES]; NODES],
    pub(super) permutation: Permutation<S>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<const NODES: usize, S: Lagrangian, T: Real> {
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

impl<const NODES: usize, S: RegularLagrangian, T: Real> GalerkinMemory<NODES, S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.p
    }

    pub(super) fn new<F: FrequencyIn<T>>(
        step: &Step<'_, NODES, S, F, T>,
        q: &Vector<S, T>,
        v: &[T],
    ) -> Result<Self, StartError> {
        let Step { system, method, t, .. } = *step;
        let space = system.space();
        let [mut force, mut p, mut mean]: [Vector<S, T>; 3] = core::array::from_fn(|_| space.vector());
        system.gradient(q, v, t, &mut force, &mut p);
        norm::finite(&p).and(norm::finite(&force)).map_err(StartError::Starter)?;
        let mass = S::SEPARABLE.then(|| Mass::new(system, q, t)).transpose().map_err(StartError::Starter)?;
        let orientation = (!S::SEPARABLE).then(|| MassOrientation::new(system, q, v, t));
        let orientation = orientation.transpose().map_err(StartError::Starter)?;
        mean.copy_from_slice(v);
        let rule = Quadrature::lobatto(NODES)?;
        let a = differentiation(&rule);
        let mut histories = core::array::from_fn(|_| History::new(system, None));
        histories[NODES - 1] = History::new(system, Some(mean));
        let reading = method.frequency.reading();
        let mut memory = Self {
            rule,
            differentiation: a,
            coefficients: Coefficients::new(&rule, &a, T::lift(0.0)).map_err(StartError::Starter)?,
            ends: [Local::new(system, reading), Local::new(system, reading)],
            p,
            force,
            mass,
            orientation,
            histories,
            last_step: T::lift(0.0),
            newton: (method.solver != Solver::FixedPoint).then(|| Newton {
                blocks: core::array::from_fn(|_| core::array::from_fn(|_| space.matrix())),
                permutation: space.permutation(),
            }),
            newton_steps: 0,
            work: Work::new(system),
        };
        if reading.is_none() {
            memory.fit(method.frequency.fixed(0) * step.h).map_err(StartError::Starter)?;
        }
        Ok(memory)
    }

    /// Sets the unknowns to their guess: extrapolated from the steps before if they had about this length; else
    /// the path is straight, and its velocity is taken from the momentum if L is separable.
    #[inline(always)]
    pub(super) fn guess<F>(&mut self, step: &Step<'_, NODES, S, F, T>, q: &[T]) {
        let similar = is_similar(step.h, self.last_step);
        let [start, interior @ .., increment] = &mut self.work.unknowns[..] else { return };
        start.copy_from_slice(q);
        for (displacement, history) in interior.iter_mut().zip(&self.histories[1..]) {
            if similar {
                history.extrapolate(displacement);
                scale(displacement, step.h * step.h);
            } else {
                displacement.fill(T::lift(0.0));
            }
        }
        match &self.mass {
            Some(mass) if !similar => mass.solve(&self.p, increment),
            _ => self.histories[NODES - 1].extrapolate(increment),
        }
        scale(increment, step.h);
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
        let ([start, end], Some(mass), Some(_)) = (&mut self.ends, &self.mass, frequency.reading()) else {
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
        start.evaluate(frequency, mass, q, velocity, &self.force)?;
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
    /// matrix has kept its orientation.
    #[inline(always)]
    pub(super) fn complete(
        &mut self,
        system: &S,
        [h, end]: [T; 2],
        q: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        let Work { next, momentum, next_force, velocity, unknowns, .. } = &mut self.work;
        norm::finite(next).and(norm::finite(momentum))?;
        if let Some(orientation) = &mut self.orientation {
            velocity.copy_from_slice(&unknowns[NODES - 1]);
            scale(velocity, T::lift(1.0) / h);
            orientation.check(system, next, velocity, end)?;
        }
        if S::SEPARABLE {
            norm::finite(next_force)?;
            self.force.copy_from_slice(next_force);
        }
        q.copy_from_slice(next);
        self.p.copy_from_slice(momentum);
        let similar = is_similar(h, self.last_step);
        self.last_step = h;
        let per_h = T::lift(1.0) / h;
        for k in 1..NODES {
            if !similar {
                self.histories[k].clear();
            }
            let factor = if k == NODES - 1 { per_h } else { per_h * per_h };
            self.histories[k].push_scaled(&self.work.unknowns[k], factor);
        }
        Ok(())
    }

    /// Takes over all that the next step can depend on.
    pub(super) fn restore(&mut self, from: &Self) {
        self.p.copy_from_slice(&from.p);
        self.force.copy_from_slice(&from.force);
        if let (Some(orientation), Some(from)) = (&mut self.orientation, &from.orientation) {
            orientation.restore(from);
        }
        for (history, from) in self.histories.iter_mut().zip(&from.histories) {
            history.restore(from);
        }
        (self.last_step, self.newton_steps) = (from.last_step, from.newton_steps);
    }

    /// Sets `v` to the velocity with ∂L/∂v = p.
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        if let Some(mass) = &self.mass {
            mass.solve(&self.p, v);
            return Ok(());
        }
        self.histories[NODES - 1].extrapolate(v);
        Legendre::new(system).solve(system, q, &self.p, t, v)
    }
}

#[inline(always)]
fn scale<T: Real>(x: &mut [T], factor: T) {
    for x in x {
        *x *= factor;
    }
}

impl<const NODES: usize, S: Lagrangian, T: Real> Work<NODES, S, T> {
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
