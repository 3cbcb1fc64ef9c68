//! One-step schemes for degenerate systems in class, α = ϑ(x, y)·dx.
//!
//! As α has no component along y, the discrete Lagrangian of a rule with nodes cⱼ and weights wⱼ needs one ȳ
//! for the step,
//!
//! L_d(x0, x1, ȳ) = h Σⱼ wⱼ L((x0 + cⱼΔ, ȳ), Δ/h),   Δ = x1 − x0, stationary in ȳ,
//!
//! so that its step couples two points and not three (Ellison, Finn, Burby, Kraus, Qin & Tang 2018; Burby,
//! Finn & Ellison 2022). With f = ∂L/∂q it is
//!
//! p0 = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ),   0 = Σⱼ wⱼ f_yⱼ,   p1 = p0 + h Σⱼ wⱼ f_xⱼ,   ϑ(x1, y1) = p1

mod attempt;
mod equations;
mod gauss;
mod split;

use crate::error::{StartError, StepFailure};
use crate::memory::lasting;
use crate::methods::one_point::OnePoint;
use crate::methods::{self, Carries, Method, PreservedForm, VariableStep, scheme};
use crate::solve::{Convergence, Guess, Quick, Stopping, from_either_guess};
use crate::state::Statistics;
use crate::{ProperlyDegenerate, Real, Space, System, Vector};
use attempt::Work;
use equations::{Rule, Step};
pub use gauss::OneStepGauss;

/// A one-step scheme for degenerate systems in class: [`ProperlyDegenerate`].
///
/// In class, α = ϑ(x, y)·dx has components along one half x of the coordinates only. The schemes couple two
/// points, and not three as [`Sigma`](crate::methods::Sigma) does, so that they have no parasitic mode. With
/// p = ϑ(q), f = ∂L/∂q, v = Δ/h and Δ = x1 − x0 they are
///
/// ```math
/// \begin{aligned}
/// \text{midpoint:} && \vartheta(\tilde q) &= p_0 + \tfrac h2 f_x(\tilde q, v), & f_y(\tilde q, v) &= 0,
///     & p_1 &= p_0 + h f_x(\tilde q, v) \\
/// \text{trapezoid:} && \tfrac12(\vartheta^- + \vartheta^+) &= p_0 + \tfrac h2 f_x^-, & f_y^- + f_y^+ &= 0,
///     & p_1 &= p_0 + \tfrac h2 (f_x^- + f_x^+)
/// \end{aligned}
/// ```
///
/// where q̃ = (x0 + ½Δ, ȳ), and the signs − and + stand for values at (x0, ȳ) and (x1, ȳ). Both end with
/// ϑ(q1) = p1, are of order 2 and symmetric, and preserve Ω.
///
/// A step is solved by Newton's method with all second derivatives of L. If Ω does not couple the
/// coordinates in pairs, ϑ = p is solved by full elimination of n/2 rows. A step that would lead to another
/// branch of ϑ(x, y) = p ends with [`StepFailure::Orientation`](crate::error::StepFailure::Orientation), as
/// far as Ω has another sign halfway. A system that is not in class has no such scheme, and using one is a
/// compile error: out of class their equations converge to a wrong motion.
///
/// ```
#[doc = include_str!("../../docs/hidden/predators.txt")]
/// let mut run = Integrator::new(&Predators, OneStep::midpoint(), 0.05, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneStep {
    rule: Rule,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl OneStep {
    /// One node, at the centre.
    pub fn midpoint() -> Self {
        Self::of(Rule::Midpoint)
    }

    /// A node at each end.
    pub fn trapezoid() -> Self {
        Self::of(Rule::Trapezoid)
    }

    fn of(rule: Rule) -> Self {
        Self { rule, stopping: Stopping::default() }
    }
}

scheme! {
    [] OneStep, |_|
    order: 2,
    is_symmetric: true,
    preserved_form: PreservedForm::Omega,
}

/// What a run of a one-step scheme carries.
#[derive(Debug)]
pub struct OneStepMemory<S: System, T: Real> {
    /// With the rates of x, and those of y to where it stands in the equations; and along y by how much the
    /// rate from there to the end was another. α is zero along y.
    point: Point<S, T>,
    work: Work<S, T>,
}

lasting!([S: System, T: Real] OneStepMemory<S, T>, T; part point);

type Point<S, T> = OnePoint<S, T, 2>;

impl<S: System, T: Real> Carries<S, T> for OneStep {
    type Memory = OneStepMemory<S, T>;
}

impl<S: ProperlyDegenerate<T>, T: Real> Method<S, T> for OneStep {
    type Suited<X> = <S as ProperlyDegenerate<T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, _: &[T], t: T, _: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let point = Point::new(system, q, t, |rates| [rates, system.space().vector()])?;
        Ok(OneStepMemory { point, work: Work::new(system, q, t) })
    }

    #[inline]
    fn step(&self, step: methods::Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let methods::Step { system, q, t, h, statistics } = step;
        let mut guess = Guess::Extrapolated;
        if S::Space::ON_STACK && self.rule == Rule::Midpoint {
            // What no other function sees may stay in registers, and of one rule the compiler knows the
            // nodes. Nothing up to `leave` may therefore be a closure or a function that is not inlined.
            let (point, mut work) = (&mut memory.point, Work::new(system, q, t));
            let step = Step { system, q: &*q, t, h, rule: Rule::Midpoint };
            let mut cost = Statistics::default();
            let attempt = work.attempt::<Quick<T>>(&step, point, (guess, self.stopping), &mut cost);
            *statistics += cost;
            match attempt {
                Ok(()) => {
                    work.leave(q, point, h);
                    return Ok(());
                }
                // It may have given up where there is more to find out.
                Err(StepFailure::NotConverged { .. }) => {}
                Err(_) => guess = Guess::Zero,
            }
        }
        self.solve(system, memory, q, [t, h], guess, statistics)
    }
}

impl<S: ProperlyDegenerate<T>, T: Real> VariableStep<S, T> for OneStep {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

impl OneStep {
    /// A step from `guess`, of any rule and in any space.
    #[inline(never)]
    fn solve<S: ProperlyDegenerate<T>, T: Real>(
        &self,
        system: &S,
        OneStepMemory { point, work }: &mut OneStepMemory<S, T>,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let step = Step { system, q: &*q, t, h, rule: self.rule };
        let mut attempt =
            |guess| work.attempt::<Convergence<T>>(&step, point, (guess, self.stopping), statistics);
        match guess {
            Guess::Extrapolated => from_either_guess(attempt)?,
            Guess::Zero => attempt(guess)?,
        }
        work.leave(q, point, h);
        Ok(())
    }
}
