//! The discrete Lagrangian of a rule and an interpolation, for any L and any frequency.
//!
//! D₁L_d = Σ w (h b ∂L/∂q + B ∂L/∂v)      D₂L_d = Σ w (h b̄ ∂L/∂q + B̄ ∂L/∂v)
//! D₁D₂L_d = Σ w (h b b̄ L_qq + b B̄ L_qv + B b̄ L_vq + B B̄ L_vv/h),
//! and D₁D₁L_d, D₂D₂L_d with b, B or b̄, B̄ twice
//!
//! With a variational frequency, L_d = ℓ(q0, q1, ω(q0, q1)) and D₁L_d = ∂ℓ/∂q0 + ∂ℓ/∂ω ∂ω/∂q0: the first
//! derivatives are exact, and D₁D₂L_d is that of ω held constant.

use super::coefficients::{Coefficients, End};
use super::{Step, Variational};
use crate::discrete::basis::Basis;
use crate::discrete::frequency::{Frequency, FrequencyIn, GivenFrequency, Local, Reading};
use crate::discrete::quadrature::Rule;
use crate::discrete::{DiscreteLagrangian, Ends, Interval, NodeWork, Span, TwiceDifferentiable};
use crate::error::{StartError, StepFailure};
use crate::methods::step::{Begin, Equations};
use crate::methods::{InnerScheme, VariationalMethod, without_effect_inside};
use crate::space::sink::Sink;
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, System};

/// Rule and interpolation, for a frequency that may be read where a step begins and ends.
pub(super) struct Interpolated<'a, S: System, F, R, T: Real> {
    pub(super) method: &'a Variational<F, R>,
    pub(super) coefficients: &'a mut Coefficients<T>,
    /// The frequencies at both ends.
    pub(super) ends: &'a mut [Local<S, T>; 2],
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> Interpolated<'_, S, F, R, T> {
    /// The coefficients for the frequency at these ends.
    fn read_frequency(
        &mut self,
        step: &Step<'_, S, F, R, T>,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        node: &mut NodeWork<S, T>,
    ) -> Result<(), StepFailure> {
        if F::UNFITTED {
            return self.coefficients.fix(step);
        }
        let Some(reading) = self.method.frequency.reading() else { return self.coefficients.fix(step) };
        // Where L is not separable, a frequency that is read has been refused.
        let Some(mass) = begin.mass else { return Err(StepFailure::Frequency { omega: f64::NAN }) };
        let (frequency, per_h) = (&self.method.frequency, T::lift(1.0) / step.h);
        let NodeWork { point: next, velocity, gradient, .. } = node;
        let ([start, end], q0, force) = (&mut *self.ends, begin.q, &begin.phase.force);
        for i in 0..q0.len() {
            next[i] = q0[i] + delta[i];
            velocity[i] = delta[i] * per_h;
        }
        let (t0, t1) = (step.t, step.node_time(1.0));
        match reading {
            Reading::LeftFrozen => {
                mass.solve(&begin.phase.p, velocity);
                start.evaluate(frequency, mass, q0, velocity, force)?;
                return self.coefficients.set(step, start.omega);
            }
            Reading::Averaged => {
                start.evaluate(frequency, mass, q0, velocity, force)?;
                step.system.force(next, &[], t1, gradient);
                end.evaluate(frequency, mass, next, velocity, gradient)?;
            }
            Reading::Variational => {
                start.differentiate(frequency, mass, step.system, q0, velocity, t0)?;
                end.differentiate(frequency, mass, step.system, next, velocity, t1)?;
            }
        }
        self.coefficients.set(step, T::lift(0.5) * (start.omega + end.omega))
    }

    /// Adds ∂ℓ/∂ω ∂ω/∂q0 to `d1`, and with it ∂ℓ/∂ω ∂ω/∂q1 to `sum`, if the frequency is variational.
    fn vary_frequency(
        &mut self,
        step: &Step<'_, S, F, R, T>,
        at: Ends<'_, T>,
        node: &mut NodeWork<S, T>,
        d1: &mut [T],
        sum: Option<&mut [T]>,
    ) {
        if F::UNFITTED || self.method.frequency.reading() != Some(Reading::Variational) {
            return;
        }
        let [start, end] = &*self.ends;
        let half = T::lift(0.5) * self.coefficients.slope(step, node, at, start.omega + end.omega);
        for (i, d1) in d1.iter_mut().enumerate() {
            let by_velocity = (start.dv[i] + end.dv[i]) / step.h;
            *d1 += half * (start.dq[i] - by_velocity);
        }
        if let Some(sum) = sum {
            for (i, sum) in sum.iter_mut().enumerate() {
                *sum += half * (start.dq[i] + end.dq[i]);
            }
        }
    }
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> Equations<S, T>
    for Interpolated<'_, S, F, R, T>
{
    fn evaluate(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        node: &mut NodeWork<S, T>,
        [d1, sum]: [&mut [T]; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Interval { t, h } = begin.interval;
        let (step, ends) =
            (Step { system: begin.system, method: self.method, t, h }, Ends { q0: begin.q, delta });
        self.read_frequency(&step, begin, delta, node)?;
        add_derivatives(&step, self.coefficients, ends, node, [d1, sum], statistics);
        self.vary_frequency(&step, ends, node, d1, Some(sum));
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        node: &mut NodeWork<S, T>,
        d1: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Interval { t, h } = begin.interval;
        let (step, ends) =
            (Step { system: begin.system, method: self.method, t, h }, Ends { q0: begin.q, delta });
        self.read_frequency(&step, begin, delta, node)?;
        add_linearized(&step, self.coefficients, ends, node, d1, sink);
        self.vary_frequency(&step, ends, node, d1, None);
        Ok(())
    }

    /// The stiffness of the fitted oscillator.
    fn per_stiffness(&self) -> T {
        self.coefficients.sums.inverse_kappa
    }
}

/// The discrete Lagrangian of a rule and of an interpolation that is linear or fitted to a frequency that is
/// given, with the storage that it needs.
#[derive(Debug)]
pub struct QuadratureLagrangian<S: System, F, R, T: Real = f64> {
    method: Variational<F, R>,
    coefficients: Coefficients<T>,
    node: NodeWork<S, T>,
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> QuadratureLagrangian<S, F, R, T> {
    pub(super) fn new(system: &S, method: Variational<F, R>) -> Self {
        let coefficients = Coefficients::linear(&method.rule);
        Self { method, coefficients, node: NodeWork::new(system) }
    }
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> DiscreteLagrangian<S, T>
    for QuadratureLagrangian<S, F, R, T>
{
    fn derivatives(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { method, coefficients, node } = self;
        let step = Step { system, method, t: interval.t, h: interval.h };
        coefficients.fix(&step)?;
        add_derivatives(&step, coefficients, ends, node, [d1, sum], statistics);
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { method, coefficients, node } = self;
        let step = Step { system, method, t: interval.t, h: interval.h };
        coefficients.fix(&step)?;
        add_linearized(&step, coefficients, ends, node, d1, sink);
        Ok(())
    }
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> TwiceDifferentiable<S, T>
    for QuadratureLagrangian<S, F, R, T>
{
    fn hessian<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        [d11, d12, d21, d22]: [&mut K; 4],
    ) -> Result<(), StepFailure> {
        let Self { method, coefficients, node: work } = self;
        let step = Step { system, method, t: interval.t, h: interval.h };
        coefficients.fix(&step)?;
        for (node, &c) in method.rule.nodes().iter().enumerate() {
            coefficients.place(node, step.h, ends, work);
            let at = [step.node_time(c), step.h];
            coefficients.add_second(node, [End::Left, End::Left], system, at, work, d11);
            coefficients.add_second(node, [End::Left, End::Right], system, at, work, d12);
            coefficients.add_second(node, [End::Right, End::Left], system, at, work, d21);
            coefficients.add_second(node, [End::Right, End::Right], system, at, work, d22);
        }
        Ok(())
    }
}

/// Adds D₁ℓ and (D₁ + D₂)ℓ.
fn add_derivatives<S: NondegenerateLagrangian<T>, F: Frequency, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &Coefficients<T>,
    ends: Ends<'_, T>,
    work: &mut NodeWork<S, T>,
    [d1, sum]: [&mut [T]; 2],
    statistics: &mut Statistics,
) {
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        coefficients.place(node, step.h, ends, work);
        let NodeWork { point, velocity, gradient, momentum } = &mut *work;
        step.system.gradient(point, velocity, step.node_time(c), gradient, momentum);
        statistics.gradients += 1;
        let (weight, Basis { b, b_bar, d, d_bar }) = (coefficients.weights[node], coefficients.bases[node]);
        for (i, sum) in sum.iter_mut().enumerate() {
            *sum += weight * (step.h * (b + b_bar) * gradient[i] + (d + d_bar) * momentum[i]);
        }
        add_first(coefficients, node, step.h, work, d1);
    }
}

/// Adds D₁ℓ and D₁D₂ℓ.
fn add_linearized<S: NondegenerateLagrangian<T>, F: Frequency, R: Rule, T: Real, K: Sink<T>>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &Coefficients<T>,
    ends: Ends<'_, T>,
    work: &mut NodeWork<S, T>,
    d1: &mut [T],
    sink: &mut K,
) {
    for (node, &c) in step.method.rule.nodes().iter().enumerate() {
        coefficients.place(node, step.h, ends, work);
        let at = [step.node_time(c), step.h];
        coefficients.add_second(node, [End::Left, End::Right], step.system, at, work, sink);
        add_first(coefficients, node, step.h, work, d1);
    }
}

