//! Gauss collocation on the equations of motion y' = X(y, t).
//!
//! Kᵢ = X(Yᵢ, t + cᵢh),   Yᵢ = y + Σⱼ μᵢⱼ Lⱼ,   y⁺ = y + Σᵢ Lᵢ,   Lᵢ = hbᵢ Kᵢ,   μᵢⱼ = aᵢⱼ/bⱼ
//!
//! with c the zeros of the shifted Legendre polynomial (Butcher 1964; Hairer, Lubich & Wanner 2006, section
//! II.1.3), written in the numbers L so that the step is symplectic in the arithmetic (Antoñana, Makazaga &
//! Murua 2017). The stages are iterated as a fixed point down to rounding errors, from the collocation
//! polynomial of the last step, continued; where that does not contract, they are found by Newton's method
//! (the module `newton`).
//!
//! Of q'' = M⁻¹f(q, t) with a constant diagonal M only forces are evaluated in the iteration (the module
//! `second_order`).
//!
//! Each number of a point stands once for each stage, in the lanes of a pack; the equations of motion are
//! evaluated stage by stage, or for all stages at once.

mod coefficients;
mod local_error;
mod memory;
mod newton;
mod second_order;

use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{Evaluation, FirstOrder, FirstOrderAtStages, InLanes, OneByOne};
use crate::memory::aside;
use crate::methods::collocation::stages::NewtonStages;
use crate::methods::{
    Carries, Here, Method, PreservedForm, Step, Tabulated, Tolerance, VariableStep, scheme,
};
use crate::scalar::simd::wide_if;
use crate::solve::{Convergence, Due, Guess, Ladder, Solver, Stopping, from_either_guess, repeat};
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{Lagrangian, Real, System, Vector};

use memory::{GaussMemory, Path};

/// Gauss collocation with `S` stages, 1 ≤ `S` ≤ 8, of order 2`S`, on the equations of motion y' = X(y, t).
///
/// ```math
/// K_i = X\Bigl(y + h \sum_j a_{ij} K_j,\ t + c_i h\Bigr), \qquad y^+ = y + h \sum_i b_i K_i
/// ```
///
/// Of a degenerate system y = q, and of a regular one y = (q, p). With `S` = 1 the method is the implicit
/// midpoint rule.
///
/// It is symmetric. On Hamilton's equations of a regular system it preserves dq ∧ dp, and all momenta that
/// are bilinear in q and p. On q' = X(q) of a degenerate system it preserves Ω if α is affine, and then all
/// quadratic momenta. The stages are found by a fixed point, which contracts if h is small against the
/// fastest time scale only. It begins on the polynomial through the stages of the last step and, where that
/// does not lead to a step, once more where the step begins. Where neither does, Newton's method
/// solves for the velocities of all stages at once, with the second derivatives of L: `S`² n² numbers stand
/// by for n coordinates. Where n is known when compiled, and they would take more than 128 kilobytes of the
/// stack, and for a fast sum over pairs, [`Solver::Automatic`] is [`Solver::FixedPoint`].
///
/// Where L = ½ v·M v − V(q, t) with a constant diagonal M, and forces have no velocities in them, the
/// velocities of the stages are eliminated, and only positions are iterated (Antoñana, Makazaga & Murua
/// 2025): it is the same method, in fewer operations.
///
/// [`in_lanes`](Self::in_lanes) evaluates all stages at once, in SIMD lanes, and gives the same numbers, bit
/// for bit: with eight stages, order 16, it is the method for energies that are to be kept to rounding
/// errors.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Gauss::<8>::new().in_lanes(), 0.3, start)?;
/// assert_eq!(run.method().order(), 16);
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gauss<const S: usize, E = OneByOne> {
    /// How steps are solved.
    pub solver: Solver,
    /// The criterion by which the stages count as converged. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Compensated`].
    pub summation: Summation,
    /// How the stages are evaluated.
    pub evaluation: E,
}

impl<const S: usize> Gauss<S> {
    /// The method with default options. A number of stages below 1 or above 8 does not compile.
    pub fn new() -> Self
    where
        Self: Tabulated,
    {
        Self {
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::Compensated,
            evaluation: OneByOne,
        }
    }

    /// The same with all stages evaluated at once.
    ///
    /// The equations of motion are evaluated on packs of `S` numbers where Ω couples the coordinates in
    /// pairs, or the mass matrix is constant and diagonal. Of other systems forces and ∇H are, and linear
    /// equations are solved stage by stage.
    #[must_use]
    pub fn in_lanes(self) -> Gauss<S, InLanes> {
        let Self { solver, stopping, summation, .. } = self;
        Gauss { solver, stopping, summation, evaluation: InLanes }
    }
}

impl<const S: usize> Default for Gauss<S>
where
    Self: Tabulated,
{
    fn default() -> Self {
        Self::new()
    }
}

scheme! {
    [const S: usize, E] Gauss<S, E>, |_|
    order: 2 * S,
    is_symmetric: true,
    preserved_form: PreservedForm::OmegaIfAffine,
}

