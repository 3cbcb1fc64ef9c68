//! Numbers that carry first and second derivatives along fixed directions, and the sizes of the terms
//! that each of these was added up from.
//!
//! A jet is the value of a function of (q, v, t), its derivatives along four first directions and two
//! second ones, and the mixed second derivatives that a check needs. The derivatives along a random
//! direction speak for all entries of a gradient at once, so the cost does not grow with their number.
//!
//! A jet may have a *rate*: its derivative along one more direction, which is a jet itself. A gauge enters L
//! as dF/dt, the rate of F where positions move with their velocities and the time with 1.

/// First directions: q along a, v along a, t, and v along itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum First {
    Q,
    V,
    T,
    Stretch,
}

/// Second directions: q along b, v along b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Second {
    Q,
    V,
}

const FIRST: usize = 4;
const SECOND: usize = 2;
/// The first directions that have mixed derivatives: q, v and t.
const MIXED: usize = 3;
const PARTS: usize = 1 + FIRST + SECOND + MIXED * SECOND;

/// The cube of such a number is near to overflow.
const HUGE: f64 = 1e100;

/// A number this much smaller than the terms that it was added up from is not known.
pub(super) const NOISE: f64 = 1e-10;

/// A number and the sum of the absolute terms behind it, in units of which its rounding error is some small
/// multiple of the machine precision.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sized {
    pub(super) value: f64,
    pub(super) size: f64,
}

impl Sized {
    pub(super) fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, size: self.size + other.size }
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, size: self.size * factor.abs() }
    }

    /// Whether another order of operations leaves the two in their order: they differ by more than rounding,
    /// or are equal without any.
    pub(super) fn is_distinct_from(self, other: Self) -> bool {
        let difference = (self.value - other.value).abs();
        let is_plain = |x: Self| x.size <= x.value.abs();
        difference > NOISE * (self.size + other.size)
            || (difference == 0.0 && is_plain(self) && is_plain(other))
    }
}

/// Kept on the heap: formulas nest deeply, and so does their evaluation.
#[derive(Clone, Debug)]
pub(super) struct Jet(Box<Parts>);

#[derive(Clone, Debug)]
struct Parts {
    value: [f64; PARTS],
    size: [f64; PARTS],
    /// A sum without terms, or a multiple of one.
    is_empty_sum: bool,
    /// Whether there is a sum without terms in it: if it is zero, its sign is that of no sum as written.
    holds_empty_sum: bool,
    /// Whether there is a variable in it, be its derivatives zero or not: erf(30) is 1 to all digits.
    holds_variable: bool,
    rate: Option<Jet>,
}

/// The value and the first four derivatives of a function of one number.
pub(super) type Taylor = [f64; 5];

fn mixed(first: usize, second: usize) -> usize {
    1 + FIRST + SECOND + first * SECOND + second
}

impl Jet {
    pub(super) fn number(value: f64) -> Self {
        let mut parts = Parts {
            value: [0.0; PARTS],
            size: [0.0; PARTS],
            is_empty_sum: false,
            holds_empty_sum: false,
            holds_variable: false,
            rate: None,
        };
        parts.value[0] = value;
        parts.size[0] = value.abs();
        Self(Box::new(parts))
    }

    /// The sum of no terms, which is −0 in Rust: a function of it is a constant, even where that function
    /// has no derivative.
    pub(super) fn empty_sum() -> Self {
        let mut jet = Self::number(-0.0);
        jet.0.is_empty_sum = true;
        jet.0.holds_empty_sum = true;
        jet
    }

    /// A variable with its rates along the directions.
    pub(super) fn variable(value: f64, first: [f64; FIRST], second: [f64; SECOND]) -> Self {
        let mut jet = Self::number(value);
        jet.0.holds_variable = true;
        jet.0.value[1..=FIRST].copy_from_slice(&first);
        jet.0.value[1 + FIRST..1 + FIRST + SECOND].copy_from_slice(&second);
        jet.0.size = jet.0.value.map(f64::abs);
        jet
    }

    /// The same with this rate.
    pub(super) fn moving(mut self, rate: Self) -> Self {
        self.0.rate = Some(rate);
        self
    }

    /// Its rate; that of a constant is zero.
    pub(super) fn rate(&self) -> Self {
        // What is not known has no rate that is.
        let constant = || Self::number(if self.0.value[0].is_nan() { f64::NAN } else { 0.0 });
        self.0.rate.clone().unwrap_or_else(constant)
    }

