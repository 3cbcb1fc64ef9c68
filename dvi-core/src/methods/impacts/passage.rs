//! A step as a sequence of flights from impact to impact.
//!
//! A flight of length s begins at a point of the run, after an impact with another momentum, and ends at
//! q(s). The first impact on it is looked for by the gaps and rates at its two ends, and found on the flight
//! itself, g(q(s), t + s) = 0, within a bracket.

use super::memory::{ImpactsMemory, terms};
use super::{Collision, Impacts};
use crate::error::StepFailure;
use crate::methods::FreeFlight;
use crate::scalar::norm::reported;
use crate::solve::crossing::{APART, Cubic, ITERATIONS, Sample, dip, zero};
use crate::state::Statistics;
use crate::{Real, Scalar, UnilateralLagrangian, Vector};

/// Flights between one that ends well and one that fails: it may have left the domain of L behind a surface.
const SHORTENED: usize = 50;
/// Closer looks at the surfaces of a flight that has become shorter.
const SOUGHT: usize = 60;
/// Iterations for the derivatives of that time, of numbers that carry some.
const POLISHED: usize = 3;
/// A gap that was closed is closed but for so many rounding errors.
const ROUNDINGS: f64 = 64.0;
/// An impact is on its surface but for so many rounding errors: more, as the equations of a flight are
/// solved to some.
const OFF: f64 = 1e4;

/// A step that is being taken.
pub(super) struct Passage<'a, S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> {
    pub(super) method: &'a Impacts<M>,
    pub(super) system: &'a S,
    pub(super) memory: &'a mut ImpactsMemory<S, M::Memory, T>,
    pub(super) q: &'a mut Vector<S, T>,
    pub(super) statistics: &'a mut Statistics,
    /// When the flight at hand begins.
    pub(super) t: T,
    /// What is left of the step.
    pub(super) left: T,
    /// The length of the step.
    pub(super) h: T,
    /// Whether the flight at hand begins with a jump of the momentum.
    pub(super) is_at_wall: bool,
    /// Whether the run is where the flight begins.
    pub(super) is_there: bool,
    /// How often the step has been divided at a surface without an impact.
    pub(super) turns: usize,
}

