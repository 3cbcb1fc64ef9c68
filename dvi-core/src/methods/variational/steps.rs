//! Which L are stepped, by the traits of a method and of one between impacts, and the discrete energy of a
//! step, E_d = −∂L_d/∂h = Σⱼ wⱼ E(qʲ, Δ/h) with linear interpolation.

use super::coefficients::Coefficients;
use super::lagrangian::{Interpolated, read};
use super::{Interpolation, Variational, verlet};
use crate::discrete::frequency::{Frequency, Local, Reading, Unfitted};
use crate::discrete::quadrature::Rule;
use crate::discrete::{Interval, Span};
use crate::error::{StartError, StepFailure};
use crate::methods::flight::Flight;
use crate::methods::step::{Attempt, Carried, PhaseMemory};
use crate::methods::{Carries, Clock, DiscreteEnergy, FreeFlight, Here, Method, PreservedForm};
use crate::methods::{Step, Steps, VariableStep, scheme};
use crate::solve::Solver;
use crate::{NondegenerateLagrangian, Real, RegularLagrangian, System, Vector};

scheme! {
    [F: Frequency, R: Rule] Variational<F, R>, |method|
    order: if method.rule.is_exact_for_linear() { 2 } else { 1 },
    is_symmetric: method.rule.is_symmetric() && method.frequency.reading() != Some(Reading::LeftFrozen),
    preserved_form: match method.frequency.reading() {
        None | Some(Reading::Variational) => PreservedForm::Canonical,
        Some(Reading::LeftFrozen | Reading::Averaged) => PreservedForm::Nothing,
    },
}

impl<S: System, F, R, T: Real> Carries<S, T> for Variational<F, R> {
    type Memory = PhaseMemory<S, T, Interpolation<S, T>>;
}

impl<S: NondegenerateLagrangian<T>, F: Frequency, R: Rule, T: Real> Flight<S, T> for Variational<F, R> {
    fn carried(memory: &Self::Memory) -> &Carried<S, T> {
        &memory.carried
    }

    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate::<S, T>(system)?;
        let reading = self.frequency.reading();
        let solver = match self.solver.in_numbers::<T>() {
            _ if S::SEPARABLE && self.is_explicit() => Solver::FixedPoint,
            // Without a constant M there is no fixed point, and a variational frequency is stiff in Δ.
            Solver::Automatic if !S::CONSTANT_MASS || reading == Some(Reading::Variational) => {
                Solver::Newton
            }
            solver => solver,
        };
        let mut given = Coefficients::linear(&self.rule);
        if reading.is_none() {
            given.fix(self, h).map_err(StartError::Starter)?;
        }
        let own = Interpolation { given, ends: [Local::new(system), Local::new(system)] };
        PhaseMemory::new(system, (q, v, t), (solver, self.summation), own)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fly(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let PhaseMemory { carried, ladder, own: Interpolation { given, ends } } = memory;
        if S::SEPARABLE && F::UNFITTED && self.is_verlet() {
            let (taken, result) = verlet::steps(system, carried, q, Clock::new(t, h), 1);
            statistics.gradients += taken;
            return result;
        }
        let Self { stopping, summation, .. } = *self;
        let step = Attempt { system, interval: Interval { t, h }, stopping, summation, q, carried };
        macro_rules! take {
            ($read:ident) => {{
                let equations =
                    &mut Interpolated::<{ read::$read }, _, _, _, _> { method: self, given, ends };
                step.take(equations, ladder, statistics)
            }};
        }
        if F::UNFITTED {
            return take!(AT_THE_START);
        }
        match self.frequency.reading() {
            None | Some(Reading::LeftFrozen) => take!(AT_THE_START),
            Some(Reading::Averaged) => take!(AT_BOTH_ENDS),
            Some(Reading::Variational) => take!(WITH_ITS_DERIVATIVES),
        }
    }
}

impl<S: RegularLagrangian<T>, F: Frequency, R: Rule, T: Real> Method<S, T> for Variational<F, R> {
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.depart(system, q, v, t, h)
    }

    // A step of Simpson's rule with a frequency of one's own takes 859 instructions, and 902 without it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        self.fly(step, memory)
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }

    #[inline]
    fn steps(&self, steps: Steps<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        if S::SEPARABLE && F::UNFITTED && self.is_verlet() {
            let Steps { system, q, clock, count, statistics } = steps;
            let (taken, result) = verlet::steps(system, &mut memory.carried, q, clock, count);
            statistics.gradients += taken;
            statistics.steps += taken;
            result
        } else {
            steps.one_by_one(self, memory)
        }
    }

    const DISCRETE_ENERGY: Option<DiscreteEnergy<Self, S, T>> =
        if F::UNFITTED { Some(Self::energy_of) } else { None };
}

impl<S: RegularLagrangian<T>, F: Frequency, R: Rule, T: Real> VariableStep<S, T> for Variational<F, R> {
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

impl<F: Frequency, R: Rule> Variational<F, R> {
    /// Σ wⱼ E(qʲ, Δ/h), the discrete energy with linear interpolation.
    fn energy_of<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        Span { system, interval, q0, delta }: Span<'_, S, T>,
        [point, velocity]: &mut [Vector<S, T>; 2],
    ) -> T {
        let per_h = T::lift(1.0) / interval.h;
        for (velocity, &delta) in velocity.iter_mut().zip(delta) {
            *velocity = delta * per_h;
        }
        let nodes = self.rule.nodes().iter().zip(self.rule.weights());
        nodes.fold(T::lift(0.0), |sum, (&c, &weight)| {
            let c = T::lift(c);
            for (point, (&q0, &delta)) in point.iter_mut().zip(q0.iter().zip(delta)) {
                *point = q0 + c * delta;
            }
            sum + T::lift(weight) * system.energy(point, velocity, interval.time(c))
        })
    }
}

impl<S: NondegenerateLagrangian<T>, R: Rule, T: Real> FreeFlight<S, T> for Variational<Unfitted, R> {
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.carried.phase.jump(impulse, velocity);
    }

    const DISCRETE_ENERGY: Option<DiscreteEnergy<Self, S, T>> = Some(Self::energy_of);
}
