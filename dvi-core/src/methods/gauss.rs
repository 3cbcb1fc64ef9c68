//! Gauss collocation on the equations of motion y' = X(y, t).
//!
//! Kᵢ = X(Yᵢ, t + cᵢh),   Yᵢ = y + Σⱼ μᵢⱼ Lⱼ,   y⁺ = y + Σᵢ Lᵢ,   Lᵢ = hbᵢ Kᵢ,   μᵢⱼ = aᵢⱼ/bⱼ
//!
//! with c the zeros of the shifted Legendre polynomial (Butcher 1964; Hairer, Lubich & Wanner 2006, section II.1.3), written in
//! the numbers L so that the step is symplectic in the arithmetic (Antoñana, Makazaga & Murua 2017). The stages are iterated as a
//! fixed point down to rounding errors, from the collocation polynomial of the last step, continued.
//!
//! Each number of a point stands once for each stage, in the lanes of a pack; the equations of motion are evaluated stage by
//! stage, or for all stages at once.

mod coefficients;

use core::fmt;
use core::marker::PhantomData;

use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{
    AtStages, EquationsOf, FirstOrder, InLanes, Motion, OneByOne, PackedOf, PointOf, Slopes, StageEvaluation,
    StageWork,
};
use crate::methods::collocation::MOST;
use crate::methods::{Carries, Clock, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::simd::Task;
use crate::scalar::{Lanes, norm};
use crate::solve::{Convergence, Iteration, Stopping, repeat};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::state::summation::{Summation, left_out};
use crate::{Lagrangian, Real, Scalar, System, Vector};

use coefficients::{Coefficients, combine};

/// Gauss collocation with `S` stages, 1 ≤ `S` ≤ 8, of order 2`S`, on the equations of motion y' = X(y, t).
///
/// ```math
/// K_i = X\Bigl(y + h \sum_j a_{ij} K_j,\ t + c_i h\Bigr), \qquad y^+ = y + h \sum_i b_i K_i
/// ```
///
/// Of a degenerate system y = q, and of a regular one y = (q, p). With `S` = 1 the method is the implicit midpoint rule.
///
/// It is symmetric. On Hamilton's equations of a regular system it preserves dq ∧ dp, and all momenta that are bilinear in q
/// and p. On q' = X(q) of a degenerate system it preserves Ω if α is affine, and then all quadratic momenta. The stages are found
/// by a fixed point, which contracts if h is small against the fastest time scale only:
/// [`StepFailure::NotConverged`] where it does not.
///
/// [`in_lanes`](Self::in_lanes) evaluates all stages at once, in SIMD lanes, and gives the same numbers, bit for bit: with eight stages,
/// order 16, it is the method for energies that are to be kept to rounding errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauss<const S: usize, E = OneByOne> {
    /// The criterion by which the stages count as converged. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Compensated`]; the stages are then iterated until
    /// nothing is left to gain, which takes about one iteration more.
    pub summation: Summation,
    /// How the stages are evaluated.
    pub evaluation: E,
}

impl<const S: usize> Gauss<S> {
    /// The method with default options. A number of stages below 1 or above 8 does not compile.
    pub fn new() -> Self {
        const { assert!(S >= 1 && S <= MOST, "Gauss collocation is available with 1 to 8 stages") };
        Self { stopping: Stopping::default(), summation: Summation::Compensated, evaluation: OneByOne }
    }

    /// The same with all stages evaluated at once.
    ///
    /// The equations of motion are evaluated on packs of `S` numbers where Ω couples the coordinates in pairs, or the mass
    /// matrix is constant and diagonal. Of other systems forces and ∇H are, and linear equations are solved stage by stage.
    #[must_use]
    pub fn in_lanes(self) -> Gauss<S, InLanes> {
        let Self { stopping, summation, .. } = self;
        Gauss { stopping, summation, evaluation: InLanes }
    }
}

impl<const S: usize> Default for Gauss<S> {
    fn default() -> Self {
        Self::new()
    }
}

/// The stages of a Gauss step, and those of the step before.
pub struct GaussMemory<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> {
    equations: EquationsOf<S, T>,
    coefficients: Coefficients<STAGES, T>,
    /// The slopes K of the last completed step.
    completed: StagesOf<STAGES, S, T>,
    /// What rounding has left out of y, if sums are compensated.
    rest: PointOf<S, T>,
    slopes: StagesOf<STAGES, S, T>,
    /// L, of these slopes.
    terms: StagesOf<STAGES, S, T>,
    stages: StagesOf<STAGES, S, T>,
    /// Where the step begins, its increment, and where it ends.
    y: PointOf<S, T>,
    increment: PointOf<S, T>,
    next: PointOf<S, T>,
    work: StageWork<STAGES, S, T>,
}

