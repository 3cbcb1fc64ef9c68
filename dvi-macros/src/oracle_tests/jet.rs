//! Jets of second order: a value with its gradient and Hessian over all of (q, v, t).
//!
//! Each component comes with its size: a bound on the sum of the absolute values of the terms that it
//! was added up from, to first order in the rounding errors. What another order of operations may
//! change is a small multiple of the rounding unit times that size.

use super::compare::TOLERANCE;
use super::functions::{BinaryFunction, Derivatives};

/// The size that stands for 64 roundings of a term of size 1: what may be left where such terms cancel.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON / TOLERANCE;

/// A number with the size of its terms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sized {
    pub(super) value: f64,
    pub(super) size: f64,
}

impl Sized {
    pub(super) fn new(value: f64) -> Self {
        Self { value, size: value.abs() }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, size: self.size + other.size }
    }

    pub(super) fn times(self, other: Self) -> Self {
        let value = self.value * other.value;
        Self { value, size: self.value.abs() * other.size + self.size * other.value.abs() }
    }

    /// The product of two sums that may be added up term by term: where one cancels as a whole, the products
    /// of its terms leave their rounding errors.
    fn times_each(self, other: Self) -> Self {
        let product = self.times(other);
        Self { size: product.size + ROUNDING * self.size * other.size, ..product }
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, size: factor.abs() * self.size }
    }
}

/// Entries of variables that are not `active` are zero.
#[derive(Clone, Debug)]
pub(super) struct Jet {
    pub(super) value: Sized,
    active: Vec<usize>,
    variables: usize,
    gradient: Vec<Sized>,
    hessian: Vec<Sized>,
}

impl Jet {
    pub(super) fn constant(value: f64) -> Self {
        Self {
            value: Sized::new(value),
            active: Vec::new(),
            variables: 0,
            gradient: Vec::new(),
            hessian: Vec::new(),
        }
    }

    pub(super) fn variable(value: f64, number: usize, variables: usize) -> Self {
        let mut gradient = vec![Sized::default(); variables];
        gradient[number] = Sized::new(1.0);
        let hessian = vec![Sized::default(); variables * variables];
        Self { value: Sized::new(value), active: vec![number], variables, gradient, hessian }
    }

    /// From all of its derivatives.
    pub(super) fn from_derivatives(
        value: Sized,
        variables: usize,
        first: impl Fn(usize) -> Sized,
        second: impl Fn(usize, usize) -> Sized,
    ) -> Self {
        let all = Self { active: (0..variables).collect(), variables, ..Self::constant(0.0) };
        Self::from_parts(value, (&all, &all), first, second)
    }

    pub(super) fn gradient(&self, i: usize) -> Sized {
        self.gradient.get(i).copied().unwrap_or_default()
    }

    pub(super) fn hessian(&self, i: usize, j: usize) -> Sized {
        self.hessian.get(i * self.variables + j).copied().unwrap_or_default()
    }

    /// Whether it is a sum without terms, or of zeros alone.
    pub(super) fn is_nothing(&self) -> bool {
        self.active.is_empty() && self.value.size == 0.0
    }

    pub(super) fn is_moderate(&self) -> bool {
        let moderate = |entry: &Sized| entry.value.is_finite() && entry.size < 1e7;
        moderate(&self.value) && self.gradient.iter().chain(&self.hessian).all(moderate)
    }

    /// From the entries of its derivatives, over the variables that either of two jets depends on.
    fn from_parts(
        value: Sized,
        (a, b): (&Self, &Self),
        first: impl Fn(usize) -> Sized,
        second: impl Fn(usize, usize) -> Sized,
    ) -> Self {
        let variables = a.variables.max(b.variables);
        let mut active = a.active.clone();
        active.extend(b.active.iter().filter(|variable| !a.active.contains(variable)));
        let mut gradient = vec![Sized::default(); variables];
        let mut hessian = vec![Sized::default(); variables * variables];
        for &i in &active {
            gradient[i] = first(i);
            for &j in &active {
                hessian[i * variables + j] = second(i, j);
            }
        }
        Self { value, active, variables, gradient, hessian }
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        let mut jet = self.clone();
        jet.value = jet.value.scaled(factor);
        jet.gradient.iter_mut().chain(&mut jet.hessian).for_each(|entry| *entry = entry.scaled(factor));
        jet
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self::from_parts(
            self.value.plus(other.value),
            (self, other),
            |i| self.gradient(i).plus(other.gradient(i)),
            |i, j| self.hessian(i, j).plus(other.hessian(i, j)),
        )
    }

