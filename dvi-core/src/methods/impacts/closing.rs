//! When a gap closes in a flight: found on the flight itself, within a bracket.

use super::gaps::terms;
use super::memory::ImpactsMemory;
use super::passage::Passage;
use crate::error::StepFailure;
use crate::methods::FreeFlight;
use crate::scalar::carries_derivatives;
use crate::scalar::norm::{reported, smaller};
use crate::solve::crossing::{APART, Cubic, Sample, dip, zero};
use crate::{Real, Scalar, UnilateralLagrangian};

/// Iterations for the derivatives of that time, of numbers that carry some.
const POLISHED: usize = 3;
/// Their slope is that of this last part of a flight, at most.
const BESIDE: f64 = 1e-3;
/// A gap that was closed is closed but for so many rounding errors.
const ROUNDINGS: f64 = 64.0;

impl<S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> Passage<'_, S, M, T> {
    /// When the gap of a surface closes for the first time in a flight of length `end`, at whose end the run
    /// is; `is_end` says whether that is an impact with this surface or with another one. Where the gap does
    /// not close, the run is at the end again.
    pub(super) fn closes(
        &mut self,
        surface: usize,
        end: T,
        is_end: Option<bool>,
    ) -> Result<Option<T>, StepFailure> {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let [here, there] = [self.memory.here.gap[surface], self.memory.there.gap[surface]];
        let is_behind = there < zero && is_end != Some(true);
        if !is_behind && !self.cubic(surface, end, here).may_close() {
            return Ok(None);
        }
        let rounding = T::lift(ROUNDINGS) * self.rounding(surface, end);
        let is_closed = here <= rounding && self.along(self.memory.here.rate[surface]) >= zero;
        // Rounding may be all that is seen of a gap that was closed at the beginning, or closes where the
        // flight ends at another surface.
        let may_be_rounding = is_closed || (is_behind && is_end == Some(false));
        if may_be_rounding && Scalar::abs(there) <= rounding {
            return Ok(None);
        }
        let first = if is_closed { zero } else { here };
        let low = if is_behind { Some(one) } else { self.least(surface, end, first)? };
        let Some(low) = low else { return Ok(None) };
        let mut open = zero;
        if is_closed {
            open = self.open(surface, end, self.cubic(surface, end, zero).closes_before(low))?;
        }
        self.locate(surface, end, [open, low]).map(Some)
    }

    /// What rounding errors of the coordinates, and of their changes in a step, make of the gap of a surface
    /// at the end of a flight of length `s`, where the run is.
    pub(super) fn rounding(&mut self, surface: usize, s: T) -> T {
        let Self { system, memory, q, t, h, .. } = self;
        let ImpactsMemory { row, v, .. } = &mut **memory;
        let mut size = T::lift(0.0);
        terms(*system, [q, v], [*t + s, *h], row, |of, term| {
            if of == surface {
                size += term;
            }
        });
        T::default_epsilon() * size
    }

    /// The cubic through the gap of a surface in a flight of length `end`, whose end has been looked at,
    /// from the gap `first`.
    fn cubic(&self, surface: usize, end: T, first: T) -> Cubic<T> {
        let ImpactsMemory { here, there, .. } = &*self.memory;
        Cubic::through([first, there.gap[surface]], [here.rate[surface] * end, there.rate[surface] * end])
    }

    /// A part of a flight of length `end`, from the gap `first`, at which the gap of a surface is negative,
    /// near its least value in between; if there is none, the run is at the end of the flight again.
    fn least(&mut self, surface: usize, end: T, first: T) -> Result<Option<T>, StepFailure> {
        let ImpactsMemory { here, there, .. } = &*self.memory;
        let [from, to] = [T::lift(0.0), T::lift(1.0)];
        let from = Sample { place: from, value: first, slope: here.rate[surface] * end };
        let to = Sample { place: to, value: there.gap[surface], slope: there.rate[surface] * end };
        let low = dip([from, to], 0, &mut |place| {
            self.try_flight(place * end)?;
            let there = &self.memory.there;
            Ok(Sample { place, value: there.gap[surface], slope: there.rate[surface] * end })
        })?;
        if low.is_none() {
            self.try_flight(end)?;
        }
        Ok(low)
    }

    /// A part of a flight of length `end`, shorter than `guess`, at which the gap of a surface is open by
    /// more than rounding errors.
    ///
    /// # Errors
    /// [`StepFailure::Contact`] if there is none.
    fn open(&mut self, surface: usize, end: T, guess: T) -> Result<T, StepFailure> {
        let mut part = guess;
        // The gap is that of a hop of which the guess is the end.
        while {
            part *= T::lift(0.5);
            self.t + part * end != self.t
        } {
            self.try_flight(part * end)?;
            let rounding = T::lift(ROUNDINGS) * self.rounding(surface, part * end);
            if self.memory.there.gap[surface] > rounding {
                return Ok(part);
            }
        }
        let here = &self.memory.here;
        let [gap, rate] = [here.gap[surface], here.rate[surface]].map(reported);
        Err(StepFailure::Contact { surface, gap, rate })
    }

    /// The length of the flight at which the gap of a surface closes, between parts of `end` at which it is
    /// open and closed.
    fn locate(&mut self, surface: usize, end: T, [open, closed]: [T; 2]) -> Result<T, StepFailure> {
        let at = |of: &mut Self, part: T| -> Result<T, StepFailure> {
            of.try_flight(part * end)?;
            Ok(of.memory.there.gap[surface])
        };
        let is_begun = open > T::lift(0.0);
        let a = [open, if is_begun { at(self, open)? } else { self.memory.here.gap[surface] }];
        let b = [closed, at(self, closed)?];
        let found = zero([a, b], &mut |part| at(self, part))?;
        let mut part = found.place;
        if carries_derivatives::<T>() && part > T::lift(0.0) {
            // What is left is less than rounding, but not in the derivatives.
            let chord = smaller(T::lift(APART), T::lift(BESIDE) * part);
            let slope = (at(self, part)? - at(self, part - chord)?) / chord;
            for _ in 0..POLISHED {
                let change = at(self, part)? / slope;
                if Scalar::abs(change) <= chord {
                    part -= change;
                }
            }
        }
        Ok(part * end)
    }
}
