//! The explicit reversible step control of Hairer & Söderlind.
//!
//! Steps of density ρ(q) in time, dt = ε/ρ, make (ln ρ)' = G(q, v) = ∇ρ(q)·v/ρ(q). ρ is carried along by
//! ρ_{k+1/2} = ρ_{k−1/2} + ε G(q_k, v_k), h_{k+1/2} = ε/ρ_{k+1/2}, ρ_{1/2} = ρ(q_0) + ½ ε G(q_0, v_0) rather
//! than evaluated: each step is known before it is taken, and the map of (q, v, ρ) remains reversible if
//! that of the method with constant steps is.
//!
//! Source: Hairer & Söderlind 2005, "Explicit, time reversible, adaptive step size control", SIAM J. Sci.
//! Comput. 26, 1838–1851.

use super::{ControlledRun, StepControl};
use crate::error::{StartError, StepFailure};
use crate::memory::lasting;
use crate::methods::{Carries, Method};
use crate::run::{Integrator, Run};
use crate::scalar::norm::reported;
use crate::{Held, Real, RegularLagrangian, Scalar, Space, System, Vector};

/// Steps h = ε/ρ with the density ρ = |q|^(−κ), for motions around the origin, which is carried along
/// symmetrically (Hairer & Söderlind 2005).
///
/// κ = 3/2 takes steps in proportion to the time of free fall: on Kepler's problem all orbits of the same
/// shape then have the same number of steps a revolution, about T·mean(ρ)/ε with the period T and the mean
/// over time. Steps of another density are a [`StepControl`] of your own.
///
/// With a symmetric method a run can be retraced backwards, so that energy errors do not drift on reversible
/// orbits. The whole is not symplectic. The control is for regular systems. Beside the position it needs the
/// velocity at the start of a step, and for L = ½ v·M v − V(q, t) no evaluation of L.
///
/// ```
#[doc = include_str!("../../../docs/hidden/kepler.txt")]
/// // An orbit of eccentricity 0.9, from its pericentre, over some 100 revolutions.
/// let start = KeplerState { x: 0.1, y: 0.0, dot_x: 0.0, dot_y: 19_f64.sqrt() };
/// let control = Reversible::power(0.02, 1.5);
/// let mut run = Integrator::controlled(&Kepler, Variational::trapezoid(), control, start)?;
/// let energy = run.energy();
/// run.take_steps(20_000)?;
/// assert!((run.energy() - energy).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reversible {
    /// ε ≠ 0, in units of ρ times time; negative to run back in time.
    pub epsilon: f64,
    /// κ.
    pub exponent: f64,
    /// ρ at the start of the run, to go on from another run ([`Integrator::density`]). Default: that of the
    /// start.
    pub start: Option<f64>,
}

impl<H, S: RegularLagrangian<T>, M, T: Real> Integrator<H, M, T, Reversible>
where
    H: Held<System = S>,
    M: Method<S, T>,
{
    /// ρ at the current point, as the control has carried it along: a run from here with
    /// [`Reversible::start`] at this value goes on with the same steps, and with the velocity reversed it
    /// comes back by the same steps. Not a number where the momenta have no velocity.
    pub fn density(&self) -> T {
        let half = T::lift(0.5 * self.control.epsilon);
        self.control_memory.density + half * self.control.growth(self.q(), &self.v())
    }
}

impl Reversible {
    /// Steps ε |q|^κ with the exponent κ.
    pub fn power(epsilon: f64, exponent: f64) -> Self {
        Self { epsilon, exponent, start: None }
    }

    /// ρ(q).
    fn density<T: Real>(&self, q: &[T]) -> T {
        let square = q.iter().fold(T::lift(0.0), |sum, &x| sum + x * x);
        Scalar::powf(square, T::lift(-0.5 * self.exponent))
    }

    /// G(q, v) = −κ q·v/|q|².
    #[inline]
    fn growth<T: Real>(&self, q: &[T], v: &[T]) -> T {
        let (mut along, mut square) = (T::lift(0.0), T::lift(0.0));
        for (&x, &v) in q.iter().zip(v) {
            along += x * v;
            square += x * x;
        }
        T::lift(-self.exponent) * along / square
    }

    fn validate(&self) -> Result<(), StartError> {
        let in_range = self.epsilon.is_finite() && self.epsilon != 0.0;
        StartError::unless(in_range, "epsilon", self.epsilon, "finite and different from zero")?;
        let Some(start) = self.start else { return Ok(()) };
        StartError::unless(is_density(start), "start", start, "positive and finite")
    }
}

/// What [`Reversible`] carries from step to step.
#[derive(Debug)]
pub struct ReversibleMemory<S: System, T: Real> {
    /// ρ_{k−1/2}; for k = 0, as if there had been a step before.
    density: T,
    v: Vector<S, T>,
}

impl<S: System, T: Real> ReversibleMemory<S, T> {
    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        is_density(self.density)
    }
}

lasting!([S: System, T: Real] ReversibleMemory<S, T>, T; number density; is_sound);

impl<S: System, T: Real> Carries<S, T> for Reversible {
    type Memory = ReversibleMemory<S, T>;
}

impl<S: RegularLagrangian<T>, T: Real> StepControl<S, T> for Reversible {
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &[T], v: &[T], _t: T) -> Result<(Self::Memory, T), StartError> {
        self.validate()?;
        let density = self.start.map_or_else(|| self.density(q), T::lift);
        let half = T::lift(0.5 * self.epsilon) * self.growth(q, v);
        let first = density + half;
        for density in [density, first] {
            if !is_density(density) {
                return Err(StartError::Starter(StepFailure::Density { density: reported(density) }));
            }
        }
        let memory = ReversibleMemory { density: density - half, v: system.space().vector() };
        Ok((memory, T::lift(self.epsilon) / first))
    }

    // The density is that of the run, whatever a first step from here would have.
    fn begin_again(&self, system: &S, _q: &[T], _v: &[T], _t: T) -> Result<Self::Memory, StartError> {
        self.validate()?;
        Ok(ReversibleMemory { density: T::lift(1.0), v: system.space().vector() })
    }

    #[inline]
    fn step<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure> {
        run.velocity(t, &mut memory.v)?;
        let epsilon = T::lift(self.epsilon);
        let density = memory.density + epsilon * self.growth(run.q(), &memory.v);
        if !is_density(density) {
            return Err(StepFailure::Density { density: reported(density) });
        }
        let h = epsilon / density;
        run.step(t, h)?;
        memory.density = density;
        Ok(h)
    }
}

fn is_density<T: Real>(density: T) -> bool {
    density > T::lift(0.0) && density.is_finite()
}
