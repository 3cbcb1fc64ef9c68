//! The functions of the language, each with its value and its first two derivatives from a textbook.
//!
//! The last column is the domain on which the function has two derivatives, with a margin.

use std::f64::consts::{LN_2, LN_10, PI};

use super::jet::Jet;

/// Value, first and second derivative.
pub(super) type Derivatives = [f64; 3];

#[derive(Clone, Copy)]
pub(super) struct UnaryFunction {
    pub(super) name: &'static str,
    pub(super) at: fn(f64) -> Derivatives,
    pub(super) domain: fn(f64) -> bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BinaryFunction {
    Atan2,
    Hypot,
    Powf,
    Min,
    Max,
}

impl BinaryFunction {
    pub(super) const ALL: [Self; 5] = [Self::Atan2, Self::Hypot, Self::Powf, Self::Min, Self::Max];

    pub(super) fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

impl std::fmt::Debug for UnaryFunction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for UnaryFunction {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

const MARGIN: f64 = 1e-2;

fn all(_: f64) -> bool {
    true
}
fn moderate(x: f64) -> bool {
    x.abs() < 8.0
}
fn positive(x: f64) -> bool {
    x > MARGIN
}
fn inside(x: f64) -> bool {
    x.abs() < 1.0 - MARGIN
}
fn nonzero(x: f64) -> bool {
    x.abs() > MARGIN
}

/// 2/√π·e^(−x²), the derivative of the error function.
fn gauss(x: f64) -> f64 {
    2.0 / PI.sqrt() * (-x * x).exp()
}
/// The error function by its series x − x³/3 + … in the form without cancellation.
pub(super) fn erf(x: f64) -> f64 {
    let terms = (1..200).scan(x, |term, n| {
        *term *= 2.0 * x * x / f64::from(2 * n + 1);
        Some(*term)
    });
    gauss(x) * (x + terms.sum::<f64>())
}

/// jₙ(x)/xⁿ = ∫ (1 − s²)ⁿ cos(xs) ds/(2ⁿn!) from 0 to 1, by Gauss's rule of five nodes on 64 pieces; where
/// the cosine turns several times, by the recursion, which loses no digits there.
pub(crate) fn bessel(order: i32, x: f64) -> f64 {
    if x.abs() > 4.0 {
        let next = |(a, b): (f64, f64), n: i32| (b, (f64::from(2 * n + 1) * b - a) / (x * x));
        return (0..order).fold((x.cos(), x.sin() / x), next).1;
    }
    let (inner, outer) = (
        (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0,
        (5.0 + 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0,
    );
    let (heavy, light) =
        ((322.0 + 13.0 * 70.0_f64.sqrt()) / 900.0, (322.0 - 13.0 * 70.0_f64.sqrt()) / 900.0);
    let rule = [(-outer, light), (-inner, heavy), (0.0, 128.0 / 225.0), (inner, heavy), (outer, light)];
    let pieces = (0..64).flat_map(|piece| {
        rule.map(|(node, weight)| ((f64::from(piece) + 0.5 + node / 2.0) / 64.0, weight / 128.0))
    });
    let integral: f64 = pieces.map(|(s, weight)| weight * (1.0 - s * s).powi(order) * (x * s).cos()).sum();
    integral / [1.0, 2.0, 8.0, 48.0, 384.0, 3840.0][order as usize]
}

macro_rules! row {
    ($name:literal, $domain:expr, $x:ident, $value:expr, $first:expr, $second:expr) => {
        UnaryFunction { name: $name, at: |$x| [$value, $first, $second], domain: $domain }
    };
}

#[rustfmt::skip]
pub(super) const UNARY: &[UnaryFunction] = &[
    row!("sqrt",   positive, x, x.sqrt(), 0.5 / x.sqrt(), -0.25 / (x * x.sqrt())),
    row!("cbrt",   nonzero,  x, x.cbrt(), x.cbrt() / (3.0 * x), -2.0 * x.cbrt() / (9.0 * x * x)),
    row!("exp",    moderate, x, x.exp(), x.exp(), x.exp()),
    row!("exp2",   moderate, x, x.exp2(), LN_2 * x.exp2(), LN_2 * LN_2 * x.exp2()),
    row!("exp_m1", moderate, x, x.exp_m1(), x.exp(), x.exp()),
    row!("ln",     positive, x, x.ln(), 1.0 / x, -1.0 / (x * x)),
    row!("ln_1p",  |x| positive(1.0 + x), x, x.ln_1p(), 1.0 / (1.0 + x), -1.0 / ((1.0 + x) * (1.0 + x))),
    row!("log2",   positive, x, x.ln() / LN_2, 1.0 / (x * LN_2), -1.0 / (x * x * LN_2)),
    row!("log10",  positive, x, x.ln() / LN_10, 1.0 / (x * LN_10), -1.0 / (x * x * LN_10)),
    row!("sin",    all,      x, x.sin(), x.cos(), -x.sin()),
    row!("cos",    all,      x, x.cos(), -x.sin(), -x.cos()),
    row!("tan",    |x| nonzero(x.cos()), x, x.tan(), 1.0 / x.cos().powi(2), 2.0 * x.sin() / x.cos().powi(3)),
    row!("asin",   inside,   x, x.asin(), (1.0 - x * x).powf(-0.5), x * (1.0 - x * x).powf(-1.5)),
    row!("acos",   inside,   x, x.acos(), -(1.0 - x * x).powf(-0.5), -x * (1.0 - x * x).powf(-1.5)),
    row!("atan",   all,      x, x.atan(), 1.0 / (1.0 + x * x), -2.0 * x / (1.0 + x * x).powi(2)),
    row!("sinh",   moderate, x, x.sinh(), x.cosh(), x.sinh()),
    row!("cosh",   moderate, x, x.cosh(), x.sinh(), x.cosh()),
    row!("tanh",   |x| x.abs() < 4.0, x, x.tanh(), x.cosh().powi(-2), -2.0 * x.tanh() * x.cosh().powi(-2)),
    row!("asinh",  all,      x, x.asinh(), (1.0 + x * x).powf(-0.5), -x * (1.0 + x * x).powf(-1.5)),
    row!("acosh",  |x| x > 1.0 + MARGIN, x, x.acosh(), (x * x - 1.0).powf(-0.5), -x * (x * x - 1.0).powf(-1.5)),
    row!("atanh",  inside,   x, x.atanh(), 1.0 / (1.0 - x * x), 2.0 * x / (1.0 - x * x).powi(2)),
    row!("abs",    nonzero,  x, x.abs(), x.signum(), 0.0),
    row!("signum", nonzero,  x, x.signum(), 0.0, 0.0),
    row!("recip",  nonzero,  x, 1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)),
    row!("erf",    |x| x.abs() < 4.0, x, erf(x), gauss(x), -2.0 * x * gauss(x)),
    row!("sinc",   |x| x.abs() < 20.0, x, bessel(0, x), -x * bessel(1, x), x * x * bessel(2, x) - bessel(1, x)),
    row!("to_radians", all,  x, x * (PI / 180.0), PI / 180.0, 0.0),
    row!("to_degrees", all,  x, x * (180.0 / PI), 180.0 / PI, 0.0),
];

/// The functions that the systems declare as their own: name, and the paths of its derivatives.
pub(super) const OWN: &[(&str, &[&str])] =
    &[("f", &["f", "df", "d2f"]), ("g", &["own::g", "own::dg", "own::d2g", "own::d3g"])];

/// The third derivative of the second one.
pub(super) fn own_third(x: f64) -> f64 {
    -8.0 * (2.0 * x).cos() + 2.0
}

/// x/(1 + x²), and sin 2x + x³/3.
pub(super) fn own(function: usize, x: f64) -> Derivatives {
    let s = 1.0 + x * x;
    match function {
        0 => [x / s, (1.0 - x * x) / (s * s), 2.0 * x * (x * x - 3.0) / (s * s * s)],
        _ => [
            (2.0 * x).sin() + x * x * x / 3.0,
            2.0 * (2.0 * x).cos() + x * x,
            -4.0 * (2.0 * x).sin() + 2.0 * x,
        ],
    }
}

/// A function of several variables that the systems call.
#[derive(Debug)]
pub(super) struct ScalarField {
    pub(super) name: &'static str,
    pub(super) arity: usize,
    /// The path that it is declared by; without one it is a field of the struct.
    pub(super) path: Option<&'static str>,
}

pub(super) const SCALAR_FIELDS: &[ScalarField] = &[
    ScalarField { name: "phi", arity: 2, path: None },
    ScalarField { name: "u_of", arity: 3, path: Some("own::U") },
];

/// sin(x + 2y) + x y², and z cos(x − y) + x z².
pub(super) fn scalar_field(field: usize, at: &[Jet]) -> Jet {
    let wave = |angle: &Jet, shift: f64| {
        angle.unary(&|x| [(x + shift).sin(), (x + shift).cos(), -(x + shift).sin()])
    };
    match (field, at) {
        (0, [x, y]) => wave(&x.plus(&y.scaled(2.0)), 0.0).plus(&x.times(&y.times(y))),
        (1, [x, y, z]) => z.times(&wave(&x.plus(&y.scaled(-1.0)), PI / 2.0)).plus(&x.times(&z.times(z))),
        _ => panic!("no function {field} of {} variables", at.len()),
    }
}

/// Its derivative along these axes.
pub(super) fn scalar_field_derivative(field: usize, axes: &[usize], at: &[f64]) -> f64 {
    let variables = at.iter().enumerate().map(|(axis, x)| Jet::variable(*x, axis, at.len()));
    let expansion = scalar_field(field, &variables.collect::<Vec<_>>());
    match axes {
        [] => expansion.value.value,
        [i] => expansion.gradient(*i).value,
        [i, j] => expansion.hessian(*i, *j).value,
        _ => panic!("functions of several variables have two derivatives"),
    }
}

/// Each second derivative is held against the first, and each first against the value.
#[test]
fn derivatives_are_those_of_the_functions() {
    let check = |name: &str, at: &dyn Fn(f64) -> Derivatives, x: f64| {
        let h = 1e-5;
        for order in 0..2 {
            let difference = (at(x + h)[order] - at(x - h)[order]) / (2.0 * h);
            let derivative = at(x)[order + 1];
            assert!(
                (difference - derivative).abs() < 1e-6 * (1.0 + derivative.abs()),
                "{name}({x}), {order}"
            );
        }
    };
    for x in [-2.3, -0.7, -0.3, 0.2, 0.6, 1.4, 2.1] {
        for row in UNARY.iter().filter(|row| (row.domain)(x)) {
            check(row.name, &row.at, x);
        }
        (0..OWN.len()).for_each(|function| check(OWN[function].0, &|x| own(function, x), x));
    }
}
