//! The mean rates of change of the last steps, extrapolated to guess those of the next, for methods whose
//! steps are of any length.

use super::history::{Guess, History};
use crate::memory::{Memory, lasting};
use crate::{Real, Scalar, System, Vector};

/// `KINDS` kinds of rates of the last steps.
#[derive(Debug)]
pub(crate) struct Rates<S: System, T: Real, const KINDS: usize = 1> {
    kinds: [History<S, T>; KINDS],
    /// Zero before the first step.
    last_step: T,
}

impl<S: System, T: Real, const KINDS: usize> Rates<S, T, KINDS> {
    /// No step yet; the first guesses are `seeds`.
    pub(crate) fn new(system: &S, seeds: [Vector<S, T>; KINDS]) -> Self {
        Self { kinds: seeds.map(|seed| History::new(system, Some(seed))), last_step: T::lift(0.0) }
    }

    /// Sets `rates` to those of a step of length `h` to begin with.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn guess(&self, h: T, guess: Guess, rates: [&mut Vector<S, T>; KINDS]) {
        let is_first = self.last_step == T::lift(0.0);
        let guess = if is_first || is_similar(h, self.last_step) { guess } else { Guess::Zero };
        for (kind, rates) in self.kinds.iter().zip(rates) {
            guess.begin(rates, |rates| kind.extrapolate(rates));
        }
    }

    /// Remembers those of a completed step of length `h`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn push(&mut self, h: T, rates: [&Vector<S, T>; KINDS]) {
        if h != self.last_step {
            if !is_similar(h, self.last_step) {
                self.kinds.iter_mut().for_each(History::clear);
            }
            self.last_step = h;
        }
        self.kinds.iter_mut().zip(rates).for_each(|(kind, rates)| kind.push(rates));
    }

    /// Those of the last step, or those to begin with.
    pub(crate) fn latest(&self) -> [&Vector<S, T>; KINDS] {
        self.kinds.each_ref().map(History::latest)
    }

    /// Sets `rates` to what those of the last steps lead to.
    pub(crate) fn extrapolate(&self, rates: [&mut Vector<S, T>; KINDS]) {
        self.kinds.iter().zip(rates).for_each(|(kind, rates)| kind.extrapolate(rates));
    }
}

impl<S: System, T: Real, const KINDS: usize> Memory<T> for Rates<S, T, KINDS> {
    lasting!(T; parts kinds, number last_step);
}

/// Whether what a step of length `last` has left may be extrapolated to one of length `h`: both have the
/// same sign, and neither is twice as long as the other.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_similar<T: Real>(h: T, last: T) -> bool {
    let [size, last_size] = [h, last].map(Scalar::abs);
    h == last || h * last > T::lift(0.0) && size + size > last_size && last_size + last_size > size
}