impl<const STAGES: usize, E, S: System<Kind: FirstOrder<S, T>>, T: Real> Carries<S, T> for Gauss<STAGES, E> {
    type Memory = GaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, E, S, T: Real> Method<S, T> for Gauss<STAGES, E>
where
    S: Lagrangian<T> + System<Kind: FirstOrderAtStages<E, STAGES, S, T>>,
    E: Evaluation,
{
    type Suited<X> = <S::Kind as FirstOrder<S, T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let path = Path::begin(system, q, v, t)?;
        let solver = newton::solver::<STAGES, S, T>(self.solver)?;
        let stages = || NewtonStages::new(system, [q, v], t, solver.storing());
        let ladder = Ladder::new(solver, || aside(stages));
        Ok(GaussMemory { ladder, path })
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let GaussMemory { ladder, path } = memory;
        // Where Newton's method stands by, a fixed point that is slow is left to it.
        let budget = ladder.budget(self.stopping.max_iterations, 24 + q.len());
        wide_if!(E::WIDE, {
            ladder.solve(
                &mut (path, q),
                statistics,
                #[cfg_attr(not(debug_assertions), inline(always))]
                |(path, q), statistics| {
                    from_either_guess(
                        #[cfg_attr(not(debug_assertions), inline(always))]
                        |guess| self.attempt(system, path, q, [t, h], (guess, budget), statistics),
                    )
                },
                |(path, q), newton, guess, statistics| {
                    newton::solve(newton, system, path, (q, [t, h]), guess, self.stopping, statistics)?;
                    path.arrive(0, self.summation, system, q, [t, h])
                },
            )
        })
    }

    fn part_of_step(
        &self,
        part: Step<'_, S, T>,
        _whole: T,
        memory: &mut Self::Memory,
        taken: &Self::Memory,
    ) -> Result<(), StepFailure> {
        memory.path.follow(&taken.path);
        self.step(part, memory)
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        let Here { system, q, t } = here;
        S::Kind::velocity(&memory.path.equations, system, q, t, v)
    }

    fn place(
        &self,
        memory: &mut Self::Memory,
        index: usize,
        q: &mut Vector<S, T>,
        [v, _]: [&mut Vector<S, T>; 2],
    ) -> Option<T> {
        if STAGES < LONG {
            return None;
        }
        let path = &mut memory.path;
        if index == 0 {
            path.set_stages();
        }
        let c = path.coefficients.c.0.get(index)?;
        for (half, packs) in [(q, &path.stages[0]), (v, &path.slopes[0])] {
            for (number, pack) in half.iter_mut().zip(packs.iter()) {
                *number = pack.0[index];
            }
        }
        Some(*c)
    }

    const ESTIMATES_LOCAL_ERROR: bool = true;

    fn local_error(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        t: T,
        lengths: [T; 2],
        tolerance: Tolerance,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        memory.path.local_error::<E>(system, t, lengths, tolerance, statistics)
    }
}

/// From so many stages on a step may lead over more than one turn of a motion.
const LONG: usize = 6;

impl<const STAGES: usize, E, S, T: Real> VariableStep<S, T> for Gauss<STAGES, E>
where
    S: Lagrangian<T> + System<Kind: FirstOrderAtStages<E, STAGES, S, T>>,
    E: Evaluation,
{
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

impl<const STAGES: usize, E> Gauss<STAGES, E> {
    /// Takes a step from t to t + h by the fixed point, with stages that begin at a guess.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn attempt<S, T: Real>(
        &self,
        system: &S,
        path: &mut Path<STAGES, S, T>,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        (guess, budget): (Guess, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        S: System<Kind: FirstOrderAtStages<E, STAGES, S, T>>,
        E: Evaluation,
    {
        let Self { stopping, summation, .. } = *self;
        S::Kind::gather(&mut path.equations, q, &mut path.y);
        path.guess(guess, h);
        path.depart(system, h);
        let convergence = Convergence::fixed_point(stopping, budget);
        // Corrections are those of h times a velocity, or of positions: the momenta follow from these.
        repeat(
            convergence,
            statistics,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |due: &mut Due, statistics: &mut Statistics| {
                path.prepare(system, due, q, h);
                // Forces depend on coordinates and velocities, velocities on momenta and, as these, on
                // coordinates that are in place.
                for part in (1..path.y.len()).rev() {
                    if !S::Kind::OF_SECOND_ORDER {
                        path.reach((part + 1) % path.y.len());
                    }
                    path.evaluate_part::<E>(part, system, [t, h], statistics)?;
                }
                if let Some(change) = path.place::<false>(system, h) {
                    return Ok(change);
                }
                path.reach(1 % path.y.len());
                path.evaluate_part::<E>(0, system, [t, h], statistics)
            },
        )?;
        if S::Kind::HAS_VELOCITY_FORCES {
            // Those of the last iteration belong to the velocities before it.
            path.reach(0);
            path.evaluate_part::<E>(1, system, [t, h], statistics)?;
        }
        path.displace(h);
        path.arrive(Path::<STAGES, S, T>::FIRST_PART, summation, system, q, [t, h])
    }
}
