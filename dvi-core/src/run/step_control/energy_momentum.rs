//! Steps of such a length that the discrete energy stays the same. Of the two [equations](EnergyMomentum)
//! the first is the step of the method; what is left is one equation for h.

use super::search::Search;
use super::{ControlledRun, StepControl};
use crate::error::{StartError, StepFailure};
use crate::memory::lasting;
use crate::methods::{Carries, Method};
use crate::scalar::norm::{larger, reported};
use crate::system::start::is_length;
use crate::{Real, RegularLagrangian, Scalar, Space, System, Vector};

/// The largest defect of the discrete energy, relative to the scale at the start.
const TOLERANCE: f64 = 1e-14;
/// So many rounding errors of the terms of E_d count as none.
const ROUNDINGS: f64 = 4.0;

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
/// lengths jump. On a Kepler orbit of eccentricity 0.9 they do by a factor of two, and runs of the midpoint
/// rule with first steps from 0.0003 to 0.03 end before they are half around. On the quartic spring x⁴/4
/// they grow from 0.01 up to 6, and the energy at the points goes from ¼ to 11, while E_d is what it was: an
/// [`EnergyLimit`](crate::methods::EnergyLimit) around the method ends such a run. In dual numbers the
/// derivative of h is that of an iteration before the last. The defect of E_d is at most 1e-14 of the larger
/// of |E| and v·∂L/∂v at the start, or what rounding leaves.
///
/// A step takes several of the method, and six to seven times the evaluations of derivatives of one whose
/// length is given, in the experiment `energy-momentum`: there steps of one length are nearer to the motion
/// for the same work. The scheme is for those who need E_d as it is.
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
}

impl EnergyMomentum {
    /// With the length of the first step.
    pub fn new(first_step: f64) -> Self {
        Self { first_step }
    }
}

/// What [`EnergyMomentum`] carries from step to step.
#[derive(Debug)]
pub struct EnergyMomentumMemory<S: System, T: Real> {
    /// The length of the last step; before the first, the one that it will have.
    pub(super) h: T,
    /// The length of the step before, from which the secant method begins too.
    pub(super) before: T,
    /// e, once the first step has been taken.
    pub(super) energy: T,
    has_begun: bool,
    /// E_d − e of the last step.
    defect: T,
    /// The larger of |E| and v·∂L/∂v at the start.
    scale: T,
    /// What rounding leaves of E_d in the step at hand.
    pub(super) rounding: T,
    pub(super) start: Vector<S, T>,
    pub(super) delta: Vector<S, T>,
    pub(super) node: [Vector<S, T>; 2],
    velocity: Vector<S, T>,
    momentum: Vector<S, T>,
    force: Vector<S, T>,
}

lasting!([S: System, T: Real] EnergyMomentumMemory<S, T>, T;
    number h, number before, number energy, flag has_begun, number defect, number scale);

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

impl<S: System, T: Real> Carries<S, T> for EnergyMomentum {
    type Memory = EnergyMomentumMemory<S, T>;
}

impl<S: RegularLagrangian<T>, T: Real> StepControl<S, T> for EnergyMomentum {
    type Suited<X> = S::Suited<X>;

    const REJECTS: bool = true;

    fn begin(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<(Self::Memory, T), StartError> {
        if !is_length(self.first_step) {
            return Err(StartError::Step { h: self.first_step });
        }
        let reason = "energy is not conserved: forces act on the system, or L depends on the time";
        StartError::unless_it(!S::FORCED && S::AUTONOMOUS, "EnergyMomentum", reason)?;
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

    fn admit<M: Method<S, T>>(&self) -> Result<(), StartError> {
        let reason = "the method has no discrete energy: take `Variational` without a frequency";
        StartError::unless_it(M::DISCRETE_ENERGY.is_some(), "EnergyMomentum", reason)
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
        let tolerance = T::lift(TOLERANCE) * memory.scale;
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
