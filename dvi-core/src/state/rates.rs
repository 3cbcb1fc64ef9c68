//! The mean rates of change of the last steps, extrapolated to guess those of the next, for methods whose
//! steps are of any length.

use super::history::{COEFFICIENTS, DEPTH, Guess};
use crate::memory::lasting;
use crate::{Real, Scalar, Space, System, Vector};

/// The length of a ring: a power of two, which is quick to go around in.
const RING: usize = DEPTH.next_power_of_two();

/// `KINDS` kinds of rates of the last steps.
#[derive(Debug)]
pub(crate) struct Rates<S: System, T: Real, const KINDS: usize = 1> {
    kinds: [Kind<S, T>; KINDS],
    /// How many steps are remembered.
    len: usize,
    /// Where the newest are.
    newest: usize,
    /// Zero before the first step.
    last_step: T,
}

#[derive(Debug)]
struct Kind<S: System, T: Real> {
    /// A ring that is written twice, so that the last seven always stand side by side, the newest first.
    last: [Vector<S, T>; 2 * RING],
    /// The first guess.
    seed: Vector<S, T>,
}

impl<S: System, T: Real, const KINDS: usize> Rates<S, T, KINDS> {
    /// No step yet; the first guesses are `seeds`.
    pub(crate) fn new(system: &S, seeds: [Vector<S, T>; KINDS]) -> Self {
        let kind = |seed| Kind { last: system.space().vectors(), seed };
        Self { kinds: seeds.map(kind), len: 0, newest: 0, last_step: T::lift(0.0) }
    }

    /// Sets `rates` to those of a step of length `h` to begin with.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn guess(&self, h: T, guess: Guess, rates: [&mut Vector<S, T>; KINDS]) {
        // The full sum has a known length and makes straight code, which is the first to be asked for.
        let len = match guess {
            Guess::Extrapolated if self.len == DEPTH && is_similar(h, self.last_step) => Some(DEPTH),
            Guess::Extrapolated if self.len == 0 || is_similar(h, self.last_step) => Some(self.len),
            Guess::Extrapolated | Guess::Zero => None,
        };
        for (kind, rates) in self.kinds.iter().zip(rates) {
            match len {
                Some(len) => kind.extrapolate(self.newest, len, rates),
                None => rates.fill(T::lift(0.0)),
            }
        }
    }

    /// Remembers those of a completed step of length `h`.
    #[inline]
    pub(crate) fn push(&mut self, h: T, rates: [&Vector<S, T>; KINDS]) {
        if h != self.last_step {
            if !is_similar(h, self.last_step) {
                self.len = 0;
            }
            self.last_step = h;
        }
        let newest = self.newest.wrapping_sub(1) % RING;
        for (kind, rates) in self.kinds.iter_mut().zip(rates) {
            kind.last[newest].copy_from_slice(rates);
            kind.last[newest + RING].copy_from_slice(rates);
        }
        self.newest = newest;
        if self.len < DEPTH {
            self.len += 1;
        }
    }

    /// Sets `rates` to what those of the last steps lead to.
    pub(crate) fn extrapolate(&self, rates: [&mut [T]; KINDS]) {
        self.kinds
            .iter()
            .zip(rates)
            .for_each(|(kind, rates)| kind.extrapolate(self.newest, self.len, rates));
    }

    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        self.len <= DEPTH && self.newest < RING
    }
}

impl<S: System, T: Real> Kind<S, T> {
    /// Sets `rates` to what the last `len` lead to.
    #[inline]
    fn extrapolate(&self, newest: usize, len: usize, rates: &mut [T]) {
        // The full sum has a known length and makes straight code.
        match len {
            DEPTH => self.combine(newest, DEPTH, rates),
            0 => rates.copy_from_slice(&self.seed),
            len => self.combine(newest, len, rates),
        }
    }

    #[inline]
    fn combine(&self, newest: usize, len: usize, rates: &mut [T]) {
        // −0 is neutral for every number.
        rates.fill(T::lift(-0.0));
        for (&coefficient, last) in COEFFICIENTS[len][..len].iter().zip(&self.last[newest % RING..][..DEPTH])
        {
            for (rate, &last) in rates.iter_mut().zip(last.iter()) {
                *rate += T::lift(coefficient) * last;
            }
        }
    }
}

lasting!([S: System, T: Real, const KINDS: usize] Rates<S, T, KINDS>, T;
    parts kinds, count len, count newest, number last_step; is_sound);

lasting!([S: System, T: Real] Kind<S, T>, T; vectors last, numbers seed);

/// Whether what a step of length `last` has left may be extrapolated to one of length `h`: both have the
/// same sign, and neither is twice as long as the other.
#[inline]
pub(crate) fn is_similar<T: Real>(h: T, last: T) -> bool {
    let [size, last_size] = [h, last].map(Scalar::abs);
    h == last || h * last > T::lift(0.0) && size + size > last_size && last_size + last_size > size
}
