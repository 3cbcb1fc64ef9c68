//! Newton's method for the increments W = hV of all stages at once, with Qᵢ = q + Σⱼ aᵢⱼ Wⱼ:
//!
//! rᵢ = ∂L/∂v(Qᵢ, Vᵢ) − p − h Σⱼ aᵢⱼ Fⱼ = 0,   F = ∂L/∂q(Q, V)      in coordinates and momenta
//! rᵢ = Ω(Qᵢ) Vᵢ − ∇H(Qᵢ) − ∂α/∂t = 0                                on Q, of a degenerate system
//!
//! Corrections are measured by what they do to the stages, Σⱼ aᵢⱼ δWⱼ: where forces are stiff, the
//! increments have the rounding errors of positions times A⁻¹, which is 273 of eight stages, and a step does
//! not see them.

use super::Collocation;
use crate::discrete::NodeWork;
use crate::error::StepFailure;
use crate::mechanics::motion::StageEquations;
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::scalar::norm;
use crate::scalar::passes::subtract;
use crate::solve::{CoupledEquations, Guess, Stopping, solve_coupled};
use crate::space::{NodeSum, Sink, Storing};
use crate::state::Statistics;
use crate::{Coupled, Lagrangian, Real, Scalar, Space, System, Vector, Weights};

/// The stages, with the storage that solving for them needs.
#[derive(Debug)]
pub(in crate::methods) struct NewtonStages<const STAGES: usize, S: System, T: Real> {
    solver: Coupled<STAGES, S, T>,
    pub(in crate::methods) tableau: Collocation<STAGES>,
    /// W
    pub(in crate::methods) increments: [Vector<S, T>; STAGES],
    /// F
    pub(in crate::methods) forces: [Vector<S, T>; STAGES],
    /// The residuals, and then the corrections.
    residuals: [Vector<S, T>; STAGES],
    /// In which the iteration judges coordinates, and work space.
    weights: [Vector<S, T>; 2],
    /// One stage.
    node: NodeWork<S, T>,
}

/// Where a step begins: q and, of equations with momenta, p, each with a small number that is added to it.
#[derive(Clone, Copy)]
pub(in crate::methods) struct Departure<'a, T> {
    pub(in crate::methods) q: [&'a [T]; 2],
    pub(in crate::methods) p: [&'a [T]; 2],
    pub(in crate::methods) t: T,
    pub(in crate::methods) h: T,
}

impl<const STAGES: usize, S: Lagrangian<T>, T: Real> NewtonStages<STAGES, S, T> {
    pub(in crate::methods) fn new(system: &S, [q, v]: [&[T]; 2], t: T, storing: Storing) -> Self {
        let (space, mut node) = (system.space(), NodeWork::new(system));
        // States of degenerate systems may have no velocities.
        node.velocity[..v.len()].copy_from_slice(v);
        Self {
            solver: coupled_by_second_derivatives(system, [q, &node.velocity], t, STAGES, storing),
            tableau: Collocation::gauss(),
            increments: space.vectors(),
            forces: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
            node,
        }
    }

    /// Improves the increments from a guess until the equations `E` hold, and gives each stage to `take`:
    /// its number and time, its point, velocity and momentum, and F there.
    pub(in crate::methods) fn solve<E: StageEquations<S, T>>(
        &mut self,
        system: &S,
        from: Departure<'_, T>,
        (guess, stopping): (Guess, Stopping),
        statistics: &mut Statistics,
        mut take: impl FnMut(usize, T, &NodeWork<S, T>, &[T], &mut Statistics) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        let Self { solver, tableau, increments, forces, residuals, weights, node } = self;
        let tolerance = stopping.tolerance;
        let extrapolated = guess == Guess::Extrapolated;
        let equations = core::marker::PhantomData::<E>;
        let mut stages = Stages {
            system,
            tableau,
            from,
            increments,
            forces,
            node,
            per_h: T::lift(1.0) / from.h,
            stage: 0,
            extrapolated,
            tolerance,
            equations,
        };
        let room = (&mut *residuals, weights);
        solve_coupled(&mut stages, (system, from.q[0]), solver, room, stopping, statistics)?;
        stages.evaluate(residuals, statistics)?;
        for stage in 0..STAGES {
            stages.place(stage);
            stages.set_momentum();
            let (node, force) = (&*stages.node, &stages.forces[stage]);
            norm::finite(&node.velocity).and(norm::finite(force))?;
            take(stage, stages.time(), node, force, statistics)?;
        }
        Ok(())
    }
}

/// The equations of a step, and the matrix ∂rᵢ/∂Wₖ, in which a node of the sum is a stage.
struct Stages<'a, const STAGES: usize, E, S: System, T: Real> {
    system: &'a S,
    tableau: &'a Collocation<STAGES>,
    from: Departure<'a, T>,
    increments: &'a mut [Vector<S, T>; STAGES],
    forces: &'a mut [Vector<S, T>; STAGES],
    node: &'a mut NodeWork<S, T>,
    per_h: T,
    stage: usize,
    /// Whether this is the guess still, and extrapolated.
    extrapolated: bool,
    tolerance: f64,
    equations: core::marker::PhantomData<E>,
}