type StagesOf<const STAGES: usize, S, T> = PackedOf<S, T, Lanes<STAGES, T>>;

impl<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> Memory<T> for GaussMemory<STAGES, S, T> {
    lasting!(T; part equations, packs completed, part rest);
}

impl<const STAGES: usize, S: System<Kind: Motion<S, T>>, T: Real> fmt::Debug for GaussMemory<STAGES, S, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GaussMemory").field("completed", &self.completed).finish_non_exhaustive()
    }
}

/// The largest of all numbers in `packs`.
#[inline(always)]
fn largest<const STAGES: usize, T: Real>(packs: &[Lanes<STAGES, T>]) -> T {
    let mut largest = [T::lift(0.0); STAGES];
    for pack in packs {
        for stage in 0..STAGES {
            largest[stage] = norm::larger(largest[stage], Scalar::abs(pack.0[stage]));
        }
    }
    norm::largest(&largest)
}

impl<const S: usize, E> Scheme for Gauss<S, E> {
    fn order(&self) -> usize {
        2 * S
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::OmegaIfAffine
    }
}

impl<const STAGES: usize, E, S: System<Kind: Motion<S, T>>, T: Real> Carries<S, T> for Gauss<STAGES, E> {
    type Memory = GaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, E, S, T: Real> Method<S, T> for Gauss<STAGES, E>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
    E: StageEvaluation<STAGES, S, T>,
{
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let mut equations = S::Kind::begin(system, q, v, t)?;
        let [mut y, mut slope, rest, increment, next]: [PointOf<S, T>; 5] =
            core::array::from_fn(|_| S::Kind::point(system));
        let [mut completed, slopes, terms, stages]: [StagesOf<STAGES, S, T>; 4] =
            core::array::from_fn(|_| S::Kind::point(system));
        S::Kind::gather(&mut equations, q, &mut y);
        S::Kind::evaluate(&mut equations, system, &y, t, &mut slope, &mut Statistics::default())
            .map_err(StartError::Starter)?;
        for (packs, numbers) in completed.iter_mut().zip(slope.iter()) {
            for (pack, &number) in packs.iter_mut().zip(numbers.iter()) {
                *pack = Lanes::all(number);
            }
        }
        Ok(GaussMemory {
            equations,
            coefficients: Coefficients::new(),
            completed,
            rest,
            slopes,
            terms,
            stages,
            y,
            increment,
            next,
            work: StageWork::new(system),
        })
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        E::run(Steps { method: self, system, memory, q, clock: Clock::new(t, h), count: 1, statistics }).1
    }

    fn steps(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        clock: Clock<T>,
        count: u64,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let (taken, result) = E::run(Steps { method: self, system, memory, q, clock, count, statistics });
        statistics.steps += taken;
        result
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        S::Kind::velocity(&memory.equations, system, q, t, v)
    }
}

impl<const STAGES: usize, E, S, T: Real> VariableStep<S, T> for Gauss<STAGES, E>
where
    S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>,
    E: StageEvaluation<STAGES, S, T>,
{
}

/// Up to `count` steps.
struct Steps<'a, const STAGES: usize, E, S: System<Kind: Motion<S, T>>, T: Real> {
    method: &'a Gauss<STAGES, E>,
    system: &'a S,
    memory: &'a mut GaussMemory<STAGES, S, T>,
    q: &'a mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
    statistics: &'a mut Statistics,
}

impl<const STAGES: usize, E, S, T: Real> Task for Steps<'_, STAGES, E, S, T>
where
    S: System<Kind: FirstOrder<S, T>>,
    E: StageEvaluation<STAGES, S, T>,
{
    /// How many have succeeded.
    type Output = (u64, Result<(), StepFailure>);

    #[inline(always)]
    fn run(mut self) -> Self::Output {
        for taken in 0..self.count {
            if let Err(failure) = self.step(self.clock.after(taken).time(), self.clock.step_size()) {
                return (taken, Err(failure));
            }
        }
        (self.count, Ok(()))
    }
}

impl<const STAGES: usize, E, S, T: Real> Steps<'_, STAGES, E, S, T>
where
    S: System<Kind: FirstOrder<S, T>>,
    E: StageEvaluation<STAGES, S, T>,
{
    #[inline(always)]
    fn step(&mut self, t: T, h: T) -> Result<(), StepFailure> {
        let Self { method, system, memory, q, statistics, .. } = self;
        let (stopping, summation) = (method.stopping, method.summation);
        S::Kind::gather(&mut memory.equations, q, &mut memory.y);
        memory.guess(h);
        let speed = largest(&memory.slopes[0]);
        let speed = norm::larger(speed, S::Kind::cancelling(&mut memory.equations, system, &memory.y, t)?);
        let scale = norm::largest(q) + Scalar::abs(h) * speed;
        let stopping = match summation {
            Summation::Plain => stopping,
            Summation::Compensated => stopping.exhaustive(),
        };
        let convergence = Convergence::fixed_point(stopping, scale, q, stopping.max_iterations);
        let stages: Stages<'_, STAGES, E, S, T> = Stages { system, memory, t, h, evaluation: PhantomData };
        repeat(convergence, statistics, stages)?;
        if S::Kind::has_velocity_forces() {
            // Those of the last iteration belong to the velocities before it.
            memory.evaluate_part::<E>(1, system, t, h, statistics)?;
        }
        memory.arrive(summation, system, q, t, h)
    }
}

