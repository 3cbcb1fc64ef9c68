//! Steps of such a length that the discrete energy stays the same: the symplectic–energy–momentum scheme.
//!
//! p0 = −D₁L_d(q0, q1; h)      E_d(q0, q1; h) = −∂L_d/∂h = e
//!
//! for q1 and h (Kane, Marsden & Ortiz 1999). The first equation is the step of the method; what is left is
//! one equation for h. It is solved by the secant method from the last two lengths and, where that leads
//! nowhere, by regula falsi between lengths at which the defect has different signs, sought from a quarter
//! of the last length to four times that.

use super::{ControlledRun, StepControl};
use crate::discrete::{Ends, Interval, Span};
use crate::error::{StartError, StepFailure};
use crate::memory::{Memory, lasting};
use crate::methods::{Carries, Method};
use crate::scalar::norm::{larger, reported};
use crate::solve::crossing::zero;
use crate::system::start::is_length;
use crate::{Real, RegularLagrangian, Scalar, Space, System, Vector};

/// Iterations of the secant method.
const ITERATIONS: usize = 60;
/// Lengths that are tried in search of a sign change, on either side of the last.
const SOUGHT: i32 = 24;
/// So many rounding errors of the terms of E_d count as none.
const ROUNDINGS: f64 = 4.0;
/// Lengths that differ by less, relatively, count as the same; a secant then begins at one that differs by
/// the second.
const NEAR: [f64; 2] = [1e-6, 1e-3];
/// By this factor a length may differ from the last.
const REACH: f64 = 4.0;

/// Steps that conserve the discrete energy of a variational method to rounding errors: the
/// symplectic–energy–momentum scheme of Kane, Marsden & Ortiz (1999).
///
/// ```math
/// p_0 = -D_1 L_d(q_0, q_1;\ h), \qquad E_d(q_0, q_1;\ h) = -\frac{\partial L_d}{\partial h} = e
/// ```
///
/// The length h of each step is an unknown of the step, beside q1; e is the discrete energy of the first
/// step, whose length is given. It is that of `Variational` with linear interpolation, for which E_d = Σ wⱼ
/// E(qʲ, Δ/h), on systems without forces whose L does not depend on time. Momenta of symmetries are
/// conserved as by steps of one length. Energies E at the points of the run differ from E_d by terms of the
/// order h².
///
/// The equation for h may have no solution: E_d differs from E by a(q, p)h² and terms of higher order, and
/// where a is zero or has an extremum nearby, no length between a quarter of the last and four times that
/// gives e. The run then ends with [`StepFailure::EnergyStep`], at the last good state. Kane, Marsden &
/// Ortiz take the length of the smallest defect there; this control does not, because energy would no longer
/// be conserved. Take `Variational::midpoint()`: on an oscillator its E_d does not depend on the point, so
/// that steps have one length, and on the spring below it finds lengths for thousands of steps, where
/// `Variational::trapezoid()` ends after a few.
///
/// Where another solution is nearer than the one that belongs to the steps before, or that one has ended,
/// lengths jump: on a Kepler orbit of eccentricity 0.9 by a factor of two. In dual numbers the derivative of
/// h is that of an iteration before the last, and as close as the tolerance.
///
/// A step takes several of the method: about seven evaluations of derivatives in the experiment
/// `energy-momentum`, where steps of one length are nearer to the motion for the same work. The scheme is
/// for those who need E_d as it is.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A spring that becomes stiffer.
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (x * x + y * y) / 2.0 - (x * x + y * y).powi(2) / 4.0,
/// )]
/// struct Spring;
///
/// let start = SpringState { x: 1.0, y: 0.3, dot_x: 0.0, dot_y: 0.5 };
/// let mut run = Integrator::controlled(&Spring, Variational::midpoint(), EnergyMomentum::new(0.1), start)?;
/// run.take_steps(1000)?;
/// assert!(run.control_memory().defect().abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyMomentum {
    /// The length of the first step, which sets the discrete energy; negative to run back in time.
    pub first_step: f64,
    /// The largest defect of the discrete energy to accept, relative to the larger of |E| and v·∂L/∂v at the
    /// start. Where rounding leaves more, that is accepted. Default: 1e-14.
    pub tolerance: f64,
}

impl EnergyMomentum {
    /// With the default tolerance.
    pub fn new(first_step: f64) -> Self {
        Self { first_step, tolerance: 1e-14 }
    }
}

/// What [`EnergyMomentum`] carries from step to step.
#[derive(Debug)]
pub struct EnergyMomentumMemory<S: System, T: Real> {
    /// The length of the last step; before the first, the one that it will have.
    h: T,
    /// The length of the step before, from which the secant method begins too.
    before: T,
    /// e, once the first step has been taken.
    energy: T,
    has_begun: bool,
    /// E_d − e of the last step.
    defect: T,
    /// The larger of |E| and v·∂L/∂v at the start.
    scale: T,
    /// What rounding leaves of E_d in the step at hand.
    rounding: T,
    start: Vector<S, T>,
    delta: Vector<S, T>,
    node: [Vector<S, T>; 2],
    velocity: Vector<S, T>,
    momentum: Vector<S, T>,
    force: Vector<S, T>,
}

impl<S: System, T: Real> Memory<T> for EnergyMomentumMemory<S, T> {
    lasting!(T; number h, number before, number energy, flag has_begun, number defect, number scale);
}

impl<S: RegularLagrangian<T>, T: Real> EnergyMomentumMemory<S, T> {
    /// e; `None` before the first step.
    pub fn discrete_energy(&self) -> Option<T> {
        self.has_begun.then_some(self.energy)
    }