/// Σⱼ `row`ⱼ xⱼ of entry `n`.
pub(in crate::methods) fn weighted<const STAGES: usize, T: Real>(
    row: &[f64; STAGES],
    x: &[impl core::ops::Deref<Target = [T]>; STAGES],
    n: usize,
) -> T {
    row.iter().zip(x).fold(T::lift(0.0), |sum, (&a, x)| sum + T::lift(a) * x[n])
}

impl<const STAGES: usize, E: StageEquations<S, T>, S: Lagrangian<T>, T: Real> Stages<'_, STAGES, E, S, T> {
    /// The time of the stage.
    fn time(&self) -> T {
        self.from.t + T::lift(self.tableau.c[self.stage]) * self.from.h
    }

    /// Sets `node.momentum` to p + h Σⱼ aᵢⱼ Fⱼ, where there are momenta.
    fn set_momentum(&mut self) {
        let Self { tableau, from: Departure { p: [p, rest], h, .. }, forces, node, stage, .. } = self;
        for (n, (momentum, (&p, &rest))) in node.momentum.iter_mut().zip(p.iter().zip(*rest)).enumerate() {
            *momentum = p + (rest + *h * weighted(&tableau.a[*stage], forces, n));
        }
    }

    fn linearize(&mut self, weights: Weights<T>, sink: &mut impl Sink<T>) {
        let (time, NodeWork { point, velocity, gradient, momentum }) = (self.time(), &mut *self.node);
        self.system.linearize(point, velocity, time, weights, gradient, momentum, sink);
    }

    /// The largest Σⱼ aᵢⱼ xⱼ of entry `n`.
    fn displacement(&self, x: &[Vector<S, T>; STAGES], n: usize) -> T {
        let mut largest = T::lift(0.0);
        for row in &self.tableau.a {
            largest = norm::larger(largest, Scalar::abs(weighted(row, x, n)));
        }
        largest
    }
}

impl<const STAGES: usize, E: StageEquations<S, T>, S: Lagrangian<T>, T: Real> CoupledEquations<STAGES, S, T>
    for Stages<'_, STAGES, E, S, T>
{
    /// A matrix that is known to half of the digits alone brings one order in an iteration, and does not
    /// double it.
    const PER_ORDER: usize = 2;

    fn unknowns(&mut self) -> &mut [Vector<S, T>; STAGES] {
        self.increments
    }

    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; STAGES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        for (stage, residual) in residuals.iter_mut().enumerate() {
            self.place(stage);
            let (time, NodeWork { point, velocity, .. }) = (self.time(), &mut *self.node);
            E::residual(self.system, [point, velocity], time, &mut self.forces[stage], residual);
        }
        statistics.gradients += STAGES as u64;
        for (stage, residual) in residuals.iter_mut().enumerate() {
            self.stage = stage;
            self.set_momentum();
            subtract(&mut residual[..self.from.p[0].len()], &self.node.momentum);
        }
        Ok(())
    }

    /// # Errors
    /// [`StepFailure::NotConverged`] where a coordinate of a stage is now less far from the start of the
    /// step than it has been from here: from a guess that is worse than none Newton's method may find
    /// another solution, far away.
    fn correct(
        &mut self,
        _system: &S,
        weights: &[T],
        corrections: &[Vector<S, T>; STAGES],
    ) -> Result<T, StepFailure> {
        let (mut largest, mut was_farther) = (T::lift(0.0), false);
        for (n, &weight) in weights.iter().enumerate() {
            for (w, change) in self.increments.iter_mut().zip(corrections) {
                w[n] -= change[n];
            }
            let change = self.displacement(corrections, n);
            was_farther |= self.extrapolated && change > self.displacement(self.increments, n);
            largest = norm::larger(largest, change * weight);
        }
        if core::mem::take(&mut self.extrapolated) && was_farther {
            let (correction, tolerance) = (norm::reported(largest), self.tolerance);
            return Err(StepFailure::NotConverged { iterations: 1, correction, tolerance });
        }
        Ok(largest)
    }
}

impl<const STAGES: usize, E: StageEquations<S, T>, S: Lagrangian<T>, T: Real> NodeSum<STAGES, T>
    for Stages<'_, STAGES, E, S, T>
{
    const FIRST: usize = 0;
    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn place(&mut self, j: usize) {
        self.stage = j;
        let Self { tableau, from: Departure { q: [q, rest], .. }, increments, node, per_h, .. } = self;
        for n in 0..q.len() {
            node.point[n] = q[n] + (rest[n] + weighted(&tableau.a[j], increments, n));
            node.velocity[n] = *per_h * increments[j][n];
        }
    }

    fn given(&self, i: usize) -> T {
        self.from.p[0].get(i).copied().unwrap_or(T::lift(0.0))
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let j = self.stage;
        let a = |i: usize, k: usize| T::lift(self.tableau.a[i][k]);
        E::newton_weights([r == j, j == k], [a(r, j), a(j, k)], [self.from.h, self.per_h])
    }

    fn momentum_by_position(&mut self, vq: &mut impl Sink<T>) {
        self.linearize(Weights { vq: T::lift(1.0), ..Weights::none() }, vq);
    }

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        let (none, one) = (Weights::none(), T::lift(1.0));
        self.linearize(Weights { qq: one, ..none }, qq);
        self.linearize(Weights { qv: one, ..none }, qv);
        let interval = [self.time(), self.from.h];
        let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
        E::newton_matrix(self.system, [point, velocity], interval, [gradient, momentum], vv);
    }
}
