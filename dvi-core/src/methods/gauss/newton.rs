//! Newton's method for the increments W = hV of all stages at once, with Qᵢ = q + Σⱼ aᵢⱼ Wⱼ:
//!
//! rᵢ = ∂L/∂v(Qᵢ, Vᵢ) − p − h Σⱼ aᵢⱼ Fⱼ = 0,   F = ∂L/∂q(Q, V)      of a regular system
//! rᵢ = Ω(Qᵢ) Vᵢ − ∇H(Qᵢ) − ∂α/∂t = 0                                of a degenerate one
//!
//! Corrections are measured by what they do to the stages, Σⱼ aᵢⱼ δWⱼ: where forces are stiff, the
//! increments have the rounding errors of positions times A⁻¹, which is 273 of eight stages, and a step does
//! not see them.

use super::memory::Path;
use crate::discrete::NodeWork;
use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{FirstOrder, Motion, StageWork, weigh};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::Aside;
use crate::methods::collocation::Collocation;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::{Lanes, norm};
use crate::solve::{CoupledEquations, Guess, Solver, Stopping, solve_coupled};
use crate::space::{NodeSum, Sink, Storing};
use crate::state::Statistics;
use crate::{Coupled, Lagrangian, Real, Scalar, Space, System, Vector, Weights};

/// A matrix of fixed size is made on the stack, where threads have two megabytes, and without optimisation
/// in some copies.
const MOST_BYTES: usize = 1 << 17;

/// Newton's equations, with the storage that they need.
#[derive(Debug)]
pub(super) struct NewtonStages<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    solver: Coupled<STAGES, S, T>,
    tableau: Collocation<STAGES>,
    /// W
    increments: [Vector<S, T>; STAGES],
    /// The residuals, and then the corrections.
    residuals: [Vector<S, T>; STAGES],
    /// In which the iteration judges coordinates, and work space.
    weights: [Vector<S, T>; 2],
    /// One stage.
    node: NodeWork<S, T>,
}

/// How a run is solved.
///
/// # Errors
/// [`StartError::Unsupported`] where Newton's method is asked for, and its matrix is too large for the
/// stack.
pub(super) fn solver<const STAGES: usize, S: System, T: Real>(solver: Solver) -> Result<Solver, StartError> {
    match solver {
        Solver::FixedPoint => {}
        Solver::Automatic if S::FAST_SUM => return Ok(Solver::FixedPoint),
        _ if size_of::<Coupled<STAGES, S, T>>() <= MOST_BYTES => {}
        Solver::Automatic => return Ok(Solver::FixedPoint),
        Solver::Newton | Solver::NewtonKrylov => {
            let reason = "its matrix for so many stages and coordinates takes too much of the stack; take \
                          Solver::FixedPoint, fewer stages, or an array of coordinates whose length is \
                          known at run time";
            return Err(StartError::Unsupported { option: "Newton's method", reason });
        }
    }
    Ok(solver.in_numbers::<T>())
}

/// The storage, apart from the rest.
#[inline(never)]
pub(super) fn storage<const STAGES: usize, S, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    storing: Storing,
) -> Aside<NewtonStages<STAGES, S, T>>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    let (space, mut node) = (system.space(), NodeWork::new(system));
    // States of degenerate systems may have no velocities.
    node.velocity[..v.len()].copy_from_slice(v);
    let storage = NewtonStages {
        solver: coupled_by_second_derivatives(system, [q, &node.velocity], t, STAGES, storing),
        tableau: Collocation::gauss(),
        increments: space.vectors(),
        residuals: space.vectors(),
        weights: space.vectors(),
        node,
    };
    #[cfg(feature = "alloc")]
    let storage = Aside::new(storage);
    storage
}

impl<const STAGES: usize, S, T: Real> NewtonStages<STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    /// Finds the slopes and stages of the step from `q`.
    ///
    /// # Errors
    /// As [`solve_coupled`], or what is found at a stage.
    pub(super) fn solve(
        &mut self,
        system: &S,
        path: &mut Path<STAGES, S, T>,
        (q, [t, h]): (&Vector<S, T>, [T; 2]),
        guess: Guess,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { solver, tableau, increments, residuals, weights, node } = self;
        S::Kind::gather(&mut path.equations, q, &mut path.y);
        match guess {
            Guess::Extrapolated => {
                path.guess_continued(h);
                path.set_velocities();
            }
            Guess::Zero => path.slopes[0].fill(Lanes::all(T::lift(0.0))),
        }
        for (stage, increment) in increments.iter_mut().enumerate() {
            read_lane(stage, &path.slopes[0], increment);
            increment.iter_mut().for_each(|w| *w *= h);
        }
        let extrapolated = guess == Guess::Extrapolated;
        let tolerance = stopping.tolerance;
        let mut stages = Stages {
            system,
            tableau,
            path,
            increments,
            node,
            t,
            h,
            per_h: T::lift(1.0) / h,
            stage: 0,
            extrapolated,
            tolerance,
        };
        let room = (&mut *residuals, weights);
        let solved = solve_coupled(&mut stages, (system, q), solver, room, stopping, statistics);
        solved.map_err(|failure| failure.of(StepFailure::STAGES))?;
        stages.evaluate(residuals, statistics)?;
        let Path { equations, coefficients, slopes, stages, work: StageWork { point, slope, .. }, .. } =
            path;
        for (stage, &c) in coefficients.c.0.iter().enumerate() {
            for part in 0..stages.len() {
                read_lane(stage, &stages[part], &mut point[part]);
                read_lane(stage, &slopes[part], &mut slope[part]);
                norm::finite(&slope[part])?;
            }
            let time = t + c * h;
            S::Kind::compare(equations, system, point, time)?;
            // The velocity of the last stage leads to that at the end of the step.
            if S::Kind::HAS_VELOCITY_FORCES && stage + 1 == STAGES {
                S::Kind::evaluate_part(equations, system, 0, point, time, slope, statistics)?;
            }
        }
        Ok(())
    }
}

