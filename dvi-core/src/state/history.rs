//! The increments of the last steps, extrapolated to guess the next.
//!
//! The guess is the value at the next step of the polynomial through the last m increments:
//! Σᵢ (−1)ⁱ⁻¹ (m over i) s₋ᵢ, i = 1 … m.

use core::ops::Deref;

use crate::memory::lasting;
use crate::scalar::passes::lanes_stay_together;
use crate::{Real, Scalar, Space, System, Vector};

/// Where Newton begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Guess {
    /// What the last steps let expect, which is best as a rule.
    Extrapolated,
    /// No increment: Newton's first iterate is then the linearly implicit step, which is safer where steps
    /// are so long that extrapolation is off.
    Zero,
}

/// How many increments are kept.
///
/// More terms guess better and amplify rounding errors more, by 2ᵐ. Iterations per step of the midpoint
/// scheme on four vortices to a relative 1e-12: 6.0 with m = 3, 5.2 with 5, 4.4 with 7, 4.2 with 8.
pub(crate) const DEPTH: usize = 7;

/// Row m: the coefficients of the last m increments, the newest first.
#[rustfmt::skip]
pub(super) const COEFFICIENTS: [[f64; DEPTH]; DEPTH + 1] = [
    [0.0,   0.0,  0.0,   0.0,  0.0,   0.0, 0.0],
    [1.0,   0.0,  0.0,   0.0,  0.0,   0.0, 0.0],
    [2.0,  -1.0,  0.0,   0.0,  0.0,   0.0, 0.0],
    [3.0,  -3.0,  1.0,   0.0,  0.0,   0.0, 0.0],
    [4.0,  -6.0,  4.0,  -1.0,  0.0,   0.0, 0.0],
    [5.0, -10.0, 10.0,  -5.0,  1.0,   0.0, 0.0],
    [6.0, -15.0, 20.0, -15.0,  6.0,  -1.0, 0.0],
    [7.0, -21.0, 35.0, -35.0, 21.0,  -7.0, 1.0],
];

/// A ring of the last increments.
#[derive(Debug)]
pub(crate) struct History<S: System, T: Real> {
    pub(crate) ring: [Vector<S, T>; DEPTH],
    len: usize,
    /// Where the next increment goes: the place of the oldest once the ring is full.
    pub(crate) next: usize,
    /// The first guess.
    seed: Vector<S, T>,
}

impl<S: System, T: Real> History<S, T> {
    /// No increments yet; the first guess is `seed`, or zero.
    pub(crate) fn new(system: &S, seed: Option<Vector<S, T>>) -> Self {
        let space = system.space();
        Self { ring: space.vectors(), len: 0, next: 0, seed: seed.unwrap_or_else(|| space.vector()) }
    }

    /// Where the next increment goes, if as many are kept as can be.
    pub(crate) fn place_if_full(&self) -> Option<usize> {
        (self.len == DEPTH).then_some(self.next)
    }

    /// Sets `guess` to the extrapolated increment.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn extrapolate(&self, guess: &mut [T]) {
        // The full sum has a known length and makes straight code.
        match self.len {
            DEPTH => extrapolate(&self.ring, self.next, guess),
            0 => guess.copy_from_slice(&self.seed),
            len => combine(&self.ring, &OF_PLACES[len][self.next], guess),
        }
    }

    #[cfg(feature = "alloc")]
    fn is_sound(&self) -> bool {
        self.len <= DEPTH && self.next < DEPTH
    }

    /// Forgets all increments; the next guess is `seed`.
    pub(crate) fn begin_again(&mut self, seed: &[T]) {
        self.clear();
        self.seed.copy_from_slice(seed);
    }

    /// Forgets all increments, but not the seed.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    /// Remembers the increment of a completed step.
    #[inline]
    pub(crate) fn push(&mut self, increment: &[T]) {
        self.ring[self.next].copy_from_slice(increment);
        self.advance();
    }

    /// The same, times `factor`.
    #[inline]
    pub(crate) fn push_scaled(&mut self, increment: &[T], factor: T) {
        for (kept, &x) in self.ring[self.next].iter_mut().zip(increment) {
            *kept = x * factor;
        }
        self.advance();
    }

    #[inline]
    fn advance(&mut self) {
        self.next = if self.next + 1 < DEPTH { self.next + 1 } else { 0 };
        if self.len < DEPTH {
            self.len += 1;
        }
    }
}

