//! The jump of the momentum at an impact, p⁺ = p⁻ + λ ∂g/∂q, and the flight behind it.

use core::mem;

use super::Collision;
use super::memory::{ImpactsMemory, MOST, Wall};
use super::passage::Passage;
use crate::discrete::{Ends, Interval, Span};
use crate::error::StepFailure;
use crate::methods::{FreeFlight, Here, Step};
use crate::scalar::norm::reported;
use crate::{Real, Scalar, UnilateralLagrangian, Vector, Weights};

/// Flights that are shorter, as a part of the step, have no discrete energy of their own: Δ/s has the
/// rounding of the coordinates over s, and the energy at their end differs from it by less.
const SHORT: f64 = 1e-6;
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

/// ∂g·∂²L/∂v∂v ∂g/(∂g·∂g)², by which a rate of change of the gap is divided for a guess of the impulse.
fn inertia<S: UnilateralLagrangian<T>, T: Real>(
    system: &S,
    gradient: &[T],
    [q, v]: [&[T]; 2],
    t: T,
    [l_q, l_v]: &mut [Vector<S, T>; 2],
) -> T {
    let zero = T::lift(0.0);
    let mass = Weights::mass();
    let mut sum = zero;
    let mut product = |i: usize, j: usize, entry: T| sum += gradient[i] * entry * gradient[j];
    system.linearize(q, v, t, mass, l_q, l_v, &mut product);
    let squared = gradient.iter().fold(zero, |sum, &entry| sum + entry * entry);
    sum / (squared * squared)
}