/// Adds the part of D₁ℓ that a node has, from the derivatives of L there.
fn add_first<S: NondegenerateLagrangian<T>, T: Real>(
    coefficients: &Coefficients<T>,
    node: usize,
    h: T,
    NodeWork { gradient, momentum, .. }: &NodeWork<S, T>,
    d1: &mut [T],
) {
    let (weight, Basis { b, d, .. }) = (coefficients.weights[node], coefficients.bases[node]);
    for (i, d1) in d1.iter_mut().enumerate() {
        *d1 += weight * (h * b * gradient[i] + d * momentum[i]);
    }
}

impl<S, F, R, T> VariationalMethod<S, T> for Variational<F, R>
where
    S: NondegenerateLagrangian<T>,
    F: FrequencyIn<T> + GivenFrequency + Clone,
    R: Rule + Clone,
    T: Real,
{
    type DiscreteLagrangian = QuadratureLagrangian<S, F, R, T>;

    fn admit(&self, system: &S) -> Result<(), StartError> {
        self.validate::<S, T>(system)
    }

    fn discrete_lagrangian(&self, system: &S) -> QuadratureLagrangian<S, F, R, T> {
        QuadratureLagrangian::new(system, self.clone())
    }
}

impl<S: NondegenerateLagrangian<T>, F, R, T: Real> InnerScheme<S, T> for Variational<F, R>
where
    Self: VariationalMethod<S, T>,
{
    fn admit_inside(&self) -> Result<(), StartError> {
        without_effect_inside(self.solver, self.stopping, self.summation)
    }
}
