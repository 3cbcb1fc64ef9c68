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
use crate::methods::{Carries, Here, Method, PreservedForm, Scheme, Step};
use crate::scalar::norm;
use crate::scalar::passes::kick;
use crate::system::Same;
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
/// let start = SpringState { x: 0.0, dot_x: 0.0 };
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
    /// The number of the step, which is that of the stream of noise.
    step: u64,
    generator: ChaCha8Rng,
    mass: Mass<S, T>,
    /// If there is noise.
    root: Option<MassRoot<S, T>>,
    /// q, p and F at the end of a step.
    end: [Vector<S, T>; 3],
    /// A velocity or normal numbers, and noise.
    work: [Vector<S, T>; 2],
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

    /// Friction and noise over a time `h`, with normal numbers from `generator`.
    fn exchange<S: Separable<T>, T: Real>(
        &self,
        p: &mut [T],
        root: Option<&MassRoot<S, T>>,
        h: T,
        generator: &mut ChaCha8Rng,
        [normal, noise]: &mut [Vector<S, T>; 2],
    ) {
        let kept = Scalar::exp(T::lift(-self.friction) * h);
        let Some(root) = root else {
            p.iter_mut().for_each(|p| *p *= kept);
            return;
        };
        // 1 − c² without its cancellation.
        let lost = -Scalar::exp_m1(T::lift(-2.0 * self.friction) * h);
        let gained = Scalar::sqrt(T::lift(self.temperature) * lost);
        for number in normal.iter_mut() {
            let drawn: f64 = StandardNormal.sample(generator);
            *number = T::lift(drawn);
        }
        root.multiply(normal, noise);
        for (p, &noise) in p.iter_mut().zip(noise.iter()) {
            *p = kept * *p + gained * noise;
        }
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
    type Suited<X> = <S as Separable<T>>::Suited<<<S as RegularLagrangian<T>>::Suited<X> as Same<X>>::As>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate(h)?;
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        let has_noise = self.friction > 0.0 && self.temperature > 0.0;
        let root =
            has_noise.then(|| MassRoot::new(system, &mass).map_err(StartError::Starter)).transpose()?;
        let [mut p, mut force] = system.space().vectors();
        mass.multiply_add(T::lift(1.0), v, &mut p);
        system.force(q, &[], t, &mut force);
        let (end, work) = (system.space().vectors(), system.space().vectors());
        let generator = ChaCha8Rng::seed_from_u64(self.seed);
        Ok(LangevinMemory { p, force, step: 0, generator, mass, root, end, work })
    }

    fn begun_anew(&self, before: &Self::Memory, begun: Self::Memory) -> Self::Memory {
        LangevinMemory { step: before.step, ..begun }
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let LangevinMemory { p, force, step, generator, mass, root, end: [q1, p1, f1], work } = memory;
        let half = T::lift(0.5) * h;
        q1.copy_from_slice(q);
        p1.copy_from_slice(p);
        kick(p1, half, force);
        mass.solve(p1, &mut work[0]);
        kick(q1, half, &work[0]);
        generator.set_stream(*step);
        generator.set_word_pos(0);
        self.exchange(p1, root.as_ref(), h, generator, work);
        mass.solve(p1, &mut work[0]);
        kick(q1, half, &work[0]);
        system.force(q1, &[], t + h, f1);
        statistics.gradients += 1;
        kick(p1, half, f1);
        norm::finite(q1).and(norm::finite(p1))?;
        q.copy_from_slice(q1);
        p.copy_from_slice(p1);
        force.copy_from_slice(f1);
        *step += 1;
        Ok(())
    }

    fn velocity(
        &self,
        _here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.p, v);
        Ok(())
    }
}