impl<S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> Passage<'_, S, M, T> {
    /// Goes back to where the flight begins.
    fn go_back(&mut self) {
        let Self { memory, q, is_there, .. } = self;
        *is_there = false;
        memory.start.go_back(&mut memory.inner, q);
    }

    /// Goes back there and jumps by λ.
    fn jump(&mut self, lambda: T) {
        self.go_back();
        let ImpactsMemory { inner, wall, impulse, v, .. } = &mut *self.memory;
        for (j, (impulse, v)) in impulse.iter_mut().zip(v.iter_mut()).enumerate() {
            *impulse = lambda * wall.gradient[j];
            *v = wall.v[j] + lambda * wall.direction[j];
        }
        self.method.scheme.kick(inner, impulse, v);
    }

    fn advance(&mut self, s: T) -> Result<(), StepFailure> {
        if s == T::lift(0.0) {
            return Ok(());
        }
        let Self { method, system, memory, q, statistics, t, .. } = self;
        method.scheme.fly(Step { system, q, t: *t, h: s, statistics }, &mut memory.inner)
    }

    /// Sets `v` to the velocity at the present point, after a flight of length `s`.
    fn set_velocity(&mut self, s: T) -> Result<(), StepFailure> {
        let Self { method, system, memory, q, t, .. } = self;
        let ImpactsMemory { inner, v, .. } = &mut **memory;
        method.scheme.velocity_in_flight(Here { system, q, t: *t + s }, inner, v)
    }

    /// Looks at the gaps there, and leaves the velocity in `v`.
    pub(super) fn look(&mut self, s: T) -> Result<(), StepFailure> {
        self.set_velocity(s)?;
        let Self { system, memory, q, t, .. } = self;
        let ImpactsMemory { there, v, .. } = &mut **memory;
        there.look(*system, q, v, *t + s)
    }

    /// Makes the gaps that were looked at last those at the beginning of a flight.
    pub(super) fn look_on(&mut self) {
        let ImpactsMemory { here, there, .. } = &mut *self.memory;
        mem::swap(here, there);
    }

    /// Flies for the time `s` from where the flight begins.
    pub(super) fn fly(&mut self, s: T) -> Result<(), StepFailure> {
        if self.is_at_wall {
            self.balance(s)?;
            self.jump(self.memory.wall.impulse);
        } else if !mem::take(&mut self.is_there) {
            self.go_back();
        }
        self.advance(s)
    }

    /// The same for the flight that the run takes, where the run is already unless its length decides on the
    /// jump at its beginning, which is recorded.
    pub(super) fn settle(&mut self, s: T) -> Result<(), StepFailure> {
        if !self.is_at_wall || self.method.collision == Collision::Reflection {
            return Ok(());
        }
        self.balance(s)?;
        let &Wall { impulse, is_grazing, .. } = &self.memory.wall;
        self.jump(impulse);
        self.set_velocity(T::lift(0.0))?;
        self.record(impulse);
        self.memory.grazing += u64::from(is_grazing);
        self.advance(s)
    }

    /// Records the jump by λ, behind which the velocity is in `v`.
    fn record(&mut self, lambda: T) {
        let ImpactsMemory { events, count, v, .. } = &mut *self.memory;
        if let Some(event) = events.iter_mut().take(*count).last() {
            event.impulse = lambda;
            event.v.copy_from_slice(v);
        }
    }

    /// E_d of the flight of length `s` to the present point; of a short one the energy there.
    fn energy(&mut self, s: T) -> Result<T, StepFailure> {
        let Self { method, system, memory, q, t, h, .. } = self;
        let ImpactsMemory { start, delta, work, .. } = &mut **memory;
        if Scalar::abs(s) > T::lift(SHORT) * Scalar::abs(*h) {
            for (delta, (&q1, &q0)) in delta.iter_mut().zip(q.iter().zip(start.q.iter())) {
                *delta = q1 - q0;
            }
            let (interval, ends) = (Interval { t: *t, h: s }, Ends { q0: &start.q, delta });
            if let Some(energy) =
                method.scheme.energy_of_flight(Span { system: *system, interval, ends }, work)
            {
                return Ok(energy);
            }
        }
        self.set_velocity(s)?;
        Ok(self.system.energy(self.q, &self.memory.v, self.t + s))
    }

    /// Begins a flight at the present point, at the end of one of length `s`.
    fn begin_flight(&mut self, s: T) {
        let Self { memory, q, t, left, .. } = self;
        (*t, *left) = (*t + s, *left - s);
        let ImpactsMemory { inner, before, start, is_divided, .. } = &mut **memory;
        if !mem::replace(is_divided, true) {
            mem::swap(before, start);
        }
        start.keep(inner, q);
        self.look_on();
    }

    /// Divides the step at a surface from which the velocity leads away, after a flight of length `s`.
    ///
    /// # Errors
    /// [`StepFailure::Accumulation`] where that goes on and on.
    pub(super) fn divide(&mut self, surface: usize, s: T) -> Result<(), StepFailure> {
        self.begin_flight(s);
        self.is_at_wall = false;
        self.turns += 1;
        if self.turns > MOST { Err(self.accumulation(surface)) } else { Ok(()) }
    }

    fn accumulation(&self, surface: usize) -> StepFailure {
        StepFailure::Accumulation { surface, impacts: MOST, time: reported(self.t) }
    }

    /// Arrives at a surface after a flight of length `s`, and prepares the jump.
    pub(super) fn collide(&mut self, surface: usize, s: T) -> Result<(), StepFailure> {
        let energy = self.energy(s)?;
        self.begin_flight(s);
        self.is_at_wall = true;
        let Some(event) = self.memory.events.get_mut(self.memory.count) else {
            return Err(self.accumulation(surface));
        };
        (event.surface, event.time) = (surface, self.t);
        event.q.copy_from_slice(self.q);
        self.memory.count += 1;
        self.memory.total += 1;
        self.set_velocity(T::lift(0.0))?;
        let Self { system, memory, q, t, .. } = self;
        let ImpactsMemory { here, there, wall, work, v, .. } = &mut **memory;
        let rate = here.rate[surface];
        if !rate.is_finite() {
            return Err(StepFailure::Gap { surface, value: reported(rate) });
        }
        wall.v.copy_from_slice(v);
        wall.gradient.fill(T::lift(0.0));
        let mut row = |row: usize, j: usize, entry: T| {
            if row == surface {
                wall.gradient[j] += entry;
            }
        };
        system.gap_jacobian(q, *t, &mut there.gap, &mut row);
        wall.speed = wall.gradient.iter().zip(wall.v.iter()).fold(rate, |sum, (&g, &v)| sum - g * v);
        wall.direction.fill(T::lift(0.0));
        wall.energy = energy;
        let [force, momentum] = work;
        system.gradient(q, &wall.v, *t, force, momentum);
        wall.terms = [T::lift(0.0); 2];
        for (j, &p) in momentum.iter().enumerate() {
            wall.terms[0] += Scalar::abs(p * wall.v[j]);
            wall.terms[1] += Scalar::abs(p * q[j]);
        }
        self.reflect(surface, rate)
    }

    /// Finds the impulse of a reflection. The rate of change of the gap before it is `rate`.
    ///
    /// W(λ) = E(q, p⁻ + λ∂g/∂q) + λ∂g/∂t has the derivative ġ. An impact goes from W(0) through its minimum,
    /// where the motion towards the surface has been used up, to where W is as much higher as e² times what
    /// it has come down; for an L that is quadratic in v that is where ġ⁺ = −e ġ⁻.
    fn reflect(&mut self, surface: usize, rate: T) -> Result<(), StepFailure> {
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

    /// The impulse that turns the rate of change of a gap from one value to another, by the secant method.
    fn impulse_for(&mut self, surface: usize, [rate, wanted]: [T; 2]) -> Result<T, StepFailure> {
        let Self { system, memory, q, t, .. } = self;
        let ImpactsMemory { wall, work, .. } = &mut **memory;
        let lambda = inertia(*system, &wall.gradient, [q, &wall.v], *t, work) * (wanted - rate);
        let mut before = [T::lift(0.0), rate];
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
    fn balance(&mut self, s: T) -> Result<(), StepFailure> {
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
        let wall = &self.memory.wall;
        // Δ/s has the rounding of the coordinates over s.
        let terms = Scalar::abs(wall.energy) + wall.terms[0] + wall.terms[1] / Scalar::abs(s);
        let rounding = T::lift(ROUNDINGS) * T::default_epsilon() * terms;
        let is_solved = Scalar::abs(defect) <= T::lift(NEAR) * Scalar::abs(reflection * rate)
            || (s != T::lift(0.0) && Scalar::abs(defect) <= rounding);
        let wall = &mut self.memory.wall;
        wall.is_grazing = !(is_behind && is_solved);
        wall.impulse = if wall.is_grazing { reflection } else { lambda };
        Ok(())
    }
}
