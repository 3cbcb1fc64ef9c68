//! Where a constrained run is.

use super::reduced::Reduced;
use crate::discrete::{DiscreteLagrangian, Rule};
use crate::error::StartError;
use crate::mechanics::constraints::turning::Gradients;
use crate::mechanics::constraints::{
    At, ConstrainedLagrangian, ConstraintSolver, Constraints, Multipliers, Tangent,
};
use crate::mechanics::orientation::MassOrientation;
use crate::memory::{Aside, lasting};
use crate::methods::Steps;
use crate::solve::Stopping;
use crate::{ConstrainedSystem, Real, Space, Vector};

/// Where a constrained run is, what its next step is guessed from, and work space.
#[derive(Debug)]
pub struct ConstrainedMemory<S: ConstrainedSystem, R, T: Real> {
    pub(super) here: Place<S, T>,
    /// Δ − h v0 of the last step, and h.
    pub(super) bend: Vector<S, T>,
    pub(super) last_step: T,
    /// Of constraints of positions.
    pub(super) gradients: Option<Gradients<S, T>>,
    /// Whether the determinant of the equations for the velocity is positive.
    pub(super) is_positive: bool,
    /// If the mass matrix depends on the state.
    pub(super) orientation: Option<MassOrientation<S, T>>,
    pub(super) l_d: DiscreteLagrangian<S, R, T>,
    pub(super) solver: ConstraintSolver<S, T>,
    pub(super) arrival: Arrival<S, T>,
    /// Where the run is instead of `here`, if its steps are solved for the impulses alone and that is open.
    pub(super) reduced: Option<Aside<Reduced<S, T>>>,
}

/// The impulses of the constraints at both ends of a step.
pub(super) type Impulses<S, T> = [Multipliers<S, T>; 2];

/// The momentum and the velocity at a point of a run, and the impulses of the step that has led there.
#[derive(Debug)]
pub(super) struct Place<S: ConstrainedSystem, T: Real> {
    pub(super) p: Vector<S, T>,
    pub(super) v: Vector<S, T>,
    pub(super) impulses: Impulses<S, T>,
}

/// The end of a step as it is being found.
#[derive(Debug)]
pub(super) struct Arrival<S: ConstrainedSystem, T: Real> {
    pub(super) increment: Vector<S, T>,
    /// In which the iteration judges coordinates.
    pub(super) weights: Vector<S, T>,
    pub(super) q: Vector<S, T>,
    pub(super) place: Place<S, T>,
    pub(super) work: Vector<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    fn new(system: &S) -> Self {
        let [p, v] = system.space().vectors();
        Self { p, v, impulses: system.multipliers().vectors() }
    }
}

impl<S: ConstrainedSystem, R, T: Real> ConstrainedMemory<S, R, T> {
    /// The discrete momentum at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        self.open().map_or(&self.here.p, |reduced| &reduced.here.p)
    }

    fn open(&self) -> Option<&Aside<Reduced<S, T>>> {
        self.reduced.as_ref().filter(|reduced| reduced.is_open)
    }

    /// The Lagrange multipliers λ of the last step, one for each constraint, so that G(q)ᵀλ is the force of
    /// the constraints. With a symmetric rule they are those in the middle of the step, to order h². Zero
    /// before the first.
    pub fn multipliers(&self) -> impl Iterator<Item = T> + '_ {
        let here = &self.here.impulses;
        let [first, last] = self.open().map_or(here, |reduced| &reduced.here.impulses);
        let (h, zero) = (self.last_step, T::lift(0.0));
        let ends = first.iter().zip(last.iter());
        ends.map(move |(&first, &last)| if h == zero { zero } else { (first + last) / h })
    }
}

lasting!([S: ConstrainedSystem, T: Real] Place<S, T>, T; numbers p, numbers v, vectors impulses);

lasting!([S: ConstrainedSystem, R, T: Real] ConstrainedMemory<S, R, T>, T;
    part here, numbers bend, number last_step, part solver, parts gradients, parts orientation,
    parts reduced);

impl<S: ConstrainedLagrangian<T>, R: Rule, T: Real> ConstrainedMemory<S, R, T> {
    /// At (`q`, `v`, `t`).
    pub(super) fn new(system: &S, rule: R, [q, v]: [&[T]; 2], t: T) -> Result<Self, StartError> {
        let [bend, increment, weights, next, mut work] = system.space().vectors();
        let (mut here, mut solver) = (Place::new(system), ConstraintSolver::new(system, q, v, t));
        let Place { p, v: velocity, impulses: [_, impulse] } = &mut here;
        system.gradient(q, v, t, &mut work, p);
        velocity.copy_from_slice(v);
        let tangent = Tangent { p, v: velocity, impulse, work: &mut work };
        solver.tangent(system, At { q, t }, tangent).map_err(StartError::Starter)?;
        impulse.fill(T::lift(0.0));
        let orientation = (!S::CONSTANT_MASS).then(|| MassOrientation::new(system, q, v, t));
        Ok(Self {
            here,
            bend,
            last_step: T::lift(0.0),
            gradients: S::Kind::OF_POSITIONS.then(|| Gradients::new(system, At { q, t }, v)),
            is_positive: solver.is_positive(),
            orientation: orientation.transpose().map_err(StartError::Starter)?,
            l_d: DiscreteLagrangian::of(system, rule),
            solver,
            arrival: Arrival { increment, weights, q: next, place: Place::new(system), work },
            reduced: None,
        })
    }

    /// Solves the steps of Störmer and Verlet for the impulses alone from (`q`, `v`, `t`) on, if that can be
    /// done.
    #[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
    pub(super) fn reduce(&mut self, system: &S, [q, v]: [&[T]; 2], t: T) {
        self.reduced = Reduced::new(system, &self.solver, [q, v, &self.here.p], t).map(Aside::from);
    }

    /// Sets `v` to the velocity where the run is.
    pub(super) fn velocity(&self, v: &mut [T]) {
        match self.open() {
            Some(reduced) => reduced.mass.solve(&reduced.here.p, v),
            None => v.copy_from_slice(&self.here.v),
        }
    }

    /// Takes steps for the impulses alone, as [`Reduced::stride`]; none if they are not reduced.
    #[inline(never)]
    pub(super) fn stride(&mut self, steps: Steps<'_, S, T>, stopping: Stopping) -> Option<u64> {
        self.reduced.as_mut()?.stride(steps, stopping, &mut self.last_step)
    }
}
