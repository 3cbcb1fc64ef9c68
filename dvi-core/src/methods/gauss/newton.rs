//! Newton's method for the velocities V of all stages at once, with Qᵢ = q + h Σⱼ aᵢⱼ Vⱼ:
//!
//! rᵢ = ∂L/∂v(Qᵢ, Vᵢ) − p − h Σⱼ aᵢⱼ Fⱼ = 0,   F = ∂L/∂q(Q, V)      of a regular system
//! rᵢ = Ω(Qᵢ) Vᵢ − ∇H(Qᵢ) − ∂α/∂t = 0                                of a degenerate one
//!
//! Corrections are measured by what they do to the stages, h Σⱼ aᵢⱼ δVⱼ: where forces are stiff, the
//! velocities have the rounding errors of positions times (hA)⁻¹, which is 273/h of eight stages, and a step
//! does not see them.

use super::memory::{GaussMemory, Path};
use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{FirstOrder, Motion, PointOf, weigh};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::Aside;
use crate::methods::collocation::Collocation;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::{Lanes, norm};
use crate::solve::{Convergence, Due, Guess, Judge, Solver, Stopping, iterate};
use crate::space::{CoupledSolver, NodeSum, Sink, Storing, linear};
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{Coupled, Lagrangian, Real, Scalar, Space, System, Vector, Weights};

/// A matrix of fixed size is made on the stack, where threads have two megabytes, and without optimisation
/// in some copies.
const MOST_BYTES: usize = 1 << 17;

/// Newton's equations, with the storage that they need.
#[derive(Debug)]
pub(super) struct NewtonStages<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    solver: Coupled<STAGES, S, T>,
    tableau: Collocation<STAGES>,
    /// The residuals, and then the corrections.
    residuals: [Vector<S, T>; STAGES],
    /// What a residual is made of.
    sums: Vector<S, T>,
    /// One stage.
    point: PointOf<S, T>,
    slope: PointOf<S, T>,
    derivatives: [Vector<S, T>; 2],
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
    let [point, mut slope]: [PointOf<S, T>; 2] = S::Kind::points(system);
    // States of degenerate systems may have no velocities.
    slope[0][..v.len()].copy_from_slice(v);
    let solver = coupled_by_second_derivatives(system, [q, &slope[0]], t, STAGES, storing);
    let (residuals, sums) = (system.space().vectors(), system.space().vector());
    let derivatives = system.space().vectors();
    let storage =
        NewtonStages { solver, tableau: Collocation::gauss(), residuals, sums, point, slope, derivatives };
    #[cfg(feature = "alloc")]
    let storage = Aside::new(storage);
    storage
}

impl<const STAGES: usize, S, T: Real> GaussMemory<STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    /// Takes a step from t to t + h, if Newton's method stands by the fixed point, which has been `tried` or
    /// is not to be.
    ///
    /// # Errors
    /// Those of Newton's method, or else of the fixed point.
    #[cold]
    #[inline(never)]
    pub(super) fn step_by_newton(
        &mut self,
        tried: Result<(), StepFailure>,
        system: &S,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        (stopping, summation): (Stopping, Summation),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { ladder, path } = self;
        ladder.solve(
            &mut (path, q),
            statistics,
            |_, _| tried,
            |(path, q), newton, guess, statistics| {
                newton.solve(system, path, q, [t, h], guess, stopping, statistics)?;
                path.arrive(0, summation, system, q, t, h)
            },
        )
    }
}

