//! Explicit Runge–Kutta methods on the equations of motion y' = X(y, t): the baselines.

use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{EquationsOf, FirstOrder, PointOf};
use crate::memory::lasting;
use crate::methods::{Carries, Here, Method, PreservedForm, Step, VariableStep, scheme};
use crate::scalar::passes::kick;
use crate::shown::shown;
use crate::{Lagrangian, Real, System, Vector};

/// The largest number of stages.
const STAGES: usize = 4;

/// The coefficients of an explicit method, zero beyond its stages: loops over them are of known length.
#[derive(Debug, PartialEq)]
struct Tableau {
    order: usize,
    /// Row i: the weights of the stages before stage i.
    a: [[f64; STAGES - 1]; STAGES],
    b: [f64; STAGES],
}

const THIRD: f64 = 1.0 / 3.0;
const SIXTH: f64 = 1.0 / 6.0;
const NONE: [f64; STAGES - 1] = [0.0; STAGES - 1];

static MIDPOINT: Tableau =
    Tableau { order: 2, a: [NONE, [0.5, 0.0, 0.0], NONE, NONE], b: [0.0, 1.0, 0.0, 0.0] };

static HEUN: Tableau = Tableau { order: 2, a: [NONE, [1.0, 0.0, 0.0], NONE, NONE], b: [0.5, 0.5, 0.0, 0.0] };

static CLASSICAL: Tableau = Tableau {
    order: 4,
    a: [NONE, [0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]],
    b: [SIXTH, THIRD, THIRD, SIXTH],
};

/// An explicit Runge–Kutta method on the equations of motion y' = X(y, t).
///
/// ```math
/// k_i = X\Bigl(y + h \sum_{j < i} a_{ij} k_j,\ t + c_i h\Bigr), \qquad y^+ = y + h \sum_i b_i k_i
/// ```
///
/// Of a degenerate system y = q, and of a regular one y = (q, p). The method is neither symmetric nor
/// symplectic: the energy drifts, and so do all momenta but linear ones on nonlinear systems.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, RungeKutta::classical(), 0.2, start)?;
/// let energy = run.energy();
/// run.take_steps(1000)?;
/// let first = energy - run.energy();
/// run.take_steps(9000)?;
/// assert!((energy - run.energy()) / first > 5.0); // the energy drifts
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungeKutta {
    tableau: &'static Tableau,
}

impl RungeKutta {
    /// Order 2: y⁺ = y + h X(y + ½h X(y)) (Runge 1895).
    pub fn midpoint() -> Self {
        Self { tableau: &MIDPOINT }
    }

    /// Order 2: y⁺ = y + ½h (k₁ + X(y + h k₁)) (Heun 1900).
    pub fn heun() -> Self {
        Self { tableau: &HEUN }
    }

    /// Order 4: "the" Runge–Kutta method (Kutta 1901).
    pub fn classical() -> Self {
        Self { tableau: &CLASSICAL }
    }
}

/// The stages of a Runge–Kutta step.
pub struct RungeKuttaMemory<S: System<Kind: FirstOrder<S, T>>, T: Real> {
    equations: EquationsOf<S, T>,
    slopes: [PointOf<S, T>; STAGES],
    /// Where the step begins, and where a stage is.
    y: PointOf<S, T>,
    stage: PointOf<S, T>,
}

lasting!([S: System<Kind: FirstOrder<S, T>>, T: Real] RungeKuttaMemory<S, T>, T; part equations);

shown!([S: System<Kind: FirstOrder<S, T>>, T: Real] RungeKuttaMemory<S, T>, |memory| slopes: memory.slopes);

scheme! {
    [] RungeKutta, |method|
    order: method.tableau.order,
    is_symmetric: false,
    preserved_form: PreservedForm::Nothing,
}

impl<S: System<Kind: FirstOrder<S, T>>, T: Real> Carries<S, T> for RungeKutta {
    type Memory = RungeKuttaMemory<S, T>;
}

impl<S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>, T: Real> Method<S, T> for RungeKutta {
    type Suited<X> = <S::Kind as FirstOrder<S, T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        let ([y, stage], slopes) = (S::Kind::points(system), S::Kind::points(system));
        Ok(RungeKuttaMemory { equations: S::Kind::begin(system, q, v, t)?, slopes, y, stage })
    }

    #[inline]
    fn step(&self, mut step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        S::Kind::gather(&mut memory.equations, step.q, &mut memory.y);
        evaluate::<0, S, T>(self.tableau, &mut step, memory)?;
        evaluate::<1, S, T>(self.tableau, &mut step, memory)?;
        if self.tableau.order > 2 {
            evaluate::<2, S, T>(self.tableau, &mut step, memory)?;
            evaluate::<3, S, T>(self.tableau, &mut step, memory)?;
        }
        let RungeKuttaMemory { equations, slopes, y, stage } = memory;
        combine::<S, T>(y, step.h, &self.tableau.b, slopes, stage);
        S::Kind::arrive(equations, step.system, stage, step.q, step.t + step.h)
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        let Here { system, q, t } = here;
        S::Kind::velocity(&memory.equations, system, q, t, v)
    }
}

impl<S: Lagrangian<T> + System<Kind: FirstOrder<S, T>>, T: Real> VariableStep<S, T> for RungeKutta {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

/// Evaluates the slope of a stage. With its number in the type nothing is asked that the compiler knows.
#[inline]
fn evaluate<const STAGE: usize, S: System<Kind: FirstOrder<S, T>>, T: Real>(
    tableau: &Tableau,
    Step { system, t, h, statistics, .. }: &mut Step<'_, S, T>,
    RungeKuttaMemory { equations, slopes, y, stage }: &mut RungeKuttaMemory<S, T>,
) -> Result<(), StepFailure> {
    let a = &tableau.a[STAGE][..STAGE];
    combine::<S, T>(y, *h, a, slopes, stage);
    let time = *t + T::lift(a.iter().sum()) * *h;
    if STAGE > 0 {
        S::Kind::compare(equations, system, stage, time)?;
    }
    S::Kind::evaluate(equations, system, stage, time, &mut slopes[STAGE], statistics)
}

/// Sets `out` to y + h Σ wⱼ kⱼ.
fn combine<S: System<Kind: FirstOrder<S, T>>, T: Real>(
    y: &PointOf<S, T>,
    h: T,
    weights: &[f64],
    slopes: &[PointOf<S, T>],
    out: &mut PointOf<S, T>,
) {
    for (part, (out, y)) in out.iter_mut().zip(y.iter()).enumerate() {
        out.copy_from_slice(y);
        for (&weight, slope) in weights.iter().zip(slopes) {
            if weight != 0.0 {
                kick(out, h * T::lift(weight), &slope[part]);
            }
        }
    }
}
