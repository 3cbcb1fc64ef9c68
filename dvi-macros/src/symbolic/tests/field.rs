//! Numbers for the oracle: with a bound of their rounding error, and with a derivative.

use core::f64::consts::{FRAC_2_SQRT_PI, LN_2, LN_10};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::symbolic::Unary;

pub(super) trait Field:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn lift(value: f64) -> Self;
    fn unary(function: Unary, of: Self) -> Self;
    /// Whether a < b; nothing if they are too close to say.
    fn ordered(a: Self, b: Self) -> Option<bool>;
}

/// Closed forms of the derivatives, written without the value of the function.
#[rustfmt::skip]
fn slope<F: Field>(function: Unary, u: F) -> F {
    let (one, call) = (F::lift(1.0), F::unary);
    match function {
        Unary::Sqrt   => one / (call(Unary::Sqrt, u) * F::lift(2.0)),
        Unary::Cbrt   => call(Unary::Cbrt, u) / (u * F::lift(3.0)),
        Unary::Exp    => call(Unary::Exp, u),
        Unary::Exp2   => call(Unary::Exp2, u) * F::lift(LN_2),
        Unary::ExpM1  => call(Unary::Exp, u),
        Unary::Ln     => one / u,
        Unary::Ln1p   => one / (one + u),
        Unary::Log2   => one / (u * F::lift(LN_2)),
        Unary::Log10  => one / (u * F::lift(LN_10)),
        Unary::Sin    => call(Unary::Cos, u),
        Unary::Cos    => -call(Unary::Sin, u),
        Unary::Tan    => one / (call(Unary::Cos, u) * call(Unary::Cos, u)),
        Unary::Asin   => one / call(Unary::Sqrt, one - u * u),
        Unary::Acos   => -(one / call(Unary::Sqrt, one - u * u)),
        Unary::Atan   => one / (one + u * u),
        Unary::Sinh   => call(Unary::Cosh, u),
        Unary::Cosh   => call(Unary::Sinh, u),
        Unary::Tanh   => one / (call(Unary::Cosh, u) * call(Unary::Cosh, u)),
        Unary::Asinh  => one / call(Unary::Sqrt, one + u * u),
        Unary::Acosh  => one / call(Unary::Sqrt, u * u - one),
        Unary::Atanh  => one / (one - u * u),
        Unary::Abs    => call(Unary::Signum, u),
        Unary::Signum => F::lift(0.0),
        Unary::Sign   => F::lift(0.0),
        Unary::Erf    => call(Unary::Exp, -(u * u)) * F::lift(FRAC_2_SQRT_PI),
        Unary::Sinc   => -(u * call(Unary::Sinc1, u)),
        Unary::Sinc1  => -(u * call(Unary::Sinc2, u)),
        Unary::Sinc2  => -(u * call(Unary::Sinc3, u)),
        Unary::Sinc3  => (call(Unary::Sinc2, u) - F::lift(7.0) * call(Unary::Sinc3, u)) / u,
    }
}

impl Field for f64 {
    fn lift(value: f64) -> Self {
        value
    }
    fn unary(function: Unary, of: Self) -> Self {
        function.evaluate(of)
    }
    fn ordered(a: Self, b: Self) -> Option<bool> {
        (a != b).then_some(a < b)
    }
}

/// A value, and its error in units of ε by a first-order running analysis (Higham 2002, section 3.3).
/// Sums count the sizes of their terms, so that the bound holds for every order of summation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Bounded {
    /// How many units two ways to evaluate the same formula may differ.
    const UNITS: f64 = 16.0;

    pub(super) fn tolerance(self) -> f64 {
        Self::UNITS * f64::EPSILON * (self.error + self.value.abs())
    }

    /// Whether the bound is small enough to mean something.
    pub(super) fn is_sharp(self) -> bool {
        self.value.is_finite() && self.error < 1e9
    }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let size = self.value.abs() + other.value.abs();
        Self { value: self.value + other.value, error: self.error + other.error + size }
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, error: self.error }
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + (-other)
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let value = self.value * other.value;
        let error = self.value.abs() * other.error + other.value.abs() * self.error + value.abs();
        Self { value, error }
    }
}

impl Div for Bounded {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let error = (self.error + value.abs() * other.error) / other.value.abs() + value.abs();
        Self { value, error }
    }
}

impl Field for Bounded {
    fn lift(value: f64) -> Self {
        Self { value, error: 0.0 }
    }
    fn unary(function: Unary, of: Self) -> Self {
        let value = function.evaluate(of.value);
        let error = slope(function, of.value).abs() * of.error + value.abs();
        let jumps = matches!(function, Unary::Abs | Unary::Signum | Unary::Sign);
        if jumps && Self::ordered(of, Self::lift(0.0)).is_none() {
            return Self { value, error: f64::INFINITY };
        }
        Self { value, error }
    }
    fn ordered(a: Self, b: Self) -> Option<bool> {
        let apart = a - b;
        (apart.value.abs() > apart.tolerance()).then_some(apart.value < 0.0)
    }
}

/// a + b ε with ε² = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual<F> {
    pub(super) re: F,
    pub(super) eps: F,
}

impl<F: Field> Add for Dual<F> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, eps: self.eps + other.eps }
    }
}

impl<F: Field> Sub for Dual<F> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, eps: self.eps - other.eps }
    }
}

impl<F: Field> Neg for Dual<F> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { re: -self.re, eps: -self.eps }
    }
}

impl<F: Field> Mul for Dual<F> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re, eps: self.eps * other.re + self.re * other.eps }
    }
}

impl<F: Field> Div for Dual<F> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let re = self.re / other.re;
        Self { re, eps: (self.eps - re * other.eps) / other.re }
    }
}

impl<F: Field> Field for Dual<F> {
    fn lift(value: f64) -> Self {
        Self { re: F::lift(value), eps: F::lift(0.0) }
    }
    fn unary(function: Unary, of: Self) -> Self {
        Self { re: F::unary(function, of.re), eps: slope(function, of.re) * of.eps }
    }
    fn ordered(a: Self, b: Self) -> Option<bool> {
        F::ordered(a.re, b.re)
    }
}