    fn part(&self, at: usize) -> Sized {
        Sized { value: self.0.value[at], size: self.0.size[at] }
    }

    pub(super) fn value(&self) -> Sized {
        self.part(0)
    }

    pub(super) fn first(&self, direction: First) -> Sized {
        self.part(1 + direction as usize)
    }

    pub(super) fn second(&self, direction: Second) -> Sized {
        self.part(1 + FIRST + direction as usize)
    }

    /// The mixed derivative; none is kept along [`First::Stretch`].
    pub(super) fn both(&self, first: First, second: Second) -> Sized {
        self.part(mixed(first as usize, second as usize))
    }

    /// The derivatives along the first and the second direction of velocities, the first with what its own
    /// along the second directions are.
    pub(super) fn slopes(&self) -> [Self; 2] {
        // What is not known has no slopes that are.
        if self.0.value[0].is_nan() {
            return [Self::number(f64::NAN), Self::number(f64::NAN)];
        }
        let [mut slope, mut other] = [Self::number(0.0), Self::number(0.0)];
        let mut set =
            |at: usize, part: Sized| (slope.0.value[at], slope.0.size[at]) = (part.value, part.size);
        set(0, self.first(First::V));
        for second in [Second::Q, Second::V] {
            set(1 + FIRST + second as usize, self.both(First::V, second));
        }
        let along_second = self.second(Second::V);
        (other.0.value[0], other.0.size[0]) = (along_second.value, along_second.size);
        [slope, other]
    }

    /// Whether it is a zero whose sign is not defined.
    pub(super) fn is_zero_without_sign(&self) -> bool {
        self.0.holds_empty_sum && self.0.value[0] == 0.0
    }

    /// Whether it is made of variables.
    pub(super) fn holds_variable(&self) -> bool {
        self.0.holds_variable
    }

    /// The same derivatives around another value.
    pub(super) fn with_value(mut self, value: f64) -> Self {
        // What is not known stays so.
        if self.0.value[0].is_nan() {
            return self;
        }
        self.0.value[0] = value;
        self.0.size[0] = self.0.size[0].max(value.abs());
        self
    }

    /// Whether all parts are finite, and far from overflow.
    pub(super) fn is_moderate(&self) -> bool {
        self.0.size.iter().chain(&self.0.value).all(|part| part.abs() < HUGE)
            && self.0.rate.as_ref().is_none_or(Self::is_moderate)
    }