/// The equations of a step from t of length h, and the matrix ∂rᵢ/∂Wₖ, in which a node of the sum is a
/// stage.
struct Stages<'a, const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    system: &'a S,
    tableau: &'a Collocation<STAGES>,
    path: &'a mut Path<STAGES, S, T>,
    increments: &'a mut [Vector<S, T>; STAGES],
    node: &'a mut NodeWork<S, T>,
    t: T,
    h: T,
    per_h: T,
    stage: usize,
    /// Whether this is the guess still, and extrapolated.
    extrapolated: bool,
    tolerance: f64,
}

impl<const STAGES: usize, S, T: Real> Stages<'_, STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    /// Goes to a stage, and returns its time.
    fn go_to(&mut self, stage: usize) -> T {
        self.stage = stage;
        read_lane(stage, &self.path.stages[0], &mut self.node.point);
        read_lane(stage, &self.path.slopes[0], &mut self.node.velocity);
        self.time()
    }

    fn time(&self) -> T {
        self.t + self.path.coefficients.c.0[self.stage] * self.h
    }

    fn linearize(&mut self, weights: Weights<T>, sink: &mut impl Sink<T>) {
        let (time, NodeWork { point, velocity, gradient, momentum }) = (self.time(), &mut *self.node);
        self.system.linearize(point, velocity, time, weights, gradient, momentum, sink);
    }

    /// The largest Σⱼ aᵢⱼ xⱼ.
    fn displacement(&self, x: [T; STAGES]) -> T {
        self.tableau.a.iter().fold(T::lift(0.0), |largest, row| {
            let sum = row.iter().zip(x).fold(T::lift(0.0), |sum, (&a, x)| sum + T::lift(a) * x);
            norm::larger(largest, Scalar::abs(sum))
        })
    }
}

impl<const STAGES: usize, S, T: Real> CoupledEquations<STAGES, S, T> for Stages<'_, STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    /// A matrix that is known to half of the digits alone brings one order in an iteration, and does not
    /// double it.
    const PER_ORDER: usize = 2;

    fn unknowns(&mut self) -> &mut [Vector<S, T>; STAGES] {
        self.increments
    }

    /// Sets slopes and stages too.
    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; STAGES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let weights = Lanes::all(self.h) * self.path.coefficients.b;
        for (n, slope) in self.path.slopes[0].iter_mut().enumerate() {
            *slope = Lanes(self.increments.each_ref().map(|increment| self.per_h * increment[n]));
        }
        weigh(|_| weights, &self.path.slopes[0], &mut self.path.terms[0]);
        self.path.reach(0);
        for (stage, residual) in residuals.iter_mut().enumerate() {
            let time = self.go_to(stage);
            let NodeWork { point, velocity, gradient: force, .. } = &mut *self.node;
            S::Kind::residual(self.system, [point, velocity], time, force, residual);
            self.path.slopes[1..].iter_mut().for_each(|slopes| write_lane(stage, force, slopes));
        }
        statistics.gradients += STAGES as u64;
        let path = &mut *self.path;
        for part in 1..path.y.len() {
            weigh(|_| weights, &path.slopes[part], &mut path.terms[part]);
            path.reach(part);
            for (stage, residual) in residuals.iter_mut().enumerate() {
                for (residual, momentum) in residual.iter_mut().zip(path.stages[part].iter()) {
                    *residual -= momentum.0[stage];
                }
            }
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
            self.increments.iter_mut().zip(corrections).for_each(|(w, change)| w[n] -= change[n]);
            let change = self.displacement(corrections.each_ref().map(|change| change[n]));
            was_farther |= change > self.displacement(self.increments.each_ref().map(|w| w[n]));
            largest = norm::larger(largest, change * weight);
        }
        if core::mem::take(&mut self.extrapolated) && was_farther {
            let (correction, tolerance) = (norm::reported(largest), self.tolerance);
            return Err(StepFailure::NotConverged { iterations: 1, correction, tolerance });
        }
        Ok(largest)
    }
}

impl<const STAGES: usize, S, T: Real> NodeSum<STAGES, T> for Stages<'_, STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    const FIRST: usize = 0;
    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn place(&mut self, j: usize) {
        self.go_to(j);
    }

    fn given(&self, _i: usize) -> T {
        T::lift(0.0)
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let j = self.stage;
        let a = |i: usize, k: usize| T::lift(self.tableau.a[i][k]);
        S::Kind::newton_weights([r == j, j == k], [a(r, j), a(j, k)], [self.h, self.per_h])
    }

    fn momentum_by_position(&mut self, vq: &mut impl Sink<T>) {
        let zero = T::lift(0.0);
        self.linearize(Weights { qq: zero, qv: zero, vq: T::lift(1.0), vv: zero }, vq);
    }

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        self.linearize(Weights { qq: one, ..none }, qq);
        self.linearize(Weights { qv: one, ..none }, qv);
        let interval = [self.time(), self.h];
        let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
        S::Kind::newton_matrix(self.system, [point, velocity], interval, [gradient, momentum], vv);
    }
}