impl<const STAGES: usize, S, T: Real> NewtonStages<STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    /// Finds the slopes of the step from `q`.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn solve(
        &mut self,
        system: &S,
        path: &mut Path<STAGES, S, T>,
        q: &Vector<S, T>,
        [t, h]: [T; 2],
        guess: Guess,
        stopping: Stopping,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        S::Kind::gather(&mut path.equations, q, &mut path.y);
        match guess {
            Guess::Extrapolated => {
                path.guess_continued(h);
                path.set_velocities();
            }
            Guess::Zero => path.slopes[0].fill(Lanes::all(T::lift(0.0))),
        }
        let mut extrapolated = guess == Guess::Extrapolated;
        let mut convergence = Convergence::new(stopping, stopping.max_iterations);
        // A matrix that is known to half of the digits alone brings one order of derivatives in an
        // iteration, and does not double it.
        convergence.course().more *= 2;
        iterate(convergence, statistics, |due, statistics| {
            due.prepare_slopes(system, &mut path.weights, (q, h), &mut path.slopes[0]);
            self.differentiate(system, path, [t, h], statistics)?;
            statistics.linearizations += STAGES as u64;
            statistics.factorisations += 1;
            let Self { solver, tableau, residuals, sums, point, slope, derivatives } = self;
            let at = [&mut point[0], &mut slope[0]];
            // Those of coordinates over h.
            let weights = &*path.weights;
            let mut matrix = Linearized { system, tableau, path, at, derivatives, t, h, stage: 0 };
            if *due == Due::Residual {
                return linear::residual_of_nodes(&mut matrix, weights, residuals, sums);
            }
            solver.solve(&mut matrix, weights, residuals)?;
            let (correction, was_farther) = self.correct(path, h);
            // From a guess that is worse than none Newton's method may find another solution, far away.
            if core::mem::take(&mut extrapolated) && was_farther {
                let (correction, tolerance) = (norm::reported(correction), stopping.tolerance);
                return Err(StepFailure::NotConverged { iterations: 1, correction, tolerance });
            }
            Ok(correction)
        })?;
        self.differentiate(system, path, [t, h], statistics)?;
        let Self { point, slope, derivatives: [velocity, _], .. } = self;
        for (stage, &c) in path.coefficients.c.0.iter().enumerate() {
            for part in 0..path.y.len() {
                read_lane(stage, &path.stages[part], &mut point[part]);
                read_lane(stage, &path.slopes[part], &mut slope[part]);
                norm::finite(&slope[part])?;
            }
            let time = t + c * h;
            S::Kind::compare(&mut path.equations, system, point, time)?;
            // The velocity of the last stage leads to that at the end of the step.
            if S::Kind::HAS_VELOCITY_FORCES && stage + 1 == STAGES {
                let equations = &mut path.equations;
                S::Kind::evaluate_part(equations, system, 0, point, time, slope, velocity, statistics)?;
            }
        }
        Ok(())
    }

    /// Places the stages by their velocities, and sets forces and residuals.
    fn differentiate(
        &mut self,
        system: &S,
        path: &mut Path<STAGES, S, T>,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { residuals, point, slope, derivatives: [force, _], .. } = self;
        let weights = Lanes::all(h) * path.coefficients.b;
        weigh(|_| weights, &path.slopes[0], &mut path.terms[0]);
        path.reach(0);
        for (stage, residual) in residuals.iter_mut().enumerate() {
            read_lane(stage, &path.stages[0], &mut point[0]);
            read_lane(stage, &path.slopes[0], &mut slope[0]);
            let time = t + path.coefficients.c.0[stage] * h;
            S::Kind::residual(system, [&point[0], &slope[0]], time, force, residual);
            path.slopes[1..].iter_mut().for_each(|slopes| write_lane(stage, force, slopes));
        }
        statistics.gradients += STAGES as u64;
        for part in 1..path.y.len() {
            weigh(|_| weights, &path.slopes[part], &mut path.terms[part]);
            path.reach(part);
            for (stage, residual) in residuals.iter_mut().enumerate() {
                for (residual, momentum) in residual.iter_mut().zip(path.stages[part].iter()) {
                    *residual -= momentum.0[stage];
                }
            }
        }
        residuals.iter().try_for_each(|residual| norm::finite(residual))
    }

    /// Subtracts the corrections, and returns the largest change of a coordinate of a stage in its unit, and
    /// whether a coordinate has changed by more than what it is away from the start of the step now.
    fn correct(&self, path: &mut Path<STAGES, S, T>, h: T) -> (T, bool) {
        let (zero, mut correction, mut was_farther) = (T::lift(0.0), T::lift(0.0), false);
        // The largest h Σⱼ aᵢⱼ vⱼ.
        let displacement = |v: [T; STAGES]| {
            self.tableau.a.iter().fold(zero, |largest, row| {
                let sum = row.iter().zip(v).fold(zero, |sum, (&a, v)| sum + T::lift(a) * v);
                norm::larger(largest, Scalar::abs(h * sum))
            })
        };
        for (n, slope) in path.slopes[0].iter_mut().enumerate() {
            let changes = self.residuals.each_ref().map(|change| change[n]);
            *slope -= Lanes(changes);
            let change = displacement(changes);
            was_farther |= change > displacement(slope.0);
            correction = norm::larger(correction, change * path.weights[n] / Scalar::abs(h));
        }
        (correction, was_farther)
    }
}

/// The matrix ∂rᵢ/∂Vₖ at the present stages; a node of the sum is a stage.
struct Linearized<'a, const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    system: &'a S,
    tableau: &'a Collocation<STAGES>,
    path: &'a Path<STAGES, S, T>,
    /// Q and V of a stage.
    at: [&'a mut Vector<S, T>; 2],
    derivatives: &'a mut [Vector<S, T>; 2],
    t: T,
    h: T,
    stage: usize,
}

impl<const STAGES: usize, S, T: Real> Linearized<'_, STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    fn time(&self) -> T {
        self.t + self.path.coefficients.c.0[self.stage] * self.h
    }

    fn linearize(&mut self, weights: Weights<T>, sink: &mut impl Sink<T>) {
        let time = self.time();
        let Self { system, at: [point, velocity], derivatives: [l_q, l_v], .. } = self;
        system.linearize(point, velocity, time, weights, l_q, l_v, sink);
    }
}

impl<const STAGES: usize, S, T: Real> NodeSum<STAGES, T> for Linearized<'_, STAGES, S, T>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
{
    const FIRST: usize = 0;
    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn place(&mut self, j: usize) {
        self.stage = j;
        let [point, velocity] = &mut self.at;
        read_lane(j, &self.path.stages[0], point);
        read_lane(j, &self.path.slopes[0], velocity);
    }

    fn given(&self, _i: usize) -> T {
        T::lift(0.0)
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let j = self.stage;
        let a = |i: usize, k: usize| self.h * T::lift(self.tableau.a[i][k]);
        S::Kind::newton_weights([r == j, j == k], [a(r, j), a(j, k)])
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
        let Self { system, at: [point, velocity], derivatives, .. } = self;
        S::Kind::newton_matrix(*system, [point, velocity], interval, derivatives, vv);
    }
}
