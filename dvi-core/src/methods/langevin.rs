//! Langevin dynamics by the splitting BAOAB: the kicks and drifts of the trapezoidal variational integrator
//! with the exact solution of friction and noise between its two drifts.
//!
//! B  p ← p + (h/2)F(q, t)      A  q ← q + (h/2)M⁻¹p
//! O  p ← c p + √(θ(1 − c²)) A ξ,   c = e^(−γh), A Aᵀ = M
//!
//! The normal numbers ξ of step k are those of the k-th stream of a generator, ChaCha with 8 rounds, whose
//! key is made from the seed. They depend on nothing else, so that runs can be repeated and resumed.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use crate::discrete::NodeWork;
use crate::error::{StartError, StepFailure};
use crate::mechanics::mass_root::MassRoot;
use crate::mechanics::phase::Arrival;
use crate::memory::lasting;
use crate::methods::step::{Carried, Work};
use crate::methods::{Carries, Here, Method, PreservedForm, Step, scheme};
use crate::scalar::norm;
use crate::scalar::passes::{kick, multiply};
use crate::state::summation::Summation;
use crate::system::Same;
use crate::{Real, RegularLagrangian, Scalar, Separable, System, Vector};

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
/// assert_eq!(run.memory().p(), [run.state().dot_x]); // p = m v, of the mass 1
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

/// What a run carries, how many steps it has taken, and its noise.
#[derive(Debug)]
pub struct LangevinMemory<S: System, T: Real> {
    carried: Carried<S, T>,
    /// The number of the step, which is that of the stream of noise.
    step: u64,
    generator: ChaCha8Rng,
    /// If there is noise.
    root: Option<MassRoot<S, T>>,
}

lasting!([S: System, T: Real] LangevinMemory<S, T>, T; part carried, count step);

impl<S: System, T: Real> LangevinMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.carried.phase.p
    }
}

impl Langevin {
    fn validate<T: Real>(&self, h: T) -> Result<(), StartError> {
        for (name, value) in [("friction", self.friction), ("temperature", self.temperature)] {
            let in_range = value >= 0.0 && value.is_finite();
            StartError::unless(in_range, name, value, "not negative, and finite")?;
        }
        let is_negative = h < T::lift(0.0);
        StartError::unless_it(!is_negative, "a negative step", "friction and noise have a direction in time")
    }

    /// Friction and noise over a time `h`, with normal numbers from `generator`.
    fn exchange<S: Separable<T>, T: Real>(
        &self,
        p: &mut [T],
        root: Option<&MassRoot<S, T>>,
        h: T,
        generator: &mut ChaCha8Rng,
        [normal, noise]: [&mut Vector<S, T>; 2],
    ) {
        let kept = Scalar::exp(T::lift(-self.friction) * h);
        let Some(root) = root else {
            multiply(p, kept);
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

scheme! {
    [] Langevin, |_|
    /// That of averages.
    order: 2,
    is_symmetric: false,
    preserved_form: PreservedForm::Nothing,
}

impl<S: System, T: Real> Carries<S, T> for Langevin {
    type Memory = LangevinMemory<S, T>;
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> Method<S, T> for Langevin {
    type Suited<X> = <S as Separable<T>>::Suited<<<S as RegularLagrangian<T>>::Suited<X> as Same<X>>::As>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate(h)?;
        let carried = Carried::new(system, q, v, t, Summation::Plain)?;
        let has_noise = self.friction > 0.0 && self.temperature > 0.0;
        let root = has_noise.then(|| MassRoot::new(system, &carried.inertial.mass)).transpose();
        let generator = ChaCha8Rng::seed_from_u64(self.seed);
        Ok(LangevinMemory { carried, step: 0, generator, root: root.map_err(StartError::Starter)? })
    }

    fn begun_anew(&self, before: &Self::Memory, begun: Self::Memory) -> Self::Memory {
        LangevinMemory { step: before.step, ..begun }
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let LangevinMemory { carried: Carried { phase, inertial, work }, step, generator, root } = memory;
        let Work { node: NodeWork { point: q1, velocity, gradient: f1, momentum: p1 }, trial, .. } = work;
        let (half, mass) = (T::lift(0.5) * h, &inertial.mass);
        q1.copy_from_slice(q);
        p1.copy_from_slice(&phase.p);
        kick(p1, half, &phase.force);
        mass.solve(p1, velocity);
        kick(q1, half, velocity);
        // In this order no numbers are made that are not drawn.
        generator.set_word_pos(0);
        generator.set_stream(*step);
        self.exchange(p1, root.as_ref(), h, generator, [trial, velocity]);
        mass.solve(p1, velocity);
        kick(q1, half, velocity);
        system.force(q1, &[], t + h, f1);
        statistics.gradients += 1;
        kick(p1, half, f1);
        norm::finite(q1).and(norm::finite(p1))?;
        phase.set(q, &Arrival { q: q1, p: p1, force: f1 });
        *step += 1;
        Ok(())
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }
}
