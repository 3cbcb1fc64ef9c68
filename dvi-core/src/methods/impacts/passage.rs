//! A step as a sequence of flights from impact to impact.
//!
//! A flight of length s begins at a point of the run, after an impact with another momentum, and ends at
//! q(s). The first impact on it is looked for by the gaps and rates at its two ends, and found on the flight
//! itself, g(q(s), t + s) = 0, within a bracket.

use super::memory::ImpactsMemory;
use super::{Collision, Impacts};
use crate::error::StepFailure;
use crate::methods::FreeFlight;
use crate::scalar::norm::reported;
use crate::solve::crossing::ITERATIONS;
use crate::state::Statistics;
use crate::{Real, Scalar, UnilateralLagrangian, Vector};

/// Flights between one that ends well and one that fails: it may have left the domain of L behind a surface.
const SHORTENED: usize = 50;
/// Closer looks at the surfaces of a flight that has become shorter.
const SOUGHT: usize = 60;
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
        self.look(T::lift(0.0))?;
        self.look_on();
        while let Some((surface, s)) = self.seek_impact()? {
            self.arrive(surface, s)?;
        }
        // The flight that has no impact is the one to the end of the step.
        self.settle(self.left)
    }

    /// A rate of change along the run, which may go back in time.
    pub(super) fn along(&self, rate: T) -> T {
        if self.h < T::lift(0.0) { -rate } else { rate }
    }

    /// Flies for the time `s` and looks at the gaps there.
    pub(super) fn try_flight(&mut self, s: T) -> Result<(), StepFailure> {
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
            // The time is zero, but for its derivatives.
            let gap = here.gap[surface];
            return Ok(Some((surface, (T::lift(reported(gap)) - gap) / here.rate[surface])));
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
}
