//! The time of a run.

use crate::Real;
use crate::memory::lasting;
use crate::methods::Clock;
use crate::state::summation::left_out;

/// When the steps of a run begin: those of one length by their number, others by their sum, with what
/// rounding has left out of it (Neumaier 1974).
#[derive(Clone, Copy, Debug)]
pub(super) struct Time<T> {
    /// That of the first step, or the sum of all of other lengths.
    start: T,
    rest: T,
    /// The length of the latest step, or of the first if there is none.
    pub(super) h: T,
    /// The number of steps at the start, counted down.
    step: u64,
}

lasting!([T: Real] Time<T>, T; number start, number rest, number h, count step);

impl<T: Real> Time<T> {
    /// Of a run that begins after `steps` steps with one of length `h`.
    pub(super) fn new(start: T, h: T, steps: u64) -> Self {
        Self { start, rest: T::lift(0.0), h, step: steps.wrapping_neg() }
    }

    /// The clock after `steps` steps.
    #[inline]
    pub(super) fn after(&self, steps: u64) -> Clock<T> {
        Clock { start: self.start + self.rest, h: self.h, step: self.step }.after(steps)
    }

    /// Adds a step of length `h`, after which there are `steps`.
    #[inline]
    pub(super) fn advance(&mut self, h: T, steps: u64) {
        let sum = self.start + h;
        self.rest += left_out(self.start, h, sum);
        (self.start, self.h, self.step) = (sum, h, steps.wrapping_neg());
    }
}

#[cfg(test)]
mod tests {
    use super::Time;

    #[test]
    fn the_clock_adds_as_if_in_twice_the_precision() {
        let mut clock = Time::new(1e9, 0.1, 0);
        // Sums of integers and of multiples of 2⁻³⁰ are exact in integers.
        let mut exact: i128 = 1_000_000_000 << 30;
        for k in 0..1_000_000_i64 {
            let h = (k * k) % 1013 - 100;
            clock.advance(h as f64 / f64::from(1 << 30), k as u64);
            exact += i128::from(h);
        }
        assert_eq!(clock.after(999_999).time(), exact as f64 / f64::from(1 << 30));
    }
}
