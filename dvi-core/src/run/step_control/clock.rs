//! The time of a run whose steps differ in length: a compensated sum of them (Neumaier 1974).

use crate::memory::{Memory, lasting};
use crate::{Real, Scalar};

/// The sum of the steps, and what rounding has left out of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct VariableClock<T> {
    sum: T,
    rest: T,
}

impl<T: Real> Memory<T> for VariableClock<T> {
    lasting!(T; number sum, number rest);
}

impl<T: Real> VariableClock<T> {
    pub(super) fn new(start: T) -> Self {
        Self { sum: start, rest: T::lift(0.0) }
    }

    pub(super) fn advance(&mut self, h: T) {
        let sum = self.sum + h;
        self.rest += if Scalar::abs(self.sum) >= Scalar::abs(h) {
            (self.sum - sum) + h
        } else {
            (h - sum) + self.sum
        };
        self.sum = sum;
    }

    pub(super) fn time(&self) -> T {
        self.sum + self.rest
    }
}

#[cfg(test)]
mod tests {
    use super::VariableClock;

    #[test]
    fn the_clock_adds_as_if_in_twice_the_precision() {
        let mut clock = VariableClock::new(1e9);
        // Sums of integers and of multiples of 2⁻³⁰ are exact in integers.
        let mut exact: i128 = 1_000_000_000 << 30;
        for k in 0..1_000_000_i64 {
            let h = (k * k) % 1013 - 100;
            clock.advance(h as f64 / f64::from(1 << 30));
            exact += i128::from(h);
        }
        assert_eq!(clock.time(), exact as f64 / f64::from(1 << 30));
    }
}
