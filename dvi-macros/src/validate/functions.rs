//! The functions of the language with their first four derivatives, written out for the self-check
//! alone: it shares no rule with the compiler that it checks.

use std::f64::consts::{LN_2, LN_10, PI};

use super::jet::{Jet, NOISE, Sized, Taylor};
use crate::internal::internal;

/// The derivatives of a function of one number at x, or `None` if there is no function of that name.
#[rustfmt::skip]
fn taylor(name: &str, x: f64) -> Option<Taylor> {
    let squared = x * x;
    let value = match name {
        "sqrt"   => { let f = x.sqrt(); [f, 0.5 / f, -0.25 / (f * x), 0.375 / (f * squared), -0.9375 / (f * squared * x)] }
        "cbrt"   => { let f = x.cbrt(); [f, f / (3.0 * x), -2.0 * f / (9.0 * squared), 10.0 * f / (27.0 * squared * x), -80.0 * f / (81.0 * squared * squared)] }
        "exp"    => [x.exp(); 5],
        "exp2"   => [0, 1, 2, 3, 4].map(|order| LN_2.powi(order) * x.exp2()),
        "exp_m1" => { let f = x.exp(); [x.exp_m1(), f, f, f, f] }
        "ln"     => logarithm(x.ln(), x, 1.0),
        "ln_1p"  => logarithm(x.ln_1p(), 1.0 + x, 1.0),
        "log2"   => logarithm(x.log2(), x, LN_2),
        "log10"  => logarithm(x.log10(), x, LN_10),
        "sin"    => { let (s, c) = x.sin_cos(); [s, c, -s, -c, s] }
        "cos"    => { let (s, c) = x.sin_cos(); [c, -s, -c, s, c] }
        "tan"    => { let f = x.tan(); let d = 1.0 + f * f; [f, d, 2.0 * f * d, 2.0 * d * (1.0 + 3.0 * f * f), 8.0 * f * d * (2.0 + 3.0 * f * f)] }
        "asin"   => { let d = inverse_sine(x); [x.asin(), d[0], d[1], d[2], d[3]] }
        "acos"   => { let d = inverse_sine(x); [x.acos(), -d[0], -d[1], -d[2], -d[3]] }
        "atan"   => { let d = 1.0 / (1.0 + squared); [x.atan(), d, -2.0 * x * d * d, (6.0 * squared - 2.0) * d.powi(3), 24.0 * x * (1.0 - squared) * d.powi(4)] }
        "sinh"   => { let (s, c) = (x.sinh(), x.cosh()); [s, c, s, c, s] }
        "cosh"   => { let (s, c) = (x.sinh(), x.cosh()); [c, s, c, s, c] }
        "tanh"   => { let (f, c) = (x.tanh(), x.cosh()); let d = 1.0 / (c * c); [f, d, -2.0 * f * d, d * (4.0 * f * f - 2.0 * d), d * f * (16.0 * d - 8.0 * f * f)] }
        "asinh"  => { let r = 1.0 / (squared + 1.0).sqrt(); [x.asinh(), r, -x * r.powi(3), (2.0 * squared - 1.0) * r.powi(5), x * (9.0 - 6.0 * squared) * r.powi(7)] }
        "acosh"  => { let r = 1.0 / (squared - 1.0).sqrt(); [x.acosh(), r, -x * r.powi(3), (2.0 * squared + 1.0) * r.powi(5), -x * (9.0 + 6.0 * squared) * r.powi(7)] }
        "atanh"  => { let d = 1.0 / (1.0 - squared); [x.atanh(), d, 2.0 * x * d * d, (2.0 + 6.0 * squared) * d.powi(3), 24.0 * x * (1.0 + squared) * d.powi(4)] }
        "abs"    => [x.abs(), if x == 0.0 { 0.0 } else { x.signum() }, 0.0, 0.0, 0.0],
        "signum" => [x.signum(), 0.0, 0.0, 0.0, 0.0],
        "erf"    => { let d = 2.0 / PI.sqrt() * (-squared).exp(); [error_function(x), d, -2.0 * x * d, (4.0 * squared - 2.0) * d, x * (12.0 - 8.0 * squared) * d] }
        "sinc"   => sinc(x),
        _ => return None,
    };
    Some(value)
}

