//! Events of a step that have been found, and how they are handed out.

use super::{Conditions, Event, EventOf, Watch};
use crate::error::{StepError, StepFailure};
use crate::methods::JUMPS;
use crate::run::Run;
use crate::run::dense::{Dense, PLACES, are_one};
use crate::scalar::norm::{reported, smaller};
use crate::{Real, Scalar};

/// Of one condition: two between neighbours of the ends of a step and of what divides it, and one at the
/// second of them; and one at each jump.
const MOST: usize = 3 * (PLACES + JUMPS + 1) + JUMPS;
/// An event in this part of the first step after a change of the state is a hop.
const HOP: f64 = 1e-2;
/// After so many hops of one condition, each shorter than the one before, events accumulate.
const HOPS: usize = 4;

/// The parts of a step at which they are, of each condition.
pub(super) struct Found<T, const N: usize> {
    parts: [[Option<T>; MOST]; N],
    /// How many have been found of each.
    count: [usize; N],
}

impl<T: Real, const N: usize> Found<T, N> {
    pub(super) fn new() -> Self {
        Self { parts: [[None; MOST]; N], count: [0; N] }
    }

    pub(super) fn forget(&mut self) {
        self.count = [0; N];
    }

    pub(super) fn push(&mut self, index: usize, part: T) {
        self.parts[index][self.count[index]] = Some(part);
        self.count[index] += 1;
    }

    /// Those of a condition that are left.
    pub(super) fn of(&self, index: usize) -> impl Iterator<Item = T> {
        self.parts[index][..self.count[index]].iter().copied().flatten()
    }

    /// The first one, and its condition. Of those at one part but for rounding it is the first in the array.
    #[inline]
    pub(super) fn first(&self) -> Option<(T, usize)> {
        let least = (0..N).flat_map(|index| self.of(index)).reduce(smaller)?;
        (0..N).find_map(|index| self.of(index).find(|&part| are_one(least, part)).map(|part| (part, index)))
    }

    /// Takes out one of a condition.
    pub(super) fn remove(&mut self, (part, index): (T, usize)) {
        let mut of = self.parts[index].iter_mut().filter(|found| **found == Some(part));
        if let Some(found) = of.next() {
            *found = None;
        }
    }
}

impl<R: Run, G: Conditions<R::System, R::Scalar, N>, const N: usize> Watch<R, G, N> {
    /// Whether an event of the last step has not been handed out.
    #[inline]
    pub(super) fn is_left(&self) -> bool {
        self.found.first().is_some()
    }

    /// The next event of the last step, if one is left that is not after `end`.
    pub(super) fn next_before(
        &mut self,
        run: &mut Dense<R>,
        end: Option<R::Scalar>,
    ) -> Result<Option<EventOf<R>>, StepError> {
        let Some(first) = self.found.first() else { return Ok(None) };
        let (part, index) = first;
        if end.is_some_and(|end| run.is_before(end, run.time_at(part))) {
            return Ok(None);
        }
        self.found.remove(first);
        self.at(run, part, index).map(Some).map_err(|failure| run.error(failure))
    }

    fn at(&mut self, run: &mut Dense<R>, part: R::Scalar, index: usize) -> Result<EventOf<R>, StepFailure> {
        let (time, state) = run.at_part(part)?;
        // What happens where the state has been set is part of that event.
        if part > R::Scalar::lift(0.0) {
            let is_shorter = self.last.is_some_and(|(last, hop)| last == index && part < hop);
            let is_hop = self.steps == 1 && part < R::Scalar::lift(HOP) && is_shorter;
            self.hops = if is_hop { self.hops + 1 } else { 0 };
            self.last = Some((index, part));
        }
        if self.hops > HOPS {
            return Err(StepFailure::Hops { event: index, count: HOPS, time: reported(time) });
        }
        Ok(Event { index, time, state })
    }
}
