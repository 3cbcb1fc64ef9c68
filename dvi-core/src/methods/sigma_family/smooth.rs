//! The smooth orbits of the two-step map: those without a part that alternates from step to step.
//!
//! Through each point q leads one of them, up to terms beyond all powers of h: the map has a smooth solution, of which
//! backward error analysis finds a modified equation, and parasitic ones (Hairer, Lubich & Wanner 2006, chapter XV). Its
//! defect c = Φ(q) is found by the scheme itself. From (q, c) lead m/2 steps forward and m/2 backward, and of the defects on
//! the way a central difference leaves what alternates,
//!
//! F(q, c) = 2⁻ᵐ Σⱼ (−1)ʲ (m over m/2 + j) cⱼ,   |j| ≤ m/2,   m = 8;
//!
//! of a smooth orbit, (h/2)ᵐ times a derivative of order m. As h → 0 the defects of a parasitic solution are Mʲc with
//! M = K'K⁻¹, which is −1 if Dα is antisymmetric or σ = ½, and its F is Wc:
//!
//! W⁻¹ = (1 − X²)^(m/2)        X = (1 − 2σ)(Dα + (Dα)ᵀ)B⁻¹        B = (Dα)ᵀ − Dα
//!
//! So c ← c − W⁻¹F(q, c) gains a factor of order h in each iteration, and ends where F = 0.
//!
//! Of a state (q, c) that has a parasitic part a, the same difference of the points, F_q, leaves that part in q. What it leaves
//! of the smooth orbit through q is subtracted, so that a smooth state stays where it is:
//!
//! q ← q − a,   c ← Φ(q − a),   a = B⁻¹W⁻¹B(F_q(q, c) − F_q(q, Φ(q)))
//!
//! A step backward is a step of −h with 1 − σ: the adjoint scheme (Marsden & West 2001, section 2.4).

use super::memory::TwoStep;
use super::{Reinitialisation, Sigma, Step};
use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::methods::{Clock, RungeKutta};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{self, reported};
use crate::space::sink::{Places, Product};
use crate::state::{Memory, Statistics, Summation};
use crate::{DegenerateLagrangian, Real, Scalar, Space, System, Vector};

/// 2⁻ᵐ (−1)ʲ (m over m/2 + j) from j = 0 to m/2.
const WEIGHTS: [f64; 5] = [70.0 / 256.0, -56.0 / 256.0, 28.0 / 256.0, -8.0 / 256.0, 1.0 / 256.0];

/// m/2
const HALF: usize = WEIGHTS.len() - 1;

/// The largest number of iterations for a defect. Each gains a factor of order h.
const MOST: usize = 64;

/// What the differences leave of a smooth orbit, at most, in increments: sin⁸(θ/2)/(2 sin(θ/2)) of a motion that turns by the angle
/// θ = 70° in a step. The roots of the scheme, of which one is the motion and the other the parasitic mode, meet at 90°.
const ROUGH: f64 = 0.01;

/// Differences below this many units of rounding of the coordinates are noise.
const ROUNDING: f64 = 1024.0;

/// Corrections of this many units of rounding that no longer shrink are noise. Where parasitic solutions grow from step to
/// step, so does noise: what is more than that, and less than half of the digits, ends the iteration only after it has grown
/// three times.
const NOISE: f64 = 32.0;

/// What finds smooth orbits of one method on one system, with steps of one length.
#[derive(Debug)]
pub(super) struct Smoothing<S: System, T: Real> {
    /// Forward and backward.
    excursions: [Excursion<S, T>; 2],
    field: VectorField<S, T>,
    /// A point and its defect: of a smooth orbit, once it has been found.
    pub(super) q: Vector<S, T>,
    pub(super) defect: Vector<S, T>,
    /// X(q)
    pub(super) velocity: Vector<S, T>,
    /// What alternates in the points and in the defects around them.
    parts: Parts<S, T>,
    /// By how much a state is off the smooth orbit that it leaves.
    offset: Vector<S, T>,
    /// A point on the way.
    moving: Vector<S, T>,
    spare: [Vector<S, T>; 2],
}

/// The scheme in one direction of time.
#[derive(Debug)]
struct Excursion<S: System, T: Real> {
    method: Sigma<T>,
    state: TwoStep<S, T>,
    h: T,
}

#[derive(Debug)]
struct Parts<S: System, T: Real> {
    q: Vector<S, T>,
    defect: Vector<S, T>,
}