/// sin x/x and its derivatives: term by term of the power series, and from x f″ + 2f′ + x f = 0.
fn sinc(x: f64) -> Taylor {
    if x.abs() > 2.0 {
        let f = x.sin() / x;
        let first = (x.cos() - f) / x;
        let second = -f - 2.0 * first / x;
        let third = -first - 2.0 * second / x + 2.0 * first / (x * x);
        return [f, first, second, third, -second - (4.0 * third + 2.0 * first) / x];
    }
    let mut sums = [0.0; 5];
    // (−1)ᵏ/(2k + 1)!
    let mut coefficient = 1.0;
    for k in 0..16 {
        let mut factor = coefficient;
        for (order, sum) in sums.iter_mut().enumerate() {
            let exponent = 2 * k - order as i32;
            if exponent >= 0 {
                *sum += factor * x.powi(exponent);
            }
            factor *= f64::from(exponent.max(0));
        }
        coefficient /= f64::from(-(2 * k + 2) * (2 * k + 3));
    }
    sums
}

/// −f′/x of the sinc function, the same of that, and of that: by their power series, or from the derivatives.
fn sinc_slope(order: i32, x: f64) -> f64 {
    if x.abs() > 2.0 {
        let [_, first, second, third, _] = sinc(x);
        return match order {
            1 => -first / x,
            2 => (second - first / x) / (x * x),
            _ => -(third - 3.0 * (second - first / x) / x) / (x * x * x),
        };
    }
    // (−1)ᵏ/(2k + 1)!, times −2k, −(2k − 2) and −(2k − 4), for x to the power 2k − 2, 2k − 4 or 2k − 6.
    let terms = (0..16).scan(1.0, |coefficient, k| {
        let slopes: f64 = (0..order).map(|slope| -f64::from(2 * (k - slope))).product();
        let exponent = 2 * (k - order);
        let term = if exponent >= 0 { *coefficient * slopes * x.powi(exponent) } else { 0.0 };
        *coefficient /= f64::from(-(2 * k + 2) * (2 * k + 3));
        Some(term)
    });
    terms.sum()
}

/// The error function, by its series for small arguments and the continued fraction of its complement for
/// large ones (Abramowitz & Stegun 1964, 7.1.5 and 7.1.14).
fn error_function(x: f64) -> f64 {
    if x.abs() < 2.0 {
        let terms = (0..60).scan(x, |power, n| {
            let term = *power / f64::from(2 * n + 1);
            *power *= -x * x / f64::from(n + 1);
            Some(term)
        });
        return 2.0 / PI.sqrt() * terms.sum::<f64>();
    }
    let fraction = (1..=120).rev().fold(x.abs(), |tail, n| x.abs() + f64::from(n) / 2.0 / tail);
    (1.0 - (-x * x).exp() / (PI.sqrt() * fraction)).copysign(x)
}

/// A logarithm whose derivative is 1/(base · argument).
fn logarithm(value: f64, argument: f64, base: f64) -> Taylor {
    let d = 1.0 / (base * argument);
    let square = argument * argument;
    [value, d, -d / argument, 2.0 * d / square, -6.0 * d / (square * argument)]
}

/// The derivatives of arcsin.
fn inverse_sine(x: f64) -> [f64; 4] {
    let r = 1.0 / ((1.0 - x) * (1.0 + x)).sqrt();
    [r, x * r.powi(3), (1.0 + 2.0 * x * x) * r.powi(5), x * (9.0 + 6.0 * x * x) * r.powi(7)]
}

/// f(x) for a function of one number.
pub(super) fn unary(name: &str, x: &Jet) -> Option<Jet> {
    let Sized { value, size } = x.value();
    let is_noise = value != 0.0 && value.abs() < NOISE * size;
    if name == "signum" && (x.is_zero_without_sign() || is_noise) {
        return Some(Jet::number(f64::NAN));
    }
    Some(x.through(taylor(name, x.value().value)?))
}

