//! A step with interior displacements: its guess, the equations that are solved, and what is looked at where
//! it ends.

use super::displaced::Displaced;
use super::interior::InteriorNodes;
use super::memory::Path;
use crate::discrete::frequency::Frequency;
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::phase::Arrival;
use crate::methods::step::{Begin, Carried, Work};
use crate::scalar::norm;
use crate::scalar::passes::multiply;
use crate::solve::{CoupledEquations, Guess, Stopping, solve_coupled};
use crate::state::Statistics;
use crate::{Coupled, NondegenerateLagrangian, Real, System, Vector};

/// A step, and what it changes.
pub(super) struct Attempt<'a, const NODES: usize, S: System, F, T: Real, I> {
    pub(super) system: &'a S,
    pub(super) frequency: &'a F,
    pub(super) stopping: Stopping,
    pub(super) interval: Interval<T>,
    pub(super) q: &'a mut Vector<S, T>,
    pub(super) carried: &'a mut Carried<S, T>,
    pub(super) path: &'a mut Path<NODES, S, T, I>,
    /// Whether the interior nodes have not been asked.
    pub(super) by_newton: bool,
}

/// The equations of a step, and storage: for the residuals, for weights, and for Δ.
type Posed<'a, const NODES: usize, S, F, T> = (
    Displaced<'a, NODES, S, F, T>,
    &'a mut [Vector<S, T>; NODES],
    &'a mut [Vector<S, T>; 2],
    &'a mut Vector<S, T>,
);

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real, I>
    Attempt<'_, NODES, S, F, T, I>
where
    I: InteriorNodes<NODES, S, T>,
{
    /// The unknowns, and p1 − p0 but for the kick at the end, by the fixed point of a separable L.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn by_fixed_point(
        &mut self,
        budget: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.by_newton = false;
        let limits = (self.stopping, budget);
        let Self { system, interval, q, carried: Carried { phase, inertial, .. }, path, .. } = self;
        let Path { interior, unknowns, residuals, .. } = &mut **path;
        if F::UNFITTED
            && let Some(interior) = interior
        {
            let at = Begin { system: *system, interval: *interval, q, phase, mass: &inertial.mass };
            let increments = [&mut unknowns[NODES - 1], &mut residuals[0]];
            return interior.solve(&at, limits, increments, statistics);
        }
        self.guess();
        let (mut path, residuals, [weights, change], delta) = self.pose();
        path.iterate((residuals, [delta, change, weights]), limits, statistics)
    }

    /// The same by Newton's method, of any L.
    pub(super) fn by_newton(
        &mut self,
        solver: &mut Coupled<NODES, S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.by_newton = true;
        self.guess();
        if guess == Guess::Zero {
            self.path.unknowns[1..].iter_mut().for_each(|unknown| unknown.fill(T::lift(0.0)));
        }
        let stopping = self.stopping;
        let (mut path, residuals, weights, _) = self.pose();
        let Begin { system, q, .. } = path.at;
        solve_coupled(&mut path, (system, q), solver, (residuals, weights), stopping, statistics)?;
        path.evaluate(residuals, statistics)
    }

    /// The equations of any L.
    fn pose(&mut self) -> Posed<'_, NODES, S, F, T> {
        let Self { system, frequency, interval, q, carried, path, .. } = self;
        let Carried { phase, inertial, work: Work { node, increment, .. } } = &mut **carried;
        let Path { fit, ends, unknowns, residuals, weights, .. } = &mut **path;
        let at = Begin { system: *system, interval: *interval, q, phase, mass: &inertial.mass };
        let path = Displaced { at, frequency: *frequency, fit, ends, unknowns, node, j: 0 };
        (path, residuals, weights, increment)
    }

    /// Sets the unknowns to their guess: extrapolated from the steps before, if these are kept and had about
    /// this length; else the path is straight, and its velocity is taken from the momentum if L is
    /// separable.
    fn guess(&mut self) {
        let Self { interval: Interval { h, .. }, q, carried: Carried { phase, inertial, .. }, path, .. } =
            self;
        let Path { displacements, unknowns, .. } = &mut **path;
        unknowns[0].copy_from_slice(q);
        for (node, displacement) in unknowns.iter_mut().enumerate().take(NODES - 1).skip(1) {
            match displacements {
                Some(displacements) if phase.extrapolates_to(*h) => {
                    displacements.nodes[node].extrapolate(displacement);
                    multiply(displacement, *h * *h);
                }
                _ => displacement.fill(T::lift(0.0)),
            }
        }
        phase.guess(&inertial.mass, *h, F::OF_VELOCITY, &mut unknowns[NODES - 1]);
    }

    /// Moves to q1 = q0 + Δ and p1 = p0 + (D₁ + D₂)L_d, if they are numbers and the mass matrix has kept its
    /// orientation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn arrive(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { system, interval, q, carried, path, by_newton, .. } = self;
        let Carried { phase, inertial, work: Work { node, .. } } = &mut **carried;
        let Path { interior, displacements, fit, unknowns, residuals, .. } = &mut **path;
        let NodeWork { point: next, velocity, gradient: force, momentum } = node;
        let (h, end, delta) = (interval.h, interval.time(T::lift(1.0)), &unknowns[NODES - 1]);
        phase.reach(q, delta, next);
        if S::SEPARABLE {
            system.force(next, &[], end, force);
            statistics.gradients += 1;
            let by = h * fit.weights[NODES - 1];
            residuals[0].iter_mut().zip(force.iter()).for_each(|(sum, &force)| *sum += by * force);
        }
        phase.kick(&residuals[0], momentum);
        norm::finite(next).and(norm::finite(momentum))?;
        inertial.check(system, [next, delta], [end, h], velocity)?;
        let similar = phase.extrapolates_to(h);
        phase.advance(q, &Arrival { q: next, p: momentum, force }, [delta, &residuals[0]], h)?;
        if let Some(interior) = interior {
            interior.remember(if *by_newton { T::lift(0.0) } else { h });
        }
        let per_h = T::lift(1.0) / h;
        let histories = displacements.iter_mut().flat_map(|displacements| &mut displacements.nodes);
        for (history, displacement) in histories.zip(unknowns).take(NODES - 1).skip(1) {
            if !similar {
                history.clear();
            }
            history.push_scaled(displacement, per_h * per_h);
        }
        Ok(())
    }
}
