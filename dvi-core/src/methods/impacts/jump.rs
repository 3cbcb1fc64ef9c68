//! The jump of the momentum at an impact, p⁺ = p⁻ + λ ∂g/∂q, and the flight behind it.

use core::mem;

use super::Collision;
use super::memory::{ImpactsMemory, Wall};
use super::passage::Passage;
use crate::discrete::{Interval, Span};
use crate::error::StepFailure;
use crate::methods::{FreeFlight, Here, JUMPS, Step};
use crate::scalar::carries_derivatives;
use crate::scalar::norm::reported;
use crate::{Real, Scalar, UnilateralLagrangian};

/// Flights that are shorter, as a part of the step, have no discrete energy of their own: Δ/s has the
/// rounding of the coordinates over s, and the energy at their end differs from it by less.
const SHORT: f64 = 1e-6;

impl<S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> Passage<'_, S, M, T> {
    /// Goes back to where the flight begins.
    fn go_back(&mut self) {
        let Self { memory, q, is_there, .. } = self;
        *is_there = false;
        memory.start.go_back(q, &mut memory.inner);
    }

    /// Goes back there and jumps by λ.
    pub(super) fn jump(&mut self, lambda: T) {
        self.go_back();
        let ImpactsMemory { inner, wall, impulse, v, .. } = &mut *self.memory;
        for (j, (impulse, v)) in impulse.iter_mut().zip(v.iter_mut()).enumerate() {
            *impulse = lambda * wall.gradient[j];
            *v = wall.v[j] + lambda * wall.direction[j];
        }
        self.method.scheme.kick(inner, impulse, v);
    }

    pub(super) fn advance(&mut self, s: T) -> Result<(), StepFailure> {
        if s == T::lift(0.0) {
            return if carries_derivatives::<T>() { self.drift(s) } else { Ok(()) };
        }
        let Self { method, system, memory, q, statistics, t, .. } = self;
        method.scheme.fly(Step { system, q, t: *t, h: s, statistics }, &mut memory.inner)
    }

    /// Moves for a time that is zero but for its derivatives, as between an impact and the end of a step
    /// that are one.
    fn drift(&mut self, s: T) -> Result<(), StepFailure> {
        self.set_velocity(T::lift(0.0))?;
        let Self { method, system, memory, q, t, .. } = self;
        let ImpactsMemory { inner, impulse, v, work: [force, momentum], .. } = &mut **memory;
        system.gradient(q, v, *t, force, momentum);
        for (j, q) in q.iter_mut().enumerate() {
            *q += s * v[j];
            impulse[j] = s * force[j];
        }
        method.scheme.kick(inner, impulse, v);
        Ok(())
    }

    /// Sets `v` to the velocity at the present point, after a flight of length `s`.
    fn set_velocity(&mut self, s: T) -> Result<(), StepFailure> {
        let Self { system, memory, q, t, .. } = self;
        let ImpactsMemory { inner, v, .. } = &mut **memory;
        M::carried(inner).velocity(Here { system, q, t: *t + s }, v)
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
    pub(super) fn record(&mut self, lambda: T) {
        let ImpactsMemory { events, count, v, .. } = &mut *self.memory;
        if let Some(event) = events.iter_mut().take(*count).last() {
            event.impulse = lambda;
            event.v.copy_from_slice(v);
        }
    }

    /// E_d of the flight of length `s` to the present point; of a short one the energy there.
    pub(super) fn energy(&mut self, s: T) -> Result<T, StepFailure> {
        let Self { method, system, memory, q, t, h, .. } = self;
        let ImpactsMemory { start, delta, work, .. } = &mut **memory;
        if Scalar::abs(s) > T::lift(SHORT) * Scalar::abs(*h)
            && let Some(energy) = M::DISCRETE_ENERGY
        {
            for (delta, (&q1, &q0)) in delta.iter_mut().zip(q.iter().zip(start.q.iter())) {
                *delta = q1 - q0;
            }
            let interval = Interval { t: *t, h: s };
            let span = Span { system: *system, interval, q0: &start.q, delta };
            return Ok(energy(&method.scheme, span, work));
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
        start.take(q, inner);
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
        if self.turns > JUMPS { Err(self.accumulation(surface)) } else { Ok(()) }
    }

    fn accumulation(&self, surface: usize) -> StepFailure {
        StepFailure::Accumulation { surface, impacts: JUMPS, time: reported(self.t) }
    }

    /// Arrives at a surface after a flight of length `s`, and prepares the jump.
    pub(super) fn collide(&mut self, surface: usize, s: T) -> Result<(), StepFailure> {
        let energy = self.energy(s)?;
        self.begin_flight(s);
        self.is_at_wall = true;
        self.set_velocity(T::lift(0.0))?;
        let ImpactsMemory { events, count, total, v, .. } = &mut *self.memory;
        let Some(event) = events.get_mut(*count) else {
            return Err(self.accumulation(surface));
        };
        (event.surface, event.time) = (surface, self.t);
        event.part = T::lift(1.0) - self.left / self.h;
        event.q.copy_from_slice(self.q);
        event.v_before.copy_from_slice(v);
        *count += 1;
        *total += 1;
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
}
