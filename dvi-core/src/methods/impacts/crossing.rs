//! Where a gap may close: the cubic through the gaps and their rates at both ends of a flight, and the
//! tangents there.

use crate::{Real, Scalar};

/// The cubic polynomial on [0, 1] with given values and slopes at both ends, a + bτ + cτ² + dτ³.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic<T> {
    coefficients: [T; 4],
}

impl<T: Real> Cubic<T> {
    pub(super) fn through([a, end]: [T; 2], [b, slope]: [T; 2]) -> Self {
        let (two, three) = (T::lift(2.0), T::lift(3.0));
        let c = three * (end - a) - two * b - slope;
        let d = two * (a - end) + b + slope;
        Self { coefficients: [a, b, c, d] }
    }

    fn value(&self, x: T) -> T {
        let [a, b, c, d] = self.coefficients;
        a + x * (b + x * (c + x * d))
    }

    /// Where in the interior the polynomial has a minimum, if it has one.
    fn minimum(&self) -> Option<T> {
        let [_, b, c, d] = self.coefficients;
        let (zero, three) = (T::lift(0.0), T::lift(3.0));
        // b + 2cτ + 3dτ² = 0, where the second derivative, 2c + 6dτ, is positive: its root with a plus
        // before the square root.
        let discriminant = c * c - three * b * d;
        if discriminant <= zero {
            return None;
        }
        let root = Scalar::sqrt(discriminant);
        let x = if c > zero { -b / (c + root) } else { (root - c) / (three * d) };
        (x > zero && x < T::lift(1.0)).then_some(x)
    }

    /// A place in the interior at which a function with these values and slopes may be negative, if there is
    /// reason to look.
    pub(super) fn may_close(&self) -> Option<T> {
        let below = self.minimum().filter(|&low| self.value(low) < T::lift(0.0));
        below.or_else(|| self.tangents_meet())
    }

    /// Where the tangents at both ends meet, if the polynomial falls at the beginning, rises at the end, and
    /// they meet below zero. A convex function with these values and slopes is nowhere lower.
    fn tangents_meet(&self) -> Option<T> {
        let [a, b, c, d] = self.coefficients;
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let slope = b + T::lift(2.0) * c + T::lift(3.0) * d;
        if b >= zero || slope <= zero {
            return None;
        }
        // a + bx = end + slope (x − 1)
        let x = (self.value(one) - slope - a) / (b - slope);
        (a + b * x < zero && x > zero && x < one).then_some(x)
    }

    /// About where the polynomial becomes negative for the first time behind 0, if its value at 1, or at the
    /// interior point `low`, is.
    pub(super) fn closes_before(&self, low: T) -> T {
        let zero = T::lift(0.0);
        let [a, b, c, _] = self.coefficients;
        let mut high = low;
        if a <= zero && c < zero {
            // Of a hop that is short the parabola at its beginning says when it ends.
            let hop = -b / c;
            if hop > zero && hop < high && self.value(hop) <= zero {
                high = hop;
            }
        }
        let mut x = zero;
        for _ in 0..HALVINGS {
            let middle = T::lift(0.5) * (x + high);
            if self.value(middle) > zero {
                x = middle;
            } else {
                high = middle;
            }
        }
        T::lift(0.5) * (x + high)
    }
}

/// Halvings of the interval in which a polynomial is known to close: what is found is a guess.
const HALVINGS: usize = 20;

#[cfg(test)]
mod tests {
    use super::Cubic;

    /// (τ − ¼)(τ − ¾) + depth, with its slopes.
    fn bowl(depth: f64) -> Cubic<f64> {
        let ends = 3.0 / 16.0 + depth;
        Cubic::through([ends, ends], [-1.0, 1.0])
    }

    #[test]
    fn a_bowl_has_its_minimum_in_the_middle() {
        let Some(minimum) = bowl(0.0).minimum() else { panic!("a bowl has a minimum") };
        assert!((minimum - 0.5).abs() < 1e-15, "{minimum}");
        assert!((bowl(0.0).value(minimum) + 1.0 / 16.0).abs() < 1e-15);
    }

    #[test]
    fn a_bowl_closes_at_its_first_zero() {
        let first = bowl(0.0).closes_before(0.5);
        assert!((first - 0.25).abs() < 1e-5, "{first}");
    }

    /// |τ − 0.6| − 0.1
    #[test]
    fn the_tangents_of_a_cone_meet_at_its_tip() {
        let cone = Cubic::through([0.5, 0.3], [-1.0, 1.0]);
        assert!(cone.minimum().is_some_and(|low| cone.value(low) > 0.0));
        assert!(cone.tangents_meet().is_some_and(|tip: f64| (tip - 0.6).abs() < 1e-15));
        assert_eq!(Cubic::through([0.7, 0.5], [-1.0, 1.0]).tangents_meet(), None);
    }

    #[test]
    fn a_line_has_no_minimum() {
        assert_eq!(Cubic::through([1.0, 0.0], [-1.0, -1.0]).minimum(), None);
        assert_eq!(Cubic::through([0.0, 1.0], [1.0, 1.0]).minimum(), None);
    }

    #[test]
    fn a_hop_ends_where_its_parabola_does() {
        // τ (0.01 − τ)
        let hop = Cubic::through([0.0_f64, -0.99], [0.01, -1.99]);
        let end: f64 = hop.closes_before(1.0);
        assert!((end - 0.01).abs() < 1e-6, "{end}");
    }
}