    /// f(a, b) from its value and derivatives ∂a, ∂b, ∂a∂a, ∂a∂b, ∂b∂b with their sizes.
    fn composed(a: &Self, b: &Self, f: Sized, [fa, fb, faa, fab, fbb]: [Sized; 5]) -> Self {
        Self::from_parts(
            f,
            (a, b),
            |i| fa.times(a.gradient(i)).plus(fb.times(b.gradient(i))),
            |i, j| {
                let (ai, aj, bi, bj) = (a.gradient(i), a.gradient(j), b.gradient(i), b.gradient(j));
                let squares = faa.times(ai.times_each(aj)).plus(fbb.times(bi.times_each(bj)));
                let mixed = fab.times(ai.times_each(bj).plus(bi.times_each(aj)));
                let linear = fa.times(a.hessian(i, j)).plus(fb.times(b.hessian(i, j)));
                squares.plus(mixed).plus(linear)
            },
        )
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let (zero, one) = (Sized::default(), Sized::new(1.0));
        let value = self.value.times(other.value);
        Self::composed(self, other, value, [other.value, self.value, zero, one, zero])
    }

    /// f(u) from a function that gives f, f′ and f″. An error of u moves each of them by the next one; f‴,
    /// which is asked for nothing else, is a difference quotient.
    pub(super) fn unary(&self, at: &dyn Fn(f64) -> Derivatives) -> Self {
        const H: f64 = 1e-4;
        let (x, error) = (self.value.value, self.value.size);
        let [f, first, second] = at(x);
        let third = (at(x + H)[2] - at(x - H)[2]) / (2.0 * H);
        let sized = |value: f64, next: f64| Sized { value, size: value.abs() + next.abs() * error };
        let zero = Sized::default();
        let derivatives = [sized(first, second), zero, sized(second, third), zero, zero];
        Self::composed(self, &Self::constant(0.0), sized(f, first), derivatives)
    }

    pub(super) fn power(&self, exponent: i32) -> Self {
        let (x, n) = (self.value.value, f64::from(exponent));
        let derivative = |order: i32, factor: f64| {
            if factor == 0.0 { 0.0 } else { factor * x.powi(exponent - order) }
        };
        let sized =
            |value: f64, next: f64| Sized { value, size: value.abs() + next.abs() * self.value.size };
        let (f, f1) = (x.powi(exponent), derivative(1, n));
        let (f2, f3) = (derivative(2, n * (n - 1.0)), derivative(3, n * (n - 1.0) * (n - 2.0)));
        let zero = Sized::default();
        let derivatives = [sized(f1, f2), zero, sized(f2, f3), zero, zero];
        Self::composed(self, &Self::constant(0.0), sized(f, f1), derivatives)
    }

    /// A function of two arguments, or `None` too near to where it has no derivatives.
    pub(super) fn binary(&self, function: BinaryFunction, other: &Self) -> Option<Self> {
        let (a, b) = (self.value.value, other.value.value);
        let r2 = a * a + b * b;
        let (f, derivatives, distance) = match function {
            BinaryFunction::Atan2 => {
                let r4 = r2 * r2;
                let derivatives =
                    [b / r2, -a / r2, -2.0 * a * b / r4, (a * a - b * b) / r4, 2.0 * a * b / r4];
                // The angle jumps at the negative axis.
                let distance = if b < 0.0 { a.abs() } else { r2.sqrt() };
                (a.atan2(b), derivatives, distance)
            }
            BinaryFunction::Hypot => {
                let r = r2.sqrt();
                let r3 = r * r2;
                (r, [a / r, b / r, b * b / r3, -a * b / r3, a * a / r3], r)
            }
            BinaryFunction::Min | BinaryFunction::Max => {
                // The smaller one, or the larger one, with all its derivatives; not near to where they meet.
                let takes_self = (a < b) == (function == BinaryFunction::Min);
                let far = (a - b).abs() > 1e-2;
                return far.then(|| if takes_self { self.clone() } else { other.clone() });
            }
            BinaryFunction::Powf => {
                // Whole exponents that are constant here have negative bases too.
                let is_whole = other.active.is_empty() && b.fract() == 0.0;
                let (ln, distance) = if is_whole { (0.0, a.abs()) } else { (a.ln(), a) };
                let f = a.powf(b);
                let fa = b * a.powf(b - 1.0);
                let fab = a.powf(b - 1.0) * (1.0 + b * ln);
                (f, [fa, f * ln, b * (b - 1.0) * a.powf(b - 2.0), fab, f * ln * ln], distance)
            }
        };
        if distance < 1e-2 || r2 > 1e6 {
            return None;
        }
        // All of these are rational in a, b and 1/distance, or powers.
        let error = self.value.size + other.value.size;
        let reach = (1.0 + error / distance) * (1.0 + a.abs() + b.abs()) * (1.0 + 1.0 / distance).powi(2);
        let scale = f.abs() + derivatives.iter().fold(0.0, |sum: f64, derivative| sum + derivative.abs());
        let sized = |value: f64| Sized { value, size: value.abs() + scale * reach };
        Some(Self::composed(self, other, sized(f), derivatives.map(sized)))
    }
}