/// Sets `guess` to the extrapolation of a full ring, of which the oldest increment is in place `at`.
#[inline]
pub(crate) fn extrapolate<P: Scalar>(ring: &[impl Deref<Target = [P]>; DEPTH], at: usize, guess: &mut [P]) {
    combine(ring, &OF_PLACES[DEPTH][at], guess);
}

/// Row m, by where the next increment goes: the coefficients of the places of the ring.
const OF_PLACES: [[[f64; DEPTH]; DEPTH]; DEPTH + 1] = {
    let mut of_places = [[[0.0; DEPTH]; DEPTH]; DEPTH + 1];
    let mut all = 0;
    while all < (DEPTH + 1) * DEPTH * DEPTH {
        let (len, next, age) = (all / DEPTH / DEPTH, all / DEPTH % DEPTH, all % DEPTH);
        of_places[len][next][(next + DEPTH - 1 - age) % DEPTH] = COEFFICIENTS[len][age];
        all += 1;
    }
    of_places
};

/// Coefficients that go around the ring, and not the ring: its places are then known when compiled, which
/// takes 40 instructions less from a step of four vortices
/// (`cargo bench -p dvi-kernels --bench instructions`).
#[cfg_attr(not(debug_assertions), inline(always))]
fn combine<P: Scalar>(ring: &[impl Deref<Target = [P]>; DEPTH], factors: &[f64; DEPTH], guess: &mut [P]) {
    let rows = ring.each_ref().map(|s| &s[..guess.len()]);
    for (k, guess) in guess.iter_mut().enumerate() {
        lanes_stay_together::<P>();
        let terms = rows.iter().zip(factors).map(|(s, &factor)| P::lift(factor) * s[k]);
        // −0 is neutral for every number.
        *guess = terms.fold(P::lift(-0.0), |sum, term| sum + term);
    }
}

lasting!([S: System, T: Real] History<S, T>, T;
    vectors ring, count len, count next, numbers seed; is_sound);

#[cfg(test)]
mod tests {
    use super::{COEFFICIENTS, DEPTH, OF_PLACES, combine};

    #[test]
    fn row_m_continues_polynomials_below_degree_m_and_no_others() {
        for m in 1..=DEPTH {
            for degree in 0..=m as i32 {
                let value: f64 =
                    (0..DEPTH).map(|i| COEFFICIENTS[m][i] * (-1.0 - i as f64).powi(degree)).sum();
                let exact = if degree == 0 { 1.0 } else { 0.0 };
                assert_eq!(value == exact, degree < m as i32, "row {m}, degree {degree}");
            }
        }
    }

    /// The k-th last increment is 2ᵏ: no two sums of such coefficients are the same.
    #[test]
    fn the_newest_stands_before_the_place_of_the_next() {
        for (len, coefficients) in COEFFICIENTS.iter().enumerate() {
            for next in 0..DEPTH {
                let age = |place: usize| (next + 2 * DEPTH - 1 - place) % DEPTH;
                let ring: [_; DEPTH] =
                    core::array::from_fn(|place| [f64::powi(2.0, age(place) as i32)].to_vec());
                let mut guess = [f64::NAN];
                combine(&ring, &OF_PLACES[len][next], &mut guess);
                let expected: f64 = (0..len).map(|age| coefficients[age] * f64::powi(2.0, age as i32)).sum();
                assert_eq!(guess, [expected], "{len} increments, the next at {next}");
            }
        }
    }
}