impl<S: System, T: Real> Parts<S, T> {
    /// Adds `weight` times a point and its defect.
    fn add(&mut self, weight: f64, q: &[T], defect: &[T]) {
        for (sums, terms) in [(&mut self.q, q), (&mut self.defect, defect)] {
            for (sum, &term) in sums.iter_mut().zip(terms) {
                *sum += T::lift(weight) * term;
            }
        }
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Smoothing<S, T> {
    pub(super) fn new(
        system: &S,
        method: &Sigma<T>,
        q: &Vector<S, T>,
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let vector = || system.space().vector();
        let forward = Sigma {
            summation: Summation::Plain,
            parasitic_limit: None,
            reinitialisation: Reinitialisation::Never,
            ..*method
        };
        let excursion = |method: Sigma<T>, h: T| -> Result<_, StartError> {
            Ok(Excursion { method, state: TwoStep::new(system, &method, q, t, h)?, h })
        };
        let backward = Sigma { sigma: T::lift(1.0) - method.sigma, ..forward };
        Ok(Self {
            excursions: [excursion(forward, h)?, excursion(backward, -h)?],
            field: VectorField::new(system, q, t).map_err(StartError::Starter)?,
            q: vector(),
            defect: vector(),
            velocity: vector(),
            parts: Parts { q: vector(), defect: vector() },
            offset: vector(),
            moving: vector(),
            spare: [vector(), vector()],
        })
    }

    /// Finds the defect of the smooth orbit through `q` at time `t`, beginning with that of a Runge–Kutta step.
    pub(super) fn start(&mut self, system: &S, q: &Vector<S, T>, t: T) -> Result<(), StartError> {
        let Excursion { method, h, .. } = &self.excursions[0];
        let q1 = super::start::one_step(&RungeKutta::midpoint(), system, q, t, *h)?;
        let first = TwoStep::between(system, method, q, &q1, t, *h)?;
        self.q.copy_from_slice(q);
        self.defect.copy_from_slice(&first.defect);
        self.settle_down(system, t, &mut Statistics::default()).map_err(StartError::Starter)
    }

    /// Finds the smooth orbit that a state (`q`, `defect`) at time `t` leaves when what alternates is taken from it.
    pub(super) fn smooth(
        &mut self,
        system: &S,
        [q, defect]: [&Vector<S, T>; 2],
        t: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.q.copy_from_slice(q);
        self.defect.copy_from_slice(defect);
        self.correct(system, t, statistics)?;
        self.offset.copy_from_slice(&self.parts.q);
        self.settle_down(system, t, statistics)?;
        // On the smooth orbit through q, the difference leaves (h/2)ᵐ times a derivative, which is no reason to move.
        for (offset, &rest) in self.offset.iter_mut().zip(self.parts.q.iter()) {
            *offset -= rest;
        }
        if norm::largest(&self.offset) <= T::default_epsilon() * norm::largest(q) {
            return Ok(());
        }
        subtract(&mut self.q, &self.offset);
        norm::finite(&self.q)?;
        self.settle_down(system, t, statistics)
    }

    /// Φ(q) = 0 where the scheme is the implicit midpoint rule.
    fn settle_down(&mut self, system: &S, t: T, statistics: &mut Statistics) -> Result<(), StepFailure> {
        if S::AFFINE && self.excursions[0].method.is_midpoint() {
            self.defect.fill(T::lift(0.0));
            self.alternating_parts(system, t, statistics)?;
        } else {
            self.settle(system, t, statistics)?;
        }
        self.judge()
    }

    /// Keeps a state, for [`take_back`](Self::take_back).
    pub(super) fn keep(&mut self, state: &TwoStep<S, T>, q: &[T]) {
        self.excursions[0].state.restore(state);
        self.moving.copy_from_slice(q);
    }

    /// Returns to the state that was kept.
    pub(super) fn take_back(&self, state: &mut TwoStep<S, T>, q: &mut [T]) {
        state.restore(&self.excursions[0].state);
        q.copy_from_slice(&self.moving);
    }

    /// Whether what has been found is smooth.
    ///
    /// # Errors
    /// [`StepFailure::NotSmooth`].
    fn judge(&self) -> Result<(), StepFailure> {
        let alternating = reported(norm::largest(&self.parts.q));
        let increment = reported(Scalar::abs(self.excursions[0].h) * norm::largest(&self.velocity));
        let noise = ROUNDING * reported(T::default_epsilon() * norm::largest(&self.q));
        // What is not a number is not smooth.
        if alternating <= ROUGH * increment || alternating <= noise {
            return Ok(());
        }
        Err(StepFailure::NotSmooth { alternating, increment })
    }

    /// Solves F(q, c) = 0 for c, as far as rounding lets the corrections shrink.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], or those of the steps and of Ω.
    fn settle(&mut self, system: &S, t: T, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let scale = reported(self.scale(system, t));
        let rounding = reported(T::default_epsilon());
        let [tolerance, noise, most_noise] = [rounding, NOISE * rounding, rounding.sqrt()].map(|x| x * scale);
        let (mut last, mut growths) = (f64::INFINITY, 0);
        for iterations in 1.. {
            let correction = self.correct(system, t, statistics)?;
            statistics.iterations += 1;
            if correction >= last {
                growths += 1;
            }
            if correction <= tolerance || (growths > 0 && correction <= noise) {
                break;
            }
            if growths > 2 || iterations == MOST {
                if correction <= most_noise {
                    break;
                }
                return Err(StepFailure::NotConverged { iterations, correction, tolerance });
            }
            last = correction;
        }
        // Comparisons have not seen the derivatives that numbers may carry.
        let more = if carries_derivatives::<T>() { MOST } else { 0 };
        (0..more).try_for_each(|_| self.correct(system, t, statistics).map(drop))
    }

    /// c ← c − W⁻¹F(q, c); returns the size of the correction.
    fn correct(&mut self, system: &S, t: T, statistics: &mut Statistics) -> Result<f64, StepFailure> {
        self.alternating_parts(system, t, statistics)?;
        self.respond(system, t, statistics)?;
        let part = &self.parts.defect;
        norm::finite(part)?;
        for (c, &part) in self.defect.iter_mut().zip(part.iter()) {
            *c -= part;
        }
        Ok(reported(norm::largest(part)))
    }

    /// The size of the numbers of which a defect is a difference: α, and what moving a coordinate changes in it.
    fn scale(&mut self, system: &S, t: T) -> T {
        let mut slope = T::lift(0.0);
        let mut sink = Places(|_: usize, _: usize, entry: T| slope = norm::larger(slope, Scalar::abs(entry)));
        system.one_form_jacobian(&self.q, t, T::lift(1.0), T::lift(0.0), &mut sink);
        let [one_form, _] = &mut self.spare;
        system.one_form(&self.q, t, one_form);
        norm::largest(one_form) + norm::largest(&self.defect) + slope * norm::largest(&self.q)
    }

    /// Sets `parts` to the central differences of the points and of the defects around (q, c).
    fn alternating_parts(
        &mut self,
        system: &S,
        t: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { excursions, field, q, defect, velocity, parts, moving, .. } = self;
        field.evaluate(system, q, t, velocity, statistics)?;
        parts.q.fill(T::lift(0.0));
        parts.defect.fill(T::lift(0.0));
        parts.add(WEIGHTS[0], q, defect);
        for Excursion { method, state, h } in excursions {
            let clock = Clock::new(t, *h);
            let step = |taken: usize| Step { system, method, t: clock.after(taken as u64).time(), h: *h };
            moving.copy_from_slice(q);
            state.set_out(&step(0), [q, defect, velocity]);
            for j in 1..=HALF {
                state.step(&step(j - 1), moving, statistics)?;
                parts.add(WEIGHTS[j], moving, &state.defect);
            }
        }
        Ok(())
    }

    /// From the differences to the amplitudes of the parasitic solution that has them: W⁻¹ on those of the defects, and
    /// B⁻¹W⁻¹B on those of the points.
    fn respond(&mut self, system: &S, t: T, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { field, q, parts, spare: [product, vector], excursions, .. } = self;
        let left = T::lift(1.0) - T::lift(2.0) * excursions[0].method.sigma;
        if left == T::lift(0.0) {
            return Ok(());
        }
        // (1 − 2σ)(Dα + (Dα)ᵀ)
        let multiply = |x: &[T], product: &mut Vector<S, T>| {
            product.fill(T::lift(0.0));
            system.one_form_jacobian(q, t, left, left, &mut Product { x, sum: product });
        };
        for _ in 0..HALF {
            field.raise(system, [q, &parts.defect], t, vector, statistics)?;
            multiply(vector, product);
            field.raise(system, [q, product], t, vector, statistics)?;
            multiply(vector, product);
            subtract(&mut parts.defect, product);
            multiply(&parts.q, product);
            field.raise(system, [q, product], t, vector, statistics)?;
            multiply(vector, product);
            field.raise(system, [q, product], t, vector, statistics)?;
            subtract(&mut parts.q, vector);
        }
        Ok(())
    }
}

fn subtract<T: Real>(difference: &mut [T], terms: &[T]) {
    for (difference, &term) in difference.iter_mut().zip(terms) {
        *difference -= term;
    }
}
