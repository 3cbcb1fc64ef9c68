//! How large the impulse of an impact is: by the energy at the point of impact, or by the discrete energy.

use super::Collision;
use super::memory::{ImpactsMemory, Wall};
use super::passage::Passage;
use crate::error::StepFailure;
use crate::methods::FreeFlight;
use crate::{Real, Scalar, UnilateralLagrangian, Weights};

/// Iterations for the impulse.
const ITERATIONS: usize = 40;
/// Iterations behind the one that rounding has ended, for the derivatives of numbers that carry some.
const POLISHED: usize = 3;
/// A relative change of the impulse from which the slope of the energy is taken.
const CLOSE: f64 = 1e-5;
/// The energy of an impulse may be off by so much of that of the motion towards the surface, or by so many
/// rounding errors.
const NEAR: f64 = 1e-6;
const ROUNDINGS: f64 = 16.0;

impl<S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> Passage<'_, S, M, T> {
    /// Finds the impulse of a reflection. The rate of change of the gap before it is `rate`.
    ///
    /// W(λ) = E(q, p⁻ + λ∂g/∂q) + λ∂g/∂t has the derivative ġ. An impact goes from W(0) through its minimum,
    /// where the motion towards the surface has been used up, to where W is as much higher as e² times what
    /// it has come down; for an L that is quadratic in v that is where ġ⁺ = −e ġ⁻.
    pub(super) fn reflect(&mut self, surface: usize, rate: T) -> Result<(), StepFailure> {
        let (e, zero) = (T::lift(self.method.restitution), T::lift(0.0));
        // Back in time an impact gains what it loses.
        let restitution = if self.h < zero { T::lift(1.0) / e } else { e };
        let lambda = if S::QUADRATIC {
            self.impulse_for(surface, [rate, -restitution * rate])?
        } else {
            let compression = self.impulse_for(surface, [rate, zero])?;
            let ([first, _], [least, _]) = (self.behind(surface, zero)?, self.behind(surface, compression)?);
            let energy = least + restitution * restitution * (first - least);
            let guess = compression * (T::lift(1.0) + restitution);
            self.improve(surface, guess, |_, [value, rate]| (energy - value) / rate)?
        };
        let [_, rate_behind] = self.behind(surface, lambda)?;
        self.look_on();
        let ImpactsMemory { wall, v, .. } = &mut *self.memory;
        for (direction, (&behind, &before)) in wall.direction.iter_mut().zip(v.iter().zip(wall.v.iter())) {
            *direction = if lambda == zero { zero } else { (behind - before) / lambda };
        }
        (wall.reflection, wall.impulse, wall.rate) = (lambda, lambda, rate_behind);
        wall.is_grazing = false;
        self.record(lambda);
        Ok(())
    }

    /// The impulse that turns the rate of change of a gap from one value to another, by the secant method,
    /// from the guess of a change of the rate times ∂g·∂²L/∂v∂v ∂g/(∂g·∂g)².
    fn impulse_for(&mut self, surface: usize, [rate, wanted]: [T; 2]) -> Result<T, StepFailure> {
        let Self { system, memory, q, t, .. } = self;
        let ImpactsMemory { wall: Wall { gradient, v, .. }, work: [l_q, l_v], .. } = &mut **memory;
        let (zero, mut inertia) = (T::lift(0.0), T::lift(0.0));
        let mut product = |i: usize, j: usize, entry: T| inertia += gradient[i] * entry * gradient[j];
        system.linearize(q, v, *t, Weights::mass(), l_q, l_v, &mut product);
        let squared = gradient.iter().fold(zero, |sum, &entry| sum + entry * entry);
        let lambda = inertia / (squared * squared) * (wanted - rate);
        let mut before = [zero, rate];
        self.improve(surface, lambda, |lambda, [_, behind]| {
            let change = (wanted - behind) * (lambda - before[0]) / (behind - before[1]);
            before = [lambda, behind];
            change
        })
    }

    /// Improves an impulse until the `change` of it, from what is [`behind`](Self::behind) it, is rounding.
    fn improve(
        &mut self,
        surface: usize,
        mut lambda: T,
        mut change: impl FnMut(T, [T; 2]) -> T,
    ) -> Result<T, StepFailure> {
        for _ in 0..ITERATIONS {
            let behind = self.behind(surface, lambda)?;
            let change = change(lambda, behind);
            if !change.is_finite() {
                break;
            }
            lambda += change;
            if Scalar::abs(change) <= T::lift(4.0) * T::default_epsilon() * Scalar::abs(lambda) {
                break;
            }
        }
        Ok(lambda)
    }

    /// W(λ), and the rate of change of the gap behind a jump by λ; the velocity there is left in `v`, the
    /// rates of all gaps in `there`.
    fn behind(&mut self, surface: usize, lambda: T) -> Result<[T; 2], StepFailure> {
        self.jump(lambda);
        self.look(T::lift(0.0))?;
        let ImpactsMemory { there, wall, v, .. } = &*self.memory;
        Ok([self.system.energy(self.q, v, self.t) + lambda * wall.speed, there.rate[surface]])
    }

    /// By how much the discrete energy of a flight of length `s` behind a jump by λ is off.
    fn defect(&mut self, s: T, lambda: T) -> Result<T, StepFailure> {
        self.jump(lambda);
        self.advance(s)?;
        let energy = self.energy(s)?;
        let wall = &self.memory.wall;
        Ok(energy + lambda * wall.speed - wall.energy)
    }

    /// Finds the impulse with which the flight of length `s` has the energy of the one before. If there is
    /// none, because the motion towards the surface has less energy than E_d differs by between the two, the
    /// impact is a reflection, whatever the length of the flight: its end is to be a continuous function of
    /// the length.
    pub(super) fn balance(&mut self, s: T) -> Result<(), StepFailure> {
        if self.method.collision == Collision::Reflection || self.memory.wall.is_grazing {
            return Ok(());
        }
        // From the same impulse each time, so that what is found is a function of the length.
        let &Wall { reflection, rate, .. } = &self.memory.wall;
        let mut lambda = reflection;
        let (mut slope, mut polished) = (rate, 0);
        let mut defect = self.defect(s, lambda)?;
        for _ in 0..ITERATIONS {
            let change = -defect / slope;
            if !change.is_finite() || polished > POLISHED {
                break;
            }
            let size = Scalar::abs(change / reflection);
            let Ok(next) = self.defect(s, lambda + change) else { break };
            // From points that are too close the slope would be one of rounding errors.
            if size > T::lift(CLOSE) {
                slope = (next - defect) / change;
            }
            polished += usize::from(size <= T::lift(4.0) * T::default_epsilon());
            lambda += change;
            defect = next;
        }
        // On the other side of half the impulse of a reflection the motion goes on towards the surface.
        let is_behind = lambda / reflection > T::lift(0.5);
        let wall = &mut self.memory.wall;
        // Δ/s has the rounding of the coordinates over s.
        let terms = Scalar::abs(wall.energy) + wall.terms[0] + wall.terms[1] / Scalar::abs(s);
        let rounding = T::lift(ROUNDINGS) * T::default_epsilon() * terms;
        let is_solved = Scalar::abs(defect) <= T::lift(NEAR) * Scalar::abs(reflection * rate)
            || (s != T::lift(0.0) && Scalar::abs(defect) <= rounding);
        wall.is_grazing = !(is_behind && is_solved);
        wall.impulse = if wall.is_grazing { reflection } else { lambda };
        Ok(())
    }
}