/// f(a, b) for a function of two numbers.
pub(super) fn binary(name: &str, a: &Jet, b: &Jet) -> Option<Jet> {
    let (x, y) = (a.value().value, b.value().value);
    let result = match name {
        "atan2" if a.is_zero_without_sign() || b.is_zero_without_sign() => Jet::number(f64::NAN),
        "hypot" => unary("sqrt", &a.times(a).plus(&b.times(b)))?,
        // 0⁰ of sums without terms: the rules of differentiation do not know that it is a constant.
        "powf" if a.is_zero_without_sign() || b.is_zero_without_sign() => Jet::number(f64::NAN),
        "powf" if y.fract() == 0.0 && y.abs() <= 64.0 && !b.holds_variable() => a.power(y as i32),
        "powf" => unary("exp", &b.times(&unary("ln", a)?))?,
        // The angle that has the derivative of arctan(a/b) or of −arctan(b/a), whichever quotient is small.
        "atan2" if x.abs() <= y.abs() => unary("atan", &a.times(&b.reciprocal()))?.with_value(x.atan2(y)),
        "atan2" => unary("atan", &b.times(&a.reciprocal()))?.scaled(-1.0).with_value(x.atan2(y)),
        _ => return None,
    };
    Some(result)
}

/// The value of the function of one number that is printed with this name.
pub(super) fn printed_unary(name: &str, x: f64) -> f64 {
    match (name, taylor(name, x)) {
        // What derivatives of |x| are made of: the mean of both sides at 0.
        ("sign", _) if x == 0.0 => 0.0,
        ("sign", _) => x.signum(),
        ("sinc1", _) => sinc_slope(1, x),
        ("sinc2", _) => sinc_slope(2, x),
        ("sinc3", _) => sinc_slope(3, x),
        (_, Some([value, ..])) => value,
        _ => internal(format!("the self-check does not know the function `{name}`")),
    }
}

/// The value of the function of two numbers that is printed with this name.
pub(super) fn printed_binary(name: &str, a: f64, b: f64) -> f64 {
    match name {
        // A quotient by a root that is zero where both are.
        "over_root" if b == 0.0 => 0.0,
        "over_root" => a / b,
        "over_squares" => a / (a * a + b * b),
        "hypot" => a.hypot(b),
        "powf" => a.powf(b),
        "atan2" => a.atan2(b),
        _ => internal(format!("the self-check does not know the function `{name}`")),
    }
}

/// A smooth function in place of the user's number `number`, and its derivatives.
pub(super) fn stand_in(number: usize, order: u32, x: f64) -> f64 {
    let phase = 0.7 * x + 0.4 * number as f64 + 0.3;
    let (s, c) = phase.sin_cos();
    let wave = [s, c, -s, -c][order as usize % 4];
    0.7_f64.powi(order as i32) * wave + if order == 0 { 1.5 } else { 0.0 }
}

pub(super) fn own(number: usize, x: &Jet) -> Jet {
    let at = x.value().value;
    x.through([0, 1, 2, 3, 4].map(|order| stand_in(number, order, at)))
}

// A smooth function of several variables in place of the user's number n: 1.5 + sin(a·x + φ) + 0.3 cos(b·x +
// φ). No two axes are alike in it.

/// φ of the function that stands for number `number`.
fn phase(number: usize) -> f64 {
    0.4 * number as f64 + 0.3
}

/// a and b along an axis.
fn slopes(axis: usize) -> [f64; 2] {
    let axis = axis as f64;
    [0.8 - 0.5 * axis, 0.6 / (1.0 + axis)]
}

/// A partial derivative of the function that stands for number `number`.
pub(super) fn scalar_field_stand_in(number: usize, axes: &[usize], at: &[f64]) -> f64 {
    let angle = |wave: usize| {
        at.iter().enumerate().fold(phase(number), |sum, (axis, x)| sum + slopes(axis)[wave] * x)
    };
    let factor = |wave: usize| axes.iter().map(|axis| slopes(*axis)[wave]).product::<f64>();
    // Each derivative shifts a wave by a quarter of its period.
    let shift = axes.len() as f64 * PI / 2.0;
    let constant = if axes.is_empty() { 1.5 } else { 0.0 };
    constant + factor(0) * (angle(0) + shift).sin() + 0.3 * factor(1) * (angle(1) + shift).cos()
}

/// That function of jets.
pub(super) fn scalar_field(number: usize, at: &[Jet]) -> Jet {
    let wave = |wave: usize, shift: f64| {
        let terms = at.iter().enumerate().map(|(axis, x)| x.clone().scaled(slopes(axis)[wave]));
        let angle = terms.fold(Jet::number(phase(number)), |sum, term| sum.plus(&term));
        let at = angle.value().value + shift;
        angle.through([0.0, 1.0, 2.0, 3.0, 4.0].map(|order| (at + order * PI / 2.0).sin()))
    };
    Jet::number(1.5).plus(&wave(0, 0.0)).plus(&wave(1, PI / 2.0).scaled(0.3))
}