impl<S: UnilateralLagrangian<T>, M: FreeFlight<S, T>, T: Real> Passage<'_, S, M, T> {
    /// Takes the step.
    ///
    /// # Errors
    /// Any [`StepFailure`]; the run is then anywhere.
    pub(super) fn take(mut self) -> Result<(), StepFailure> {
        self.memory.count = 0;
        self.look(T::lift(0.0))?;
        self.look_on();
        while let Some((surface, s)) = self.seek_impact()? {
            self.arrive(surface, s)?;
        }
        // The flight that has no impact is the one to the end of the step.
        self.settle(self.left)
    }

    /// A rate of change along the run, which may go back in time.
    fn along(&self, rate: T) -> T {
        if self.h < T::lift(0.0) { -rate } else { rate }
    }

    /// Flies for the time `s` and looks at the gaps there.
    fn try_flight(&mut self, s: T) -> Result<(), StepFailure> {
        self.fly(s)?;
        self.look(s)
    }

    /// Flies to a surface, and begins another flight there: behind an impact or, where the velocity leads
    /// away from the surface already, as it may after a long one, without. Where the end of a flight has
    /// jumped across the surface with its length, as the impulse that keeps the discrete energy may, it
    /// begins with a reflection from now on, and is to be taken once more.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`] if a flight without such a jump does not end at the surface.
    fn arrive(&mut self, surface: usize, s: T) -> Result<(), StepFailure> {
        self.try_flight(s)?;
        let size = self.rounding(surface, s);
        let gap = Scalar::abs(self.memory.there.gap[surface]);
        if gap <= T::lift(OFF) * size {
            let is_turned = self.along(self.memory.there.rate[surface]) >= T::lift(0.0);
            self.settle(s)?;
            return if is_turned { self.divide(surface, s) } else { self.collide(surface, s) };
        }
        let may_jump = self.method.collision == Collision::Variational;
        if self.is_at_wall && may_jump && !self.memory.wall.is_grazing {
            let wall = &mut self.memory.wall;
            (wall.is_grazing, wall.impulse) = (true, wall.reflection);
            return Ok(());
        }
        let [correction, tolerance] = [gap, T::lift(OFF) * size].map(reported);
        Err(StepFailure::NotConverged { iterations: ITERATIONS, correction, tolerance })
    }

    /// The next impact, by flights that all begin with the same law of impact.
    fn seek_impact(&mut self) -> Result<Option<(usize, T)>, StepFailure> {
        let is_reflected = self.memory.wall.is_grazing;
        let found = self.next_impact();
        if self.is_at_wall && self.memory.wall.is_grazing != is_reflected {
            self.next_impact()
        } else {
            found
        }
    }

    /// The surface and the length of the flight at which the next impact happens; `None` if there is none in
    /// what is left of the step.
    fn next_impact(&mut self) -> Result<Option<(usize, T)>, StepFailure> {
        let (zero, here) = (T::lift(0.0), &self.memory.here);
        let mut surfaces = here.gap.iter().zip(here.rate.iter());
        // It may be reached where the flight begins.
        if let Some(surface) = surfaces.position(|(&gap, &rate)| gap <= zero && self.along(rate) < zero) {
            return Ok(Some((surface, zero)));
        }
        let left = self.left;
        match self.try_flight(left) {
            Ok(()) => self.first_before(left),
            Err(failure) => self.before_failure(failure),
        }
    }

    /// The first impact in a flight whose end fails, perhaps because it is outside of the domain of L.
    fn before_failure(&mut self, failure: StepFailure) -> Result<Option<(usize, T)>, StepFailure> {
        let [mut flown, mut failed] = [T::lift(0.0), self.left];
        for _ in 0..SHORTENED {
            let middle = T::lift(0.5) * (flown + failed);
            if self.try_flight(middle).is_err() {
                failed = middle;
            } else if let Some(found) = self.first_before(middle)? {
                return Ok(Some(found));
            } else {
                flown = middle;
            }
        }
        Err(failure)
    }

    /// The first impact in a flight of length `end`, at whose end the run is. Where there is none the run is
    /// there again, else where the impact is.
    fn first_before(&mut self, mut end: T) -> Result<Option<(usize, T)>, StepFailure> {
        let mut found: Option<(usize, T)> = None;
        for _ in 0..SOUGHT {
            let before = end;
            for surface in 0..self.memory.here.gap.len() {
                let is_end = found.map(|(known, _)| known == surface);
                if let Some(s) = self.closes(surface, end, is_end)? {
                    (end, found) = (s, Some((surface, s)));
                }
            }
            // A shorter flight is a closer look at all surfaces.
            if end == before {
                break;
            }
        }
        Ok(found)
    }

    /// When the gap of a surface closes for the first time in a flight of length `end`, at whose end the run
    /// is; `is_end` says whether that is an impact with this surface or with another one. Where the gap does
    /// not close, the run is at the end again.
    fn closes(&mut self, surface: usize, end: T, is_end: Option<bool>) -> Result<Option<T>, StepFailure> {
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
        let low = match is_behind {
            true => one,
            false => match self.least(surface, end, first)? {
                Some(low) => low,
                None => return Ok(None),
            },
        };
        let open = match is_closed {
            true => self.open(surface, end, self.cubic(surface, end, zero).closes_before(low))?,
            false => zero,
        };
        self.locate(surface, end, [open, low]).map(Some)
    }

    /// What rounding errors of the coordinates, and of their changes in a step, make of the gap of a surface
    /// at the end of a flight of length `s`, where the run is.
    fn rounding(&mut self, surface: usize, s: T) -> T {
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
        let low = dip([from, to], 0, |place| {
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
        let found = zero([a, b], |part| at(self, part))?;
        let mut part = found.place;
        // What is left is less than rounding, but not in the derivatives of numbers that carry some.
        for _ in 0..POLISHED {
            let change = at(self, part)? / found.slope;
            if !change.is_finite() || Scalar::abs(change) > T::lift(APART) {
                break;
            }
            part -= change;
        }
        Ok(part * end)
    }
}
