//! Langevin dynamics by the splitting BAOAB: the kicks and drifts of the trapezoidal variational integrator
//! with the exact solution of friction and noise between its two drifts.
//!
//! dq = M⁻¹p dt      dp = F dt − γp dt + √(2γθ) A dW,   A Aᵀ = M
//!
//! B  p ← p + (h/2)F(q, t)      A  q ← q + (h/2)M⁻¹p      O  p ← c p + √(θ(1 − c²)) A ξ,   c = e^(−γh)
//!
//! The normal numbers ξ of step k are those of the k-th stream of a generator, ChaCha with 8 rounds, whose
//! key is made from the seed. They depend on nothing else, so that runs can be repeated and resumed.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use crate::error::{StartError, StepFailure};
use crate::mechanics::mass::Mass;
use crate::mechanics::mass_root::MassRoot;
use crate::memory::{Memory, lasting};
use crate::methods::{Carries, Method, PreservedForm, Scheme};
use crate::scalar::norm;
use crate::state::Statistics;
use crate::{Real, RegularLagrangian, Scalar, Separable, Space, System, Vector};

/// Langevin dynamics, for [`Separable`] systems: friction and noise as of a heat bath, by the splitting
/// BAOAB (Leimkuhler & Matthews 2013).
///
/// ```math
/// \mathrm{d}q = M^{-1} p\, \mathrm{d}t, \qquad
/// \mathrm{d}p = F(q, t)\, \mathrm{d}t - \gamma p\, \mathrm{d}t + \sqrt{2 \gamma \theta}\; M^{1/2}\, \mathrm{d}W
/// ```
///
/// Here F is −∇V and what `force = …` declares, γ the friction and θ = k_B T the temperature. If F is
/// −∇V(q), states of a long run are distributed as e^(−E/θ). A step is one of `Variational::trapezoid()`
/// with the exact solution of friction and noise in its middle; with γ = 0 it is that step. It evaluates F
/// once.
///
/// Averages over a run have errors of order h². On a harmonic oscillator the positions have the exact
/// distribution at every stable step, ωh < 2, and the mean kinetic energy is too small by the factor 1 −
/// (ωh)²/4. Free particles diffuse too fast, by the factor (γh/2) coth(γh/2). With noise M has to be
/// positive definite.
///
/// The noise comes from `seed` and the number of the step alone: a run with the same seed is the same to the
/// last bit, and goes on from a [`Checkpoint`](crate::run::Checkpoint) as if it had not stopped. Steps are
/// positive, because friction has a direction in time.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - 2.0 * x * x)]
/// struct Spring;
///
/// let method = Langevin { friction: 1.0, temperature: 0.5, seed: 7 };
/// let start: SpringState = SpringState { x: 0.0, dot_x: 0.0 };
/// let mut run = Integrator::new(&Spring, method, 0.2, start)?;
/// let mut sum = 0.0;
/// for _ in 0..100_000 {
///     run.advance()?;
///     sum += run.q()[0].powi(2);
/// }
/// // The mean of x² is θ/k.
/// assert!((sum / 1e5 - 0.5 / 4.0).abs() < 3e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Langevin {
    /// γ, in units of one over time; not negative.
    pub friction: f64,
    /// θ = k_B T, in units of energy; not negative.
    pub temperature: f64,
    /// What the noise is made from.
    pub seed: u64,
}

/// The momentum and the force of a run, how many steps it has taken, and work space.
#[derive(Debug)]
pub struct LangevinMemory<S: System, T: Real> {
    p: Vector<S, T>,
    force: Vector<S, T>,
    /// Work space: the force at the end of a step.
    next_force: Vector<S, T>,
    /// The number of the step, which is that of the stream of noise.
    step: u64,
    generator: ChaCha8Rng,
    mass: Mass<S, T>,
    /// If there is noise.
    root: Option<MassRoot<S, T>>,
    work: Work<S, T>,
}

/// The point that a step moves, and vectors that are written before they are read.
#[derive(Debug)]
struct Work<S: System, T: Real> {
    q: Vector<S, T>,
    p: Vector<S, T>,
    velocity: Vector<S, T>,
    noise: Vector<S, T>,
}

