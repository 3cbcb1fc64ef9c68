//! Where a function of one variable crosses zero on the way from one place to another: whether it dips below
//! zero in between, by its values and slopes at both ends, and the zero between two places on both sides.

use crate::{Real, Scalar};

/// A place, with the value and the slope of a function there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample<T> {
    pub(crate) place: T,
    pub(crate) value: T,
    pub(crate) slope: T,
}

/// Samples to find the least value of a function that may dip below zero.
const SOUGHT: usize = 60;
/// Iterations for a zero.
pub(crate) const ITERATIONS: usize = 200;
/// The part of a place below which rounding is absolute.
const SMALL: f64 = 1e-30;
/// Places that are farther apart have a slope between them that is none of rounding errors.
pub(crate) const APART: f64 = 1e-5;

/// A place between `from` and `to` at which a function is negative that is not at these ends: near the least
/// value in between, by a cubic through values and slopes. `None` if there is no reason to look, or none is
/// found. Of a convex function none is overlooked; of another that turns in between, the first `sure` looks
/// go to its turn whatever the cubic says of the value there.
pub(crate) fn dip<T: Real, E>(
    [mut from, mut to]: [Sample<T>; 2],
    sure: usize,
    look: &mut dyn FnMut(T) -> Result<Sample<T>, E>,
) -> Result<Option<T>, E> {
    for iteration in 0..SOUGHT {
        let length = to.place - from.place;
        let slopes = [from.slope * length, to.slope * length];
        let cubic = Cubic::through([from.value, to.value], slopes);
        let turns = from.slope < T::lift(0.0) && to.slope > T::lift(0.0);
        if !(cubic.may_close() || (turns && iteration < sure)) {
            break;
        }
        // The first is near where the function is smooth, the second is at the tip of a kink.
        let mut guesses = [cubic.minimum(), cubic.tangents_meet()];
        guesses.rotate_left(iteration % 2);
        let Some(low) = guesses[0].or(guesses[1]) else { break };
        let low = from.place + low * length;
        if low <= from.place || low >= to.place {
            break;
        }
        let at_low = look(low)?;
        if at_low.value < T::lift(0.0) {
            return Ok(Some(low));
        }
        *(if at_low.slope < T::lift(0.0) { &mut from } else { &mut to }) = at_low;
    }
    Ok(None)
}

/// A zero of a function, or a place on one side of it, and its slope there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zero<T> {
    pub(crate) place: T,
    pub(crate) slope: T,
    /// The nearest place that is known on the other side.
    pub(crate) across: T,
}

/// The zero of a function between two places, given with its values there, one of which is negative and one
/// is not: by regula falsi with the damping of Anderson & Björck (1973), and by bisection where that is
/// slow. The place is the last one that `look` was asked for, or `b`.
pub(crate) fn zero<T: Real, E>(
    [mut a, mut b]: [[T; 2]; 2],
    look: &mut dyn FnMut(T) -> Result<T, E>,
) -> Result<Zero<T>, E> {
    let [zero, half, one] = [0.0, 0.5, 1.0].map(T::lift);
    let mut slope = (b[1] - a[1]) / (b[0] - a[0]);
    for iteration in 0..ITERATIONS {
        let width = Scalar::abs(b[0] - a[0]);
        if b[1] == zero || width <= T::default_epsilon() * (Scalar::abs(b[0]) + T::lift(SMALL)) {
            break;
        }
        let secant = b[0] - b[1] * (b[0] - a[0]) / (b[1] - a[1]);
        let is_inside = (secant > a[0] && secant < b[0]) || (secant > b[0] && secant < a[0]);
        let is_slow = iteration % 8 == 7;
        let place = if is_inside && !is_slow { secant } else { half * (a[0] + b[0]) };
        let change = Scalar::abs(place - b[0]);
        if place == a[0] || change <= T::default_epsilon() * Scalar::abs(b[0]) {
            break;
        }
        let value = look(place)?;
        if change > T::lift(APART) {
            slope = (value - b[1]) / (place - b[0]);
        }
        if (value < zero) == (b[1] < zero) {
            // b is nearer, and what stands for the value at a is a weight.
            let damping = one - value / b[1];
            a[1] *= if damping > zero { damping } else { half };
        } else {
            a = b;
        }
        b = [place, value];
    }
    Ok(Zero { place: b[0], slope, across: a[0] })
}

/// The cubic polynomial on [0, 1] with given values and slopes at both ends, a + bτ + cτ² + dτ³.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cubic<T> {
    coefficients: [T; 4],
}

impl<T: Real> Cubic<T> {
    pub(crate) fn through([a, end]: [T; 2], [b, slope]: [T; 2]) -> Self {
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

    /// Whether there is reason to look for a place in the interior at which a function with these values and
    /// slopes is negative.
    pub(crate) fn may_close(&self) -> bool {
        self.minimum().is_some_and(|low| self.value(low) < T::lift(0.0)) || self.tangents_meet().is_some()
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
    pub(crate) fn closes_before(&self, low: T) -> T {
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