/// The stages of a step as they are iterated.
struct Stages<'a, const STAGES: usize, E, S: System<Kind: Motion<S, T>>, T: Real> {
    system: &'a S,
    memory: &'a mut GaussMemory<STAGES, S, T>,
    t: T,
    h: T,
    evaluation: PhantomData<E>,
}

impl<const STAGES: usize, E, S, T: Real> Iteration<T> for Stages<'_, STAGES, E, S, T>
where
    S: System<Kind: FirstOrder<S, T>>,
    E: StageEvaluation<STAGES, S, T>,
{
    /// Evaluates all stages once, momenta before coordinates, and returns the largest change of h times a velocity: the
    /// momenta follow from the velocities.
    #[inline(always)]
    fn improve(&mut self, statistics: &mut Statistics) -> Result<T, StepFailure> {
        let Self { system, memory, t, h, .. } = self;
        let mut largest = T::lift(0.0);
        for part in (0..memory.y.len()).rev() {
            largest = memory.evaluate_part::<E>(part, system, *t, *h, statistics)?;
        }
        Ok(Scalar::abs(*h) * largest)
    }
}

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> GaussMemory<STAGES, S, T> {
    /// Continues the polynomial through the completed stages into the next step.
    #[inline(always)]
    fn guess(&mut self, h: T) {
        let Self { coefficients, completed, slopes, terms, y, .. } = self;
        let weights = Lanes::all(h) * coefficients.b;
        for part in 0..y.len() {
            let nothing = |_| [T::lift(0.0); 2];
            combine(&coefficients.continuation, &completed[part], nothing, &mut slopes[part]);
            for (term, &slope) in terms[part].iter_mut().zip(slopes[part].iter()) {
                *term = weights * slope;
            }
        }
    }

    /// Evaluates one part of the slopes of all stages, and returns the largest change of one.
    #[inline(always)]
    fn evaluate_part<E: StageEvaluation<STAGES, S, T>>(
        &mut self,
        part: usize,
        system: &S,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        let Self { equations, coefficients, slopes, terms, stages, y, rest, work, .. } = self;
        // Forces depend on coordinates and velocities, velocities on momenta and, as these, on coordinates that are in place.
        let moved = (part + 1) % y.len();
        let from = |k: usize| [y[moved][k], rest[moved][k]];
        combine(&coefficients.mu, &terms[moved], from, &mut stages[moved]);
        let times = Lanes::all(t) + coefficients.c * Lanes::all(h);
        let at = AtStages { system, y: &*stages, t: times };
        let weights = Lanes::all(h) * coefficients.b;
        let changes = [T::lift(0.0); STAGES];
        let mut renewed = Slopes { slopes, terms: &mut terms[part], part, weights, changes };
        E::evaluate_part(equations, &at, work, &mut renewed, statistics)?;
        Ok(norm::largest(&renewed.changes))
    }

    /// Moves to the end of the step.
    #[inline(always)]
    fn arrive(
        &mut self,
        summation: Summation,
        system: &S,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<(), StepFailure> {
        let Self { equations, completed, slopes, terms, y, rest, increment, next, .. } = self;
        for part in 0..y.len() {
            let numbers = y[part].iter().zip(rest[part].iter()).zip(terms[part].iter());
            let moved = increment[part].iter_mut().zip(next[part].iter_mut());
            for ((increment, next), ((&y, &rest), terms)) in moved.zip(numbers) {
                *increment = terms.0.iter().fold(T::lift(0.0), |sum, &term| sum + term);
                *next = y + (*increment + rest);
            }
        }
        S::Kind::arrive(equations, system, next, q, t + h)?;
        if summation == Summation::Compensated {
            for part in 0..y.len() {
                let sums = y[part].iter().zip(increment[part].iter()).zip(next[part].iter());
                for (rest, ((&y, &increment), &next)) in rest[part].iter_mut().zip(sums) {
                    *rest = left_out(y, increment + *rest, next);
                }
            }
        }
        for (completed, slopes) in completed.iter_mut().zip(slopes.iter()) {
            completed.copy_from_slice(slopes);
        }
        Ok(())
    }
}