impl<S: System, T: Real> Memory<T> for LangevinMemory<S, T> {
    lasting!(T; numbers p, numbers force, count step);
}

impl<S: System, T: Real> LangevinMemory<S, T> {
    /// p = M v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.p
    }
}

impl<S: Separable<T>, T: Real> Work<S, T> {
    /// Adds `by` F to the momentum.
    fn kick(&mut self, force: &[T], by: T) {
        for (p, &force) in self.p.iter_mut().zip(force) {
            *p += by * force;
        }
    }

    /// Adds `by` M⁻¹p to the position.
    fn drift(&mut self, mass: &Mass<S, T>, by: T) {
        mass.solve(&self.p, &mut self.velocity);
        for (q, &velocity) in self.q.iter_mut().zip(self.velocity.iter()) {
            *q += by * velocity;
        }
    }

    /// Friction and noise over a time `h`, with normal numbers from `generator`.
    fn exchange(
        &mut self,
        bath: &Langevin,
        root: Option<&MassRoot<S, T>>,
        h: T,
        generator: &mut ChaCha8Rng,
    ) {
        let kept = Scalar::exp(T::lift(-bath.friction) * h);
        let Some(root) = root else {
            self.p.iter_mut().for_each(|p| *p *= kept);
            return;
        };
        // 1 − c² without its cancellation.
        let lost = -Scalar::exp_m1(T::lift(-2.0 * bath.friction) * h);
        let gained = Scalar::sqrt(T::lift(bath.temperature) * lost);
        for number in self.velocity.iter_mut() {
            let drawn: f64 = StandardNormal.sample(generator);
            *number = T::lift(drawn);
        }
        root.multiply(&self.velocity, &mut self.noise);
        for (p, &noise) in self.p.iter_mut().zip(self.noise.iter()) {
            *p = kept * *p + gained * noise;
        }
    }
}

impl Langevin {
    fn validate<T: Real>(&self, h: T) -> Result<(), StartError> {
        for (name, value) in [("friction", self.friction), ("temperature", self.temperature)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(StartError::Parameter { name, value, range: "not negative, and finite" });
            }
        }
        if h < T::lift(0.0) {
            let reason = "friction and noise have a direction in time";
            return Err(StartError::Unsupported { option: "a negative step", reason });
        }
        Ok(())
    }
}

impl Scheme for Langevin {
    /// That of averages.
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        false
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Nothing
    }
}

impl<S: System, T: Real> Carries<S, T> for Langevin {
    type Memory = LangevinMemory<S, T>;
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> Method<S, T> for Langevin {
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate(h)?;
        let vector = || system.space().vector();
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        let has_noise = self.friction > 0.0 && self.temperature > 0.0;
        let root =
            has_noise.then(|| MassRoot::new(system, &mass).map_err(StartError::Starter)).transpose()?;
        let (mut p, mut force) = (vector(), vector());
        mass.multiply_add(T::lift(1.0), v, &mut p);
        system.force(q, &[], t, &mut force);
        let work = Work { q: vector(), p: vector(), velocity: vector(), noise: vector() };
        let (generator, next_force) = (ChaCha8Rng::seed_from_u64(self.seed), vector());
        Ok(LangevinMemory { p, force, next_force, step: 0, generator, mass, root, work })
    }

    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let LangevinMemory { p, force, next_force, step, generator, mass, root, work } = memory;
        let half = T::lift(0.5) * h;
        work.q.copy_from_slice(q);
        work.p.copy_from_slice(p);
        work.kick(force, half);
        work.drift(mass, half);
        generator.set_stream(*step);
        generator.set_word_pos(0);
        work.exchange(self, root.as_ref(), h, generator);
        work.drift(mass, half);
        system.force(&work.q, &[], t + h, next_force);
        statistics.gradients += 1;
        work.kick(next_force, half);
        norm::finite(&work.q).and(norm::finite(&work.p))?;
        q.copy_from_slice(&work.q);
        p.copy_from_slice(&work.p);
        force.copy_from_slice(next_force);
        *step += 1;
        Ok(())
    }

    fn velocity(
        &self,
        _system: &S,
        memory: &Self::Memory,
        _q: &Vector<S, T>,
        _t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.p, v);
        Ok(())
    }
}
