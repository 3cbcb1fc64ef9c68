//! The [discrete Lagrangian](crate::discrete) of a rule and an interpolation, for any L and any frequency.
//!
//! With a variational frequency, L_d = ℓ(q0, q1, ω(q0, q1)) and D₁L_d = ∂ℓ/∂q0 + ∂ℓ/∂ω ∂ω/∂q0: the first
//! derivatives are exact, and D₁D₂L_d is that of ω held constant.

use super::Variational;
use super::coefficients::{Coefficients, Placed};
use crate::discrete::basis::Basis;
use crate::discrete::frequency::{Frequency, Local, Unfitted};
use crate::discrete::quadrature::Rule;
use crate::discrete::{DiscreteLagrangian, Interval, NodeWork, Nodes, Span, linearize};
use crate::error::StepFailure;
use crate::methods::VariationalMethod;
use crate::methods::step::{Begin, Equations, Kinetic, Share, set_force};
use crate::scalar::passes::kick;
use crate::space::Sink;
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, System};

/// When a frequency is read from the motion, which the compiler knows in the loop of an iteration.
pub(super) mod read {
    /// There, or not at all.
    pub(in super::super) const AT_THE_START: usize = 0;
    /// The mean of both ends.
    pub(in super::super) const AT_BOTH_ENDS: usize = 1;
    /// The same, as a function of the ends.
    pub(in super::super) const WITH_ITS_DERIVATIVES: usize = 2;
}

/// Rule and interpolation, for a frequency that is given or [`READ`](read) from the motion.
pub(super) struct Interpolated<'a, const READ: usize, S: System, F, R, T: Real> {
    pub(super) method: &'a Variational<F, R>,
    /// Those of a frequency that is given, for the last length of a step.
    pub(super) given: &'a mut Coefficients<T>,
    /// The frequencies at both ends.
    pub(super) ends: &'a mut [Local<S, T>; 2],
}

impl<const READ: usize, S: NondegenerateLagrangian<T>, F: Frequency, R: Rule, T: Real>
    Interpolated<'_, READ, S, F, R, T>
{
    /// Reads the coefficients for the frequency that depends on both ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read_both_ends(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        share: Share<'_, T>,
        (coefficients, node): (&mut Coefficients<T>, &mut NodeWork<S, T>),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        if READ == read::AT_THE_START {
            return Ok(());
        }
        let Self { method: Variational { frequency, .. }, ends: [start, end], .. } = self;
        let NodeWork { point: next, velocity, gradient, .. } = node;
        let Begin { system, interval, q, phase, .. } = begin;
        let (mass, per_h, t1) = (begin.mass, T::lift(1.0) / interval.h, interval.time(T::lift(1.0)));
        for i in 0..q.len() {
            next[i] = q[i] + delta[i];
            velocity[i] = delta[i] * per_h;
        }
        if READ == read::WITH_ITS_DERIVATIVES {
            start.differentiate(frequency, mass, system, q, velocity, interval.t)?;
            end.differentiate(frequency, mass, system, next, velocity, t1)?;
        } else {
            let force = match share {
                Share::Both { force } => force,
                Share::Left => {
                    set_force(*system, next, t1, gradient);
                    statistics.gradients += 1;
                    gradient
                }
            };
            if F::OF_VELOCITY {
                start.evaluate(frequency, mass, q, velocity, &phase.force);
            }
            end.evaluate(frequency, mass, next, velocity, force);
        }
        let omega = T::lift(0.5) * (start.omega + end.omega);
        coefficients.set(self.method, [interval.h, omega])
    }

    /// Adds ∂ℓ/∂ω ∂ω/∂q0 to `to`, or the sum with ∂ℓ/∂ω ∂ω/∂q1, if the frequency is variational.
    fn vary_frequency(
        &mut self,
        &Begin { system, interval, q: q0, .. }: &Begin<'_, S, T>,
        delta: &[T],
        share: Share<'_, T>,
        (coefficients, node): (&Coefficients<T>, &mut NodeWork<S, T>),
        to: &mut [T],
    ) {
        if READ != read::WITH_ITS_DERIVATIVES {
            return;
        }
        let ([start, end], span) = (&*self.ends, Span { system, interval, q0, delta });
        let slope = coefficients.slope(self.method, span, node, start.omega + end.omega);
        for (i, to) in to.iter_mut().enumerate() {
            let by_left = start.dq[i] - (start.dv[i] + end.dv[i]) / interval.h;
            let by_ends = match share {
                Share::Left => by_left,
                Share::Both { .. } => start.dq[i] + end.dq[i],
            };
            *to += T::lift(0.5) * slope * by_ends;
        }
    }
}

