//! The search for the length of a step with a given discrete energy: by the secant method from the last two
//! lengths and, where that leads nowhere, by regula falsi between lengths at which the defect has different
//! signs, sought from a quarter of the last length to four times that.

use super::ControlledRun;
use super::energy_momentum::EnergyMomentumMemory;
use crate::discrete::{Interval, Span};
use crate::error::StepFailure;
use crate::methods::Method;
use crate::scalar::norm::reported;
use crate::solve::crossing::zero;
use crate::{Real, RegularLagrangian, Scalar};

/// Iterations of the secant method.
const ITERATIONS: usize = 60;
/// Lengths that are tried in search of a sign change, on either side of the last.
const SOUGHT: i32 = 24;
/// Lengths that differ by less, relatively, count as the same; a secant then begins at one that differs by
/// the second.
const NEAR: [f64; 2] = [1e-6, 1e-3];
/// By this factor a length may differ from the last.
const REACH: f64 = 4.0;

/// A length, and E_d − e of the step that has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial<T> {
    h: T,
    defect: T,
}

impl<T: Real> Trial<T> {
    fn size(&self) -> T {
        Scalar::abs(self.defect)
    }
}

/// A step whose length is sought, from the point that `run` has kept.
pub(super) struct Search<'a, 'b, S: RegularLagrangian<T>, M: Method<S, T>, T: Real> {
    pub(super) run: &'a mut ControlledRun<'b, S, M, T>,
    pub(super) memory: &'a mut EnergyMomentumMemory<S, T>,
    pub(super) t: T,
    /// The largest defect that is asked for.
    pub(super) tolerance: T,
    /// The trial with the smallest defect; before there is one, why there is none.
    pub(super) best: Result<Trial<T>, StepFailure>,
}

impl<S: RegularLagrangian<T>, M: Method<S, T>, T: Real> Search<'_, '_, S, M, T> {
    /// Takes a step of length `h`, and returns its discrete energy.
    pub(super) fn energy(&mut self, h: T) -> Result<T, StepFailure> {
        self.run.step(self.t, h)?;
        let Self { run, memory, t, .. } = self;
        let EnergyMomentumMemory { start, delta, node, .. } = &mut **memory;
        for (delta, (&q1, &q0)) in delta.iter_mut().zip(run.q().iter().zip(start.iter())) {
            *delta = q1 - q0;
        }
        let span = Span { system: run.system(), interval: Interval { t: *t, h }, q0: start, delta };
        let method = &run.stepper.method;
        let energy = M::DISCRETE_ENERGY.map(|energy| energy(method, span, node));
        let missing = StepFailure::EnergyStep { h: reported(h), defect: f64::NAN };
        energy.filter(|energy| energy.is_finite()).ok_or(missing)
    }

    /// The trial of a length, from which the run has gone back; `None` if there is no such step.
    fn trial(&mut self, h: T) -> Option<Trial<T>> {
        let energy = self.energy(h);
        self.run.go_back();
        match energy {
            Ok(energy) => {
                let trial = Trial { h, defect: energy - self.memory.energy };
                if !self.best.is_ok_and(|best| trial.size() >= best.size()) {
                    self.best = Ok(trial);
                }
                Some(trial)
            }
            Err(failure) => {
                self.best = self.best.or(Err(failure));
                None
            }
        }
    }

    fn is_solved(&self) -> bool {
        self.best.is_ok_and(|best| best.size() <= self.tolerance)
    }

    /// Whether nothing but rounding is left, of which a search may make no less.
    fn is_rounding(&self) -> bool {
        self.best.is_ok_and(|best| best.size() <= self.memory.rounding)
    }

    /// From a guess and another length on, as long as the lengths stay within reach of the last.
    fn secant(&mut self, [guess, other]: [T; 2]) -> Option<()> {
        let reach = T::lift(REACH);
        let mut b = self.trial(guess)?;
        if self.is_solved() {
            return Some(());
        }
        let is_rounding = self.is_rounding();
        let mut a = self.trial(other)?;
        if is_rounding && Scalar::abs(b.defect - a.defect) <= self.memory.rounding {
            // The length makes no difference that can be seen: every one is a solution.
            self.best = Ok(b);
            return Some(());
        }
        for _ in 0..ITERATIONS {
            if self.is_solved() {
                return Some(());
            }
            let h = b.h - b.defect * (b.h - a.h) / (b.defect - a.defect);
            let ratio = h / self.memory.h;
            let is_near = ratio > T::lift(1.0) / reach && ratio < reach;
            if !is_near {
                return self.is_rounding().then_some(());
            }
            let next = self.trial(h)?;
            if self.is_rounding() && next.size() >= b.size() {
                return Some(());
            }
            (a, b) = (b, next);
        }
        None
    }

    /// Two lengths between which the defect changes its sign, nearest to the last.
    fn bracket(&mut self) -> Option<[Trial<T>; 2]> {
        let mut ends = [self.trial(self.memory.h)?; 2];
        for k in 1..=SOUGHT {
            for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
                let factor = T::lift(sign * f64::from(k) / f64::from(SOUGHT) * REACH.ln());
                let Some(next) = self.trial(self.memory.h * Scalar::exp(factor)) else { continue };
                if (next.defect > T::lift(0.0)) != (end.defect > T::lift(0.0)) {
                    return Some([*end, next]);
                }
                *end = next;
            }
        }
        None
    }

    /// Between two lengths at which the defect has different signs, until it is small enough.
    fn between(&mut self, ends: [Trial<T>; 2]) -> Option<()> {
        let look = &mut |h| self.trial(h).filter(|_| !self.is_solved()).map(|trial| trial.defect).ok_or(());
        // The end of the search is the error.
        let _ = zero(ends.map(|trial| [trial.h, trial.defect]), look);
        self.is_solved().then_some(())
    }

    /// The length of the step.
    pub(super) fn solve(&mut self) -> Result<T, StepFailure> {
        let EnergyMomentumMemory { h, before, .. } = *self.memory;
        let [near, apart] = NEAR.map(T::lift);
        // Lengths change by a factor from step to step, if they change.
        let (guess, other) = if Scalar::abs(h / before - T::lift(1.0)) > near {
            (h * h / before, h)
        } else {
            (h, h * (T::lift(1.0) + apart))
        };
        let found = self.secant([guess, other]).is_some()
            || self.bracket().is_some_and(|ends| self.between(ends).is_some());
        let best = self.best?;
        if found || self.is_solved() || self.is_rounding() {
            return Ok(best.h);
        }
        Err(StepFailure::EnergyStep { h: reported(best.h), defect: reported(best.defect) })
    }
}