    /// Whether a number of another order of operations may overflow.
    pub(super) fn is_huge(&self) -> bool {
        self.0.value.iter().any(|part| part.abs() >= HUGE) || self.0.rate.as_ref().is_some_and(Self::is_huge)
    }

    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.0.value.iter_mut().for_each(|value| *value *= factor);
        self.0.size.iter_mut().for_each(|size| *size *= factor.abs());
        self.0.rate = self.0.rate.take().map(|rate| rate.scaled(factor));
        self
    }

    pub(super) fn plus(mut self, other: &Self) -> Self {
        for k in 0..PARTS {
            self.0.value[k] += other.0.value[k];
            self.0.size[k] += other.0.size[k];
        }
        self.0.is_empty_sum &= other.0.is_empty_sum;
        self.0.holds_empty_sum |= other.0.holds_empty_sum;
        self.0.holds_variable |= other.0.holds_variable;
        self.0.rate = match (self.0.rate.take(), &other.0.rate) {
            (Some(one), Some(two)) => Some(one.plus(two)),
            (one, two) => one.or_else(|| two.clone()),
        };
        self
    }

    pub(super) fn minus(self, other: Self) -> Self {
        self.plus(&other.scaled(-1.0))
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = self.times_at_rest(other);
        let one = self.0.rate.as_ref().map(|rate| rate.times_at_rest(other));
        let two = other.0.rate.as_ref().map(|rate| self.times_at_rest(rate));
        product.0.rate = match (one, two) {
            (Some(one), Some(two)) => Some(one.plus(&two)),
            (one, two) => one.or(two),
        };
        product
    }

    /// The product without its rate.
    fn times_at_rest(&self, other: &Self) -> Self {
        // The sign of a zero counts: `signum` sees it.
        let mut product = Self::number(-0.0);
        product.0.holds_empty_sum = self.0.holds_empty_sum || other.0.holds_empty_sum;
        product.0.holds_variable = self.0.holds_variable || other.0.holds_variable;
        let mut add = |to: usize, i: usize, j: usize| {
            let ((x, a), (y, b)) = ((self.0.value[i], self.0.size[i]), (other.0.value[j], other.0.size[j]));
            product.0.value[to] += x * y;
            product.0.size[to] += x.abs() * b + a * y.abs() - (x * y).abs();
        };
        add(0, 0, 0);
        for k in 1..=FIRST + SECOND {
            add(k, k, 0);
            add(k, 0, k);
        }
        for both in 1 + FIRST + SECOND..PARTS {
            add(both, both, 0);
            add(both, 0, both);
        }
        let [x, y] = [&self.0, &other.0];
        for first in 0..MIXED {
            for second in 0..SECOND {
                let (both, e, f) = (mixed(first, second), 1 + first, 1 + FIRST + second);
                product.0.value[both] += x.value[e] * y.value[f] + x.value[f] * y.value[e];
                // Derivatives that are zero as a whole have entries that are not, and these are multiplied
                // one by one.
                product.0.size[both] += x.size[e] * y.size[f] + x.size[f] * y.size[e];
            }
        }
        product
    }

    /// f(self) from the derivatives of f at its value.
    pub(super) fn through(&self, f: Taylor) -> Self {
        let [value, d1, d2, d3, d4] = f;
        let mut result = self.through_at_rest([value, d1, d2, d3]);
        if let (Some(rate), false) = (&self.0.rate, self.0.is_empty_sum) {
            result.0.rate = Some(self.through_at_rest([d1, d2, d3, d4]).times_at_rest(rate));
        }
        result
    }

    /// The same without its rate, which needs one derivative less.
    fn through_at_rest(&self, f: [f64; 4]) -> Self {
        let [value, d1, d2, d3] = f;
        let mut result = Self::number(value);
        result.0.holds_empty_sum = self.0.holds_empty_sum;
        if self.0.is_empty_sum {
            return result;
        }
        result.0.holds_variable = self.0.holds_variable;
        let (x, u) = (self.0.value[0], self.0.size[0]);
        // The largest that the derivatives can be where the argument may be, as far as it is known.
        let known_to = 64.0 * f64::EPSILON * u;
        let [s0, s1, s2, s3] = f.map(f64::abs);
        let size = [s0 + known_to * s1, s1 + known_to * s2, s2 + known_to * s3, s3];
        if x.abs() < NOISE * u && size[2] * x.abs() > 0.1 * size[1] {
            // Near a singularity, and nothing but rounding: another order of operations gives another
            // number.
            return Self::number(f64::NAN);
        }
        result.0.size[0] = size[0] + size[1] * u;
        for k in 1..=FIRST + SECOND {
            result.0.value[k] = d1 * self.0.value[k];
            result.0.size[k] = size[1] * self.0.size[k] + size[2] * u * self.0.value[k].abs();
        }
        for first in 0..MIXED {
            for second in 0..SECOND {
                let (both, e, f) = (mixed(first, second), 1 + first, 1 + FIRST + second);
                let (x, y, xy) = (self.0.value[e], self.0.value[f], self.0.value[both]);
                result.0.value[both] = d1 * xy + d2 * x * y;
                result.0.size[both] = size[1] * self.0.size[both]
                    + size[2] * (self.0.size[e] * self.0.size[f] + u * xy.abs())
                    + d3.abs() * u * (x * y).abs();
            }
        }
        result
    }

    /// 1/self
    pub(super) fn reciprocal(&self) -> Self {
        let inverse = 1.0 / self.0.value[0];
        let square = inverse * inverse;
        let cube = square * inverse;
        self.through([inverse, -square, 2.0 * cube, -6.0 * square * square, 24.0 * square * cube])
    }

    /// self to an integer power.
    pub(super) fn power(&self, exponent: i32) -> Self {
        let n = f64::from(exponent);
        let x = self.0.value[0];
        // A factor of zero counts, even before an infinite power.
        let term = |factor: f64, exponent: i32| if factor == 0.0 { 0.0 } else { factor * x.powi(exponent) };
        self.through([
            x.powi(exponent),
            term(n, exponent - 1),
            term(n * (n - 1.0), exponent - 2),
            term(n * (n - 1.0) * (n - 2.0), exponent - 3),
            term(n * (n - 1.0) * (n - 2.0) * (n - 3.0), exponent - 4),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::Jet;

    /// Else a force from a dissipation function would seem to be zero where R is lost in rounding.
    #[test]
    fn what_is_not_known_has_no_derivatives_that_are() {
        let unknown = Jet::number(f64::NAN);
        let [one, other] = unknown.slopes();
        assert!([one, other, unknown.rate()].iter().all(|jet| jet.value().value.is_nan()));
    }
}