impl<const READ: usize, S: NondegenerateLagrangian<T>, F: Frequency, R: Rule, T: Real> Equations<S, T>
    for Interpolated<'_, READ, S, F, R, T>
{
    const FITTED: bool = !F::UNFITTED;
    const READS_VELOCITY: bool = F::OF_VELOCITY;

    type Coefficients = Coefficients<T>;

    #[inline]
    fn begin(
        &mut self,
        begin: &Begin<'_, S, T>,
        node: &mut NodeWork<S, T>,
    ) -> Result<Coefficients<T>, StepFailure> {
        let Self { method, given, ends: [start, _] } = self;
        let Begin { interval: Interval { h, .. }, q, phase, .. } = begin;
        let mut coefficients = Coefficients::linear(&method.rule);
        // Each iteration reads it, all of it or its end.
        let is_left = READ == read::WITH_ITS_DERIVATIVES || READ == read::AT_BOTH_ENDS && F::OF_VELOCITY;
        if F::UNFITTED || is_left {
            return Ok(coefficients);
        }
        if READ == read::AT_THE_START && method.frequency.reading().is_none() {
            given.fix(*method, *h)?;
            return Ok(**given);
        }
        let (mass, velocity) = (begin.mass, &mut node.velocity);
        mass.solve(&phase.p, velocity);
        start.evaluate(&method.frequency, mass, q, velocity, &phase.force);
        if READ == read::AT_THE_START {
            coefficients.set(*method, [*h, start.omega])?;
        }
        Ok(coefficients)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        share: Share<'_, T>,
        (coefficients, node): (&mut Coefficients<T>, &mut NodeWork<S, T>),
        to: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_both_ends(begin, delta, share, (coefficients, node), statistics)?;
        let Begin { system, interval, q: q0, phase, .. } = *begin;
        let (ends, h) = ([q0, delta], interval.h);
        for (j, &c) in self.method.rule.nodes().iter().enumerate() {
            let (time, weight) = (interval.time(T::lift(c)), coefficients.weights[j]);
            let Basis { b, b_bar, d, d_bar } = coefficients.bases[j];
            let ([by_point, by_velocity], at_end) = match share {
                // The end of the step gives nothing to the left one: b = 0.
                Share::Left if S::SEPARABLE && c == 1.0 => continue,
                Share::Left => ([b, d], None),
                Share::Both { force } => ([b + b_bar, d + d_bar], Some(force)),
            };
            if !S::SEPARABLE {
                let NodeWork { point, velocity, gradient, momentum } = &mut *node;
                Placed(&self.method.rule, coefficients).place(j, h, ends, [point, velocity]);
                system.gradient(point, velocity, time, gradient, momentum);
                statistics.gradients += 1;
                node.add(weight, h, [by_point, by_velocity], to);
                continue;
            }
            let force: &[T] = match at_end {
                _ if c == 0.0 => &phase.force,
                Some(force) if c == 1.0 => force,
                _ => {
                    coefficients.place_point(j, ends, &mut node.point);
                    set_force(system, &node.point, time, &mut node.gradient);
                    statistics.gradients += 1;
                    &node.gradient
                }
            };
            kick(to, h * weight * by_point, force);
        }
        self.vary_frequency(begin, delta, share, (coefficients, node), to);
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        (coefficients, node): (&mut Coefficients<T>, &mut NodeWork<S, T>),
        d1: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_both_ends(begin, delta, Share::Left, (coefficients, node), statistics)?;
        let &Begin { system, interval, q: q0, .. } = begin;
        let span = Span { system, interval, q0, delta };
        linearize(&Placed(&self.method.rule, coefficients), span, node, d1, sink);
        self.vary_frequency(begin, delta, Share::Left, (coefficients, node), d1);
        Ok(())
    }

    /// κ is the stiffness of the fitted oscillator, so that only what differs from it is iterated.
    #[inline]
    fn kinetic(&self, coefficients: &Coefficients<T>) -> Kinetic<T> {
        coefficients.sums
    }

    #[inline]
    fn is_explicit(&self) -> bool {
        self.method.is_explicit()
    }

    #[inline]
    fn asks_ends(&self) -> bool {
        let Variational { rule, frequency, .. } = self.method;
        frequency.reading().is_some() || rule.interior_nodes() < rule.nodes().len()
    }
}

impl<S: NondegenerateLagrangian<T>, R: Rule, T: Real> VariationalMethod<S, T> for Variational<Unfitted, R> {
    type Nodes = R;

    fn discrete_lagrangian(&self, system: &S) -> DiscreteLagrangian<S, R, T> {
        DiscreteLagrangian::of(system, self.rule)
    }
}
