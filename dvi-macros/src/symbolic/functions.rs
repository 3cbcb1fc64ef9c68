//! The functions of one number: a row makes one.
//!
//! A row is the name as it is written and printed, the variant, the value, the properties, and the
//! derivative. The derivative may use the result `f` itself, so that sharing comes for free: (√u)' = 1/(2f).
//! A new function is a row here and, because neither may share anything with this table, a function of
//! `dvi_core::Scalar`, a row of the self-check and one of the oracle of the tests.

use core::f64::consts::{FRAC_2_SQRT_PI, LN_2, LOG2_E, LOG10_E};

use super::graph::{Binary, Expr, Graph};

/// What the compiler makes use of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Property {
    /// f(−x) = −f(x)
    Odd,
    /// f(−x) = f(x)
    Even,
    /// It has all derivatives everywhere.
    Smooth,
    /// |f(w)| ≤ C·|w| near 0.
    BelowItsArgument,
    NeverNegative,
    /// It overflows at moderate arguments.
    GrowsFast,
    /// Only derivatives are made of it.
    Internal,
}

/// A row of the table, but for the derivative.
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) function: Unary,
    pub(super) value: fn(f64) -> f64,
    properties: &'static [Property],
}

macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $name:literal $Variant:ident $value:expr, [$($Property:ident)*] |$graph:ident, $u:ident, $f:ident| $derivative:expr;
    )*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub(crate) enum Unary {
            $($(#[$doc])* $Variant,)*
        }

        pub(super) const UNARY: &[Row] = &[$(Row {
            name: $name,
            function: Unary::$Variant,
            value: $value,
            properties: &[$(Property::$Property),*],
        }),*];

        impl Graph {
            /// d f(u)/du, where `f` is the node f(u) itself.
            pub(super) fn unary_derivative(&mut self, function: Unary, u: Expr, f: Expr) -> Expr {
                match function {
                    $(Unary::$Variant => {
                        let ($graph, $u, $f) = (self, u, f);
                        $derivative
                    })*
                }
            }
        }
    };
}

#[rustfmt::skip]
functions! {
    "sqrt" Sqrt f64::sqrt, [NeverNegative] |graph, _u, f| graph.reciprocal(f).scaled(0.5);
    "cbrt" Cbrt f64::cbrt, [Odd] |graph, _u, f| { let g = graph.power(f, 2); graph.reciprocal(g).scaled(1.0 / 3.0) };
    "exp" Exp f64::exp, [Smooth NeverNegative GrowsFast] |_graph, _u, f| f;
    "exp2" Exp2 f64::exp2, [Smooth NeverNegative GrowsFast] |_graph, _u, f| f.scaled(LN_2);
    "exp_m1" ExpM1 f64::exp_m1, [Smooth BelowItsArgument GrowsFast] |graph, u, _f| graph.unary(Unary::Exp, u);
    "ln" Ln f64::ln, [] |graph, u, _f| graph.reciprocal(u);
    "ln_1p" Ln1p f64::ln_1p, [BelowItsArgument] |graph, u, _f| { let g = graph.add(Expr::ONE, u); graph.reciprocal(g) };
    "log2" Log2 f64::log2, [] |graph, u, _f| graph.reciprocal(u).scaled(LOG2_E);
    "log10" Log10 f64::log10, [] |graph, u, _f| graph.reciprocal(u).scaled(LOG10_E);
    "sin" Sin f64::sin, [Odd Smooth BelowItsArgument] |graph, u, _f| graph.unary(Unary::Cos, u);
    "cos" Cos f64::cos, [Even Smooth] |graph, u, _f| graph.unary(Unary::Sin, u).negated();
    "tan" Tan f64::tan, [Odd BelowItsArgument] |graph, _u, f| { let g = graph.power(f, 2); graph.add(Expr::ONE, g) };
    "asin" Asin f64::asin, [Odd BelowItsArgument] |graph, u, _f| { let g = graph.one_minus_square(u); graph.inverse_root(g) };
    "acos" Acos f64::acos, [] |graph, u, _f| { let g = graph.one_minus_square(u); graph.inverse_root(g).negated() };
    "atan" Atan f64::atan, [Odd Smooth BelowItsArgument] |graph, u, _f| { let g = graph.power(u, 2); let g = graph.add(Expr::ONE, g); graph.reciprocal(g) };
    "sinh" Sinh f64::sinh, [Odd Smooth BelowItsArgument GrowsFast] |graph, u, _f| graph.unary(Unary::Cosh, u);
    "cosh" Cosh f64::cosh, [Even Smooth NeverNegative GrowsFast] |graph, u, _f| graph.unary(Unary::Sinh, u);
    "tanh" Tanh f64::tanh, [Odd Smooth BelowItsArgument] |graph, u, _f| { let g = graph.unary(Unary::Cosh, u); let g = graph.reciprocal(g); graph.power(g, 2) };
    "asinh" Asinh f64::asinh, [Odd Smooth BelowItsArgument] |graph, u, _f| { let g = graph.binary(Binary::Hypot, Expr::ONE, u); graph.reciprocal(g) };
    "acosh" Acosh f64::acosh, [] |graph, u, _f| { let (g, h) = graph.roots_around_one(u); let g = graph.multiply(g, h); graph.reciprocal(g) };
    "atanh" Atanh f64::atanh, [Odd BelowItsArgument] |graph, u, _f| { let g = graph.one_minus_square(u); graph.reciprocal(g) };
    "abs" Abs f64::abs, [Even BelowItsArgument NeverNegative] |graph, u, _f| graph.unary(Unary::Sign, u);
    /// As in `f64`: 1 or −1, with the sign bit of a zero.
    "signum" Signum f64::signum, [Odd] |_graph, _u, _f| Expr::ZERO;
    /// |u|', which is 0 at 0; the compiler makes it, users do not write it.
    "sign" Sign sign, [Odd Internal] |_graph, _u, _f| Expr::ZERO;
    "erf" Erf erf, [Odd Smooth BelowItsArgument] |graph, u, _f| { let g = graph.power(u, 2).negated(); graph.unary(Unary::Exp, g).scaled(FRAC_2_SQRT_PI) };
    "sinc" Sinc |x| bessel(0, x), [Even Smooth] |graph, u, _f| { let g = graph.unary(Unary::Sinc1, u); graph.multiply(u, g).negated() };
    /// j₁(u)/u, j₂(u)/u² and j₃(u)/u³, of which the derivatives of `sinc` are made; a gauge has its third.
    "sinc1" Sinc1 |x| bessel(1, x), [Even Smooth Internal] |graph, u, _f| { let g = graph.unary(Unary::Sinc2, u); graph.multiply(u, g).negated() };
    "sinc2" Sinc2 |x| bessel(2, x), [Even Smooth Internal] |graph, u, _f| { let g = graph.unary(Unary::Sinc3, u); graph.multiply(u, g).negated() };
    "sinc3" Sinc3 |x| bessel(3, x), [Even Internal] |graph, u, f| { let g = graph.unary(Unary::Sinc2, u); let g = graph.subtract(g, f.scaled(7.0)); graph.divide(g, u) };
}

