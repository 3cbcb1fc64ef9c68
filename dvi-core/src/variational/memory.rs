//! What a run of the quadrature family carries from step to step.

use super::coefficients::{Adjustable, Each, Uniform};
use super::{Step, Variational};
use crate::error::{StartError, StepFailure};
use crate::frequency::{FrequencyIn, Local};
use crate::history::{History, is_similar};
use crate::legendre::Legendre;
use crate::mass::Mass;
use crate::orientation::MassOrientation;
use crate::quadrature::Rule;
use crate::solver::Solver;
use crate::{Lagrangian, Matrix, Real, RegularLagrangian, Space, Vector, norm};

/// The momentum of a run of the quadrature family, its guesses and its work space.
#[derive(Debug)]
pub struct VariationalMemory<S: Lagrangian, T: Real> {
    pub(super) interpolation: Interpolation<S, T>,
    /// The frequencies at both ends of the step.
    pub(super) ends: [Local<S, T>; 2],
    pub(super) motion: Motion<S, T>,
    pub(super) work: Work<S, T>,
}

/// The latest coefficients of the interpolation.
#[derive(Debug)]
pub(super) enum Interpolation<S: Lagrangian, T: Real> {
    Uniform(Uniform<T>),
    Each(Each<S, T>),
}

/// Where a run is, how it got there, and work space.
#[derive(Debug)]
pub(super) struct Motion<S: Lagrangian, T: Real> {
    /// p at the current point.
    pub(super) p: Vector<S, T>,
    /// ∂L/∂q at the current point; kept if L is separable.
    pub(super) force: Vector<S, T>,
    /// Kept if L is separable.
    pub(super) mass: Option<Mass<S, T>>,
    /// Kept if L is not separable.
    pub(super) orientation: Option<MassOrientation<S, T>>,
    /// The mean velocities Δ/h of the last steps.
    pub(super) history: History<S, T>,
    /// The length of the step before; zero before the first.
    pub(super) last_step: T,
    /// Storage for the Newton matrix and for one term of it.
    pub(super) newton: Option<[Matrix<S, T>; 2]>,
    /// How many steps Newton takes before the fixed point is tried again.
    pub(super) newton_steps: u32,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<S: Lagrangian, T: Real> {
    pub(super) increment: Vector<S, T>,
    pub(super) next: Vector<S, T>,
    pub(super) point: Vector<S, T>,
    pub(super) velocity: Vector<S, T>,
    /// ∂L/∂q at a node.
    pub(super) gradient: Vector<S, T>,
    /// ∂L/∂v at a node, or p1.
    pub(super) momentum: Vector<S, T>,
    /// The residual, then the correction.
    pub(super) trial: Vector<S, T>,
    pub(super) d1: Vector<S, T>,
    pub(super) d2: Vector<S, T>,
}

impl<S: RegularLagrangian, T: Real> VariationalMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.motion.p
    }

    pub(super) fn new<F: FrequencyIn<T>, R: Rule>(
        system: &S,
        method: &Variational<F, R>,
        q: &Vector<S, T>,
        v: &[T],
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let space = system.space();
        let vector = || space.vector();
        let [mut force, mut p]: [Vector<S, T>; 2] = [vector(), vector()];
        system.gradient(q, v, t, &mut force, &mut p);
        norm::finite(&p).and(norm::finite(&force)).map_err(StartError::Starter)?;
        let mass = S::SEPARABLE.then(|| Mass::new(system, q, t)).transpose().map_err(StartError::Starter)?;
        let orientation = (!S::SEPARABLE).then(|| MassOrientation::new(system, q, v, t));
        let orientation = orientation.transpose().map_err(StartError::Starter)?;
        let explicit = method.needs_forces_only::<S>() && method.is_explicit();
        let newton =
            (!explicit && method.solver != Solver::FixedPoint).then(|| [space.matrix(), space.matrix()]);
        let reading = method.frequency.reading();
        let mut mean = vector();
        mean.copy_from_slice(v);
        let mut interpolation = if F::PER_COORDINATE {
            Interpolation::Each(Each::new(system))
        } else {
            Interpolation::Uniform(Uniform::linear(&method.rule))
        };
        if reading.is_none() {
            interpolation.fix(&Step { system, method, t, h }).map_err(StartError::Starter)?;
        }
        let motion = Motion {
            p,
            force,
            mass,
            orientation,
            history: History::new(system, Some(mean)),
            last_step: T::lift(0.0),
            newton,
            newton_steps: 0,
        };
        let ends = [Local::new(system, reading), Local::new(system, reading)];
        Ok(Self { interpolation, ends, motion, work: Work::new(system) })
    }
}

impl<S: Lagrangian, T: Real> Work<S, T> {
    #[inline(always)]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            increment: vector(),
            next: vector(),
            point: vector(),
            velocity: vector(),
            gradient: vector(),
            momentum: vector(),
            trial: vector(),
            d1: vector(),
            d2: vector(),
        }
    }
}

impl<S: RegularLagrangian, T: Real> Interpolation<S, T> {
    /// See [`Adjustable::fix`].
    pub(super) fn fix<F: FrequencyIn<T>, R: Rule>(
        &mut self,
        step: &Step<'_, S, F, R, T>,
    ) -> Result<(), StepFailure> {
        match self {
            Self::Each(each) => each.fix(step),
            Self::Uniform(uniform) => uniform.fix(step),
        }
    }
}

impl<S: RegularLagrangian, T: Real> Motion<S, T> {
    /// Sets `increment` to the guess of Δ for a step of length `h`: extrapolated from the steps before if they
    /// had about this length, and from the momentum elsewhere.
    #[inline(always)]
    pub(super) fn guess(&self, h: T, increment: &mut [T]) {
        match &self.mass {
            Some(mass) if !is_similar(h, self.last_step) => mass.solve(&self.p, increment),
            _ => self.history.extrapolate(increment),
        }
        for delta in increment {
            *delta *= h;
        }
    }

    /// Remembers a completed step of length `h` with this `increment`.
    #[inline(always)]
    pub(super) fn remember(&mut self, h: T, increment: &[T]) {
        if !is_similar(h, self.last_step) {
            self.history.clear();
        }
        self.last_step = h;
        self.history.push_scaled(increment, T::lift(1.0) / h);
    }

    /// Takes over all that the next step can depend on.
    pub(super) fn restore(&mut self, from: &Self) {
        self.p.copy_from_slice(&from.p);
        self.force.copy_from_slice(&from.force);
        if let (Some(orientation), Some(from)) = (&mut self.orientation, &from.orientation) {
            orientation.restore(from);
        }
        self.history.restore(&from.history);
        (self.last_step, self.newton_steps) = (from.last_step, from.newton_steps);
    }

    /// Sets `v` to the velocity with ∂L/∂v = p.
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        match &self.mass {
            Some(mass) => {
                mass.solve(&self.p, v);
                Ok(())
            }
            None => {
                self.history.extrapolate(v);
                Legendre::new(system).solve(system, q, &self.p, t, v)
            }
        }
    }
}