    /// By how much the discrete energy of the last step differs from e, in units of energy.
    pub fn defect(&self) -> T {
        self.defect
    }

    /// Sets what rounding leaves of E_d in a step from `start`, where `velocity` is: Δ/h has the rounding of
    /// the coordinates over h.
    fn set_rounding(&mut self, system: &S, t: T) {
        let Self { h, rounding, start, velocity, momentum, force, .. } = self;
        system.gradient(start, velocity, t, force, momentum);
        let mut terms = Scalar::abs(system.energy(start, velocity, t));
        for i in 0..start.len() {
            let rate = Scalar::abs(velocity[i]) + Scalar::abs(start[i] / *h);
            terms += Scalar::abs(momentum[i]) * rate;
        }
        *rounding = T::lift(ROUNDINGS) * T::default_epsilon() * terms;
    }
}

/// A length, and E_d − e of the step that has it.
#[derive(Clone, Copy, Debug)]
struct Trial<T> {
    h: T,
    defect: T,
}

impl<T: Real> Trial<T> {
    fn size(&self) -> T {
        Scalar::abs(self.defect)
    }
}

/// A step whose length is sought, from the point that `run` has kept.
struct Search<'a, 'b, S: RegularLagrangian<T>, M: Method<S, T>, T: Real> {
    run: &'a mut ControlledRun<'b, S, M, T>,
    memory: &'a mut EnergyMomentumMemory<S, T>,
    t: T,
    /// The largest defect that is asked for.
    tolerance: T,
    /// The trial with the smallest defect; before there is one, why there is none.
    best: Result<Trial<T>, StepFailure>,
}

impl<S: RegularLagrangian<T>, M: Method<S, T>, T: Real> Search<'_, '_, S, M, T> {
    /// Takes a step of length `h`, and returns its discrete energy.
    fn energy(&mut self, h: T) -> Result<T, StepFailure> {
        self.run.step(self.t, h)?;
        let Self { run, memory, t, .. } = self;
        let EnergyMomentumMemory { start, delta, node, .. } = &mut **memory;
        for (delta, (&q1, &q0)) in delta.iter_mut().zip(run.q().iter().zip(start.iter())) {
            *delta = q1 - q0;
        }
        let span =
            Span { system: run.system(), interval: Interval { t: *t, h }, ends: Ends { q0: start, delta } };
        let energy = run.stepper.method.discrete_energy(span, node);
        let missing = StepFailure::EnergyStep { h: reported(h), defect: f64::NAN };
        if energy.is_finite() { Ok(energy) } else { Err(missing) }
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
        let look = |h| self.trial(h).filter(|_| !self.is_solved()).map(|trial| trial.defect).ok_or(());
        // The end of the search is the error.
        let _ = zero(ends.map(|trial| [trial.h, trial.defect]), look);
        self.is_solved().then_some(())
    }

    /// The length of the step.
    fn solve(&mut self) -> Result<T, StepFailure> {
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

impl<S: System, T: Real> Carries<S, T> for EnergyMomentum {
    type Memory = EnergyMomentumMemory<S, T>;
}

impl<S: RegularLagrangian<T>, T: Real> StepControl<S, T> for EnergyMomentum {
    type Suited<X> = S::Suited<X>;

    const REJECTS: bool = true;

    fn begin(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<(Self::Memory, T), StartError> {
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            let (value, range) = (self.tolerance, "positive and finite");
            return Err(StartError::Parameter { name: "tolerance", value, range });
        }
        if !is_length(self.first_step) {
            return Err(StartError::Step { h: self.first_step });
        }
        if S::FORCED || !S::AUTONOMOUS {
            let reason = "energy is not conserved: forces act on the system, or L depends on the time";
            return Err(StartError::Unsupported { option: "EnergyMomentum", reason });
        }
        let [mut force, mut momentum, start, delta, velocity]: [Vector<S, T>; 5] = system.space().vectors();
        system.gradient(q, v, t, &mut force, &mut momentum);
        let energy = Scalar::abs(system.energy(q, v, t));
        let action = v.iter().zip(momentum.iter()).fold(T::lift(0.0), |sum, (&v, &p)| sum + v * p);
        let scale = larger(energy, action);
        let h = T::lift(self.first_step);
        let memory = EnergyMomentumMemory {
            h,
            before: h,
            energy: T::lift(0.0),
            has_begun: false,
            defect: T::lift(0.0),
            scale,
            rounding: T::lift(0.0),
            start,
            delta,
            node: system.space().vectors(),
            velocity,
            momentum,
            force,
        };
        Ok((memory, h))
    }

    fn admit<M: Method<S, T>>(&self, method: &M) -> Result<(), StartError> {
        if method.has_discrete_energy() {
            return Ok(());
        }
        let reason = "the method has no discrete energy: take `Variational` without a frequency";
        Err(StartError::Unsupported { option: "EnergyMomentum", reason })
    }

    fn step<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure> {
        memory.start.copy_from_slice(run.q());
        run.velocity(t, &mut memory.velocity)?;
        memory.set_rounding(run.system(), t);
        let tolerance = T::lift(self.tolerance) * memory.scale;
        let h = memory.h;
        let best = Err(StepFailure::StepLength { h: reported(h) });
        let mut search = Search { run, memory, t, tolerance, best };
        if !search.memory.has_begun {
            let energy = search.energy(h)?;
            (memory.energy, memory.has_begun) = (energy, true);
            return Ok(h);
        }
        let h = search.solve()?;
        let energy = search.energy(h)?;
        memory.defect = energy - memory.energy;
        (memory.before, memory.h) = (memory.h, h);
        Ok(h)
    }
}