impl Unary {
    /// The rows are in the order of the variants.
    fn row(self) -> &'static Row {
        &UNARY[self as usize]
    }

    pub(crate) fn name(self) -> &'static str {
        self.row().name
    }

    /// Whether a formula may use it.
    pub(crate) fn is_written(self) -> bool {
        !self.has(Property::Internal)
    }

    pub(super) fn has(self, property: Property) -> bool {
        self.row().properties.contains(&property)
    }

    /// The sign under reflection.
    pub(super) fn parity(self) -> Option<f64> {
        match (self.has(Property::Odd), self.has(Property::Even)) {
            (true, _) => Some(-1.0),
            (false, true) => Some(1.0),
            (false, false) => None,
        }
    }

    pub(super) fn evaluate(self, x: f64) -> f64 {
        (self.row().value)(x)
    }
}

fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        // Not a number stays what it is.
        0.0 * x
    }
}

/// The error function: its series 2/√π·e^(−x²)·Σ (2x²)ⁿ·x/(2n + 1)!!, in which no term is negative.
fn erf(x: f64) -> f64 {
    if x.abs() > 6.0 {
        return sign(x);
    }
    let (mut term, mut sum, mut odd) = (x, x, 1.0);
    while term.abs() > sum.abs() * (f64::EPSILON / 8.0) {
        odd += 2.0;
        term *= 2.0 * x * x / odd;
        sum += term;
    }
    core::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp() * sum
}

/// jₙ(x)/xⁿ: the alternating series, or the recursion that grows out of the cosine.
fn bessel(order: u32, x: f64) -> f64 {
    let (mut value, mut next) = (x.cos(), x.sin() / x);
    if x.abs() > 2.0 {
        for n in 0..order {
            (value, next) = (next, (f64::from(2 * n + 1) * next - value) / (x * x));
        }
        return next;
    }
    let first = (1..=order).map(|n| f64::from(2 * n + 1)).product::<f64>();
    let (mut term, mut sum) = (1.0 / first, 0.0);
    for k in 1..20 {
        sum += term;
        term *= -x * x / f64::from(2 * k * (2 * order + 2 * k + 1));
    }
    sum
}

impl Graph {
    fn inverse_root(&mut self, radicand: Expr) -> Expr {
        let root = self.unary(Unary::Sqrt, radicand);
        self.reciprocal(root)
    }

    /// (1 − u)(1 + u), which keeps its digits near |u| = 1.
    pub(super) fn one_minus_square(&mut self, u: Expr) -> Expr {
        let (below, above) = (self.subtract(Expr::ONE, u), self.add(Expr::ONE, u));
        self.multiply(below, above)
    }

    /// √(u − 1) and √(u + 1): their product neither overflows nor loses digits near 1, and it is no number
    /// below −1.
    fn roots_around_one(&mut self, u: Expr) -> (Expr, Expr) {
        let (below, above) = (self.subtract(u, Expr::ONE), self.add(u, Expr::ONE));
        (self.unary(Unary::Sqrt, below), self.unary(Unary::Sqrt, above))
    }
}

/// Those that a formula may use.
fn written() -> impl Iterator<Item = &'static Row> {
    UNARY.iter().filter(|row| row.function.is_written())
}

pub(crate) fn unary_by_name(name: &str) -> Option<Unary> {
    written().find(|row| row.name == name).map(|row| row.function)
}

/// Their names, in the order of the table.
pub(crate) fn unary_names() -> impl Iterator<Item = &'static str> {
    written().map(|row| row.name)
}
