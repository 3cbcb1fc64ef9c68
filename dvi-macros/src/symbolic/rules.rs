//! The table of functions: name, value and derivative of each, side by side.
//!
//! A derivative may use the result `f` itself, so that sharing comes for free: (√u)' = 1/(2f).

use core::f64::consts::{FRAC_2_SQRT_PI, LN_2, LOG2_E, LOG10_E};

use super::graph::{Binary, Expr, Graph, Id, Node, Relation, Unary};
use crate::internal::internal;

pub(super) type UnaryRow = (&'static str, Unary, fn(f64) -> f64, Option<f64>);
pub(super) type BinaryRow = (&'static str, Binary, fn(f64, f64) -> f64);

/// Name, value, and sign under reflection (odd −1, even 1).
#[rustfmt::skip]
pub(super) const UNARY: &[UnaryRow] = &[
    ("sqrt",   Unary::Sqrt,   f64::sqrt,   None),
    ("cbrt",   Unary::Cbrt,   f64::cbrt,   Some(-1.0)),
    ("exp",    Unary::Exp,    f64::exp,    None),
    ("exp2",   Unary::Exp2,   f64::exp2,   None),
    ("exp_m1", Unary::ExpM1,  f64::exp_m1, None),
    ("ln",     Unary::Ln,     f64::ln,     None),
    ("ln_1p",  Unary::Ln1p,   f64::ln_1p,  None),
    ("log2",   Unary::Log2,   f64::log2,   None),
    ("log10",  Unary::Log10,  f64::log10,  None),
    ("sin",    Unary::Sin,    f64::sin,    Some(-1.0)),
    ("cos",    Unary::Cos,    f64::cos,    Some(1.0)),
    ("tan",    Unary::Tan,    f64::tan,    Some(-1.0)),
    ("asin",   Unary::Asin,   f64::asin,   Some(-1.0)),
    ("acos",   Unary::Acos,   f64::acos,   None),
    ("atan",   Unary::Atan,   f64::atan,   Some(-1.0)),
    ("sinh",   Unary::Sinh,   f64::sinh,   Some(-1.0)),
    ("cosh",   Unary::Cosh,   f64::cosh,   Some(1.0)),
    ("tanh",   Unary::Tanh,   f64::tanh,   Some(-1.0)),
    ("asinh",  Unary::Asinh,  f64::asinh,  Some(-1.0)),
    ("acosh",  Unary::Acosh,  f64::acosh,  None),
    ("atanh",  Unary::Atanh,  f64::atanh,  Some(-1.0)),
    ("abs",    Unary::Abs,    f64::abs,    Some(1.0)),
    ("signum", Unary::Signum, f64::signum, Some(-1.0)),
    ("sign",   Unary::Sign,   sign,        Some(-1.0)),
    ("erf",    Unary::Erf,    erf,         Some(-1.0)),
];

#[rustfmt::skip]
pub(super) const BINARY: &[BinaryRow] = &[
    ("atan2", Binary::Atan2, f64::atan2),
    ("hypot", Binary::Hypot, f64::hypot),
    ("powf",  Binary::Powf,  f64::powf),
    ("over_root", Binary::OverRoot, over_root),
];

/// What only derivatives are made of.
const INTERNAL: [&str; 2] = ["sign", "over_root"];

/// The functions that have all derivatives everywhere.
const SMOOTH: [Unary; 11] = [
    Unary::Exp,
    Unary::Exp2,
    Unary::ExpM1,
    Unary::Sin,
    Unary::Cos,
    Unary::Atan,
    Unary::Sinh,
    Unary::Cosh,
    Unary::Tanh,
    Unary::Asinh,
    Unary::Erf,
];

/// Whether it overflows at moderate arguments.
pub(super) fn grows_fast(node: &Node) -> bool {
    let exponentials = [Unary::Exp, Unary::Exp2, Unary::ExpM1, Unary::Sinh, Unary::Cosh];
    matches!(node, Node::Unary(function, _) if exponentials.contains(function))
}

pub(super) fn is_smooth(function: Unary) -> bool {
    SMOOTH.contains(&function)
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

fn over_root(w: f64, root: f64) -> f64 {
    if root <= 0.0 { 0.0 * w } else { w / root }
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

fn row(function: Unary) -> &'static UnaryRow {
    let row = UNARY.iter().find(|(_, known, ..)| *known == function);
    row.unwrap_or_else(|| internal(format!("{function:?} is not in the table of functions")))
}

fn binary_row(function: Binary) -> &'static BinaryRow {
    let row = BINARY.iter().find(|(_, known, ..)| *known == function);
    row.unwrap_or_else(|| internal(format!("{function:?} is not in the table of functions")))
}

pub(super) fn parity(function: Unary) -> Option<f64> {
    let (_, _, _, parity) = row(function);
    *parity
}

pub(super) fn evaluate_unary(function: Unary, x: f64) -> f64 {
    let (_, _, value, _) = row(function);
    value(x)
}

pub(super) fn evaluate_binary(function: Binary, a: f64, b: f64) -> f64 {
    let (_, _, value) = binary_row(function);
    value(a, b)
}

pub(crate) fn unary_by_name(name: &str) -> Option<Unary> {
    let mut written = UNARY.iter().filter(|(known, ..)| !INTERNAL.contains(known));
    written.find(|(known, ..)| *known == name).map(|(_, function, ..)| *function)
}

pub(crate) fn binary_by_name(name: &str) -> Option<Binary> {
    let mut written = BINARY.iter().filter(|(known, ..)| !INTERNAL.contains(known));
    written.find(|(known, ..)| *known == name).map(|(_, function, _)| *function)
}

/// The names of all functions that a formula may use, in the order of the tables.
pub(crate) fn unary_names() -> impl Iterator<Item = &'static str> {
    let names = UNARY.iter().map(|(name, ..)| *name).chain(BINARY.iter().map(|(name, ..)| *name));
    names.filter(|name| !INTERNAL.contains(name))
}

impl Unary {
    pub(crate) fn name(self) -> &'static str {
        row(self).0
    }
}

impl Binary {
    pub(crate) fn name(self) -> &'static str {
        binary_row(self).0
    }
}

impl Graph {
    /// d f(u)/du, where `f` is the node f(u) itself.
    #[rustfmt::skip]
    pub(super) fn unary_derivative(&mut self, function: Unary, u: Expr, f: Expr) -> Expr {
        let one = Expr::ONE;
        match function {
            Unary::Sqrt   => self.reciprocal(f).scaled(0.5),
            Unary::Cbrt   => { let g = self.power(f, 2); self.reciprocal(g).scaled(1.0 / 3.0) }
            Unary::Exp    => f,
            Unary::Exp2   => f.scaled(LN_2),
            Unary::ExpM1  => self.unary(Unary::Exp, u),
            Unary::Ln     => self.reciprocal(u),
            Unary::Ln1p   => { let g = self.add(one, u); self.reciprocal(g) }
            Unary::Log2   => self.reciprocal(u).scaled(LOG2_E),
            Unary::Log10  => self.reciprocal(u).scaled(LOG10_E),
            Unary::Sin    => self.unary(Unary::Cos, u),
            Unary::Cos    => self.unary(Unary::Sin, u).negated(),
            Unary::Tan    => { let g = self.power(f, 2); self.add(one, g) }
            Unary::Asin   => { let g = self.one_minus_square(u); self.inverse_root(g) }
            Unary::Acos   => { let g = self.one_minus_square(u); self.inverse_root(g).negated() }
            Unary::Atan   => { let g = self.power(u, 2); let g = self.add(one, g); self.reciprocal(g) }
            Unary::Sinh   => self.unary(Unary::Cosh, u),
            Unary::Cosh   => self.unary(Unary::Sinh, u),
            Unary::Tanh   => { let g = self.unary(Unary::Cosh, u); let g = self.reciprocal(g); self.power(g, 2) }
            Unary::Asinh  => { let g = self.binary(Binary::Hypot, one, u); self.reciprocal(g) }
            Unary::Acosh  => { let (g, h) = self.roots_around_one(u); let g = self.multiply(g, h); self.reciprocal(g) }
            Unary::Atanh  => { let g = self.one_minus_square(u); self.reciprocal(g) }
            Unary::Abs    => self.unary(Unary::Sign, u),
            Unary::Signum => Expr::ZERO,
            Unary::Sign   => Expr::ZERO,
            Unary::Erf    => { let g = self.power(u, 2).negated(); self.unary(Unary::Exp, g).scaled(FRAC_2_SQRT_PI) }
        }
    }

    fn inverse_root(&mut self, radicand: Expr) -> Expr {
        let root = self.unary(Unary::Sqrt, radicand);
        self.reciprocal(root)
    }

    /// (1 − u)(1 + u), which keeps its digits near |u| = 1.
    fn one_minus_square(&mut self, u: Expr) -> Expr {
        let (below, above) = (self.subtract(Expr::ONE, u), self.add(Expr::ONE, u));
        self.multiply(below, above)
    }

    /// √(u − 1) and √(u + 1): their product neither overflows nor loses digits near 1, and it is no number
    /// below −1.
    fn roots_around_one(&mut self, u: Expr) -> (Expr, Expr) {
        let (below, above) = (self.subtract(u, Expr::ONE), self.add(u, Expr::ONE));
        (self.unary(Unary::Sqrt, below), self.unary(Unary::Sqrt, above))
    }

    /// (1/u)' along `by`, where `f` is the node 1/u: −f²·u', and −n·f·tanh s·s' for u = coshⁿ s, since
    /// sinh s overflows where f is 0.
    pub(super) fn reciprocal_derivative(&mut self, f: Id, u: Id, by: Id) -> Expr {
        if let [(base, exponent)] = *self.factors(u).as_slice()
            && let Node::Unary(Unary::Cosh, s) = *self.node(base)
        {
            let tangent = self.derivative(s, by);
            if tangent.is_zero() {
                return Expr::ZERO;
            }
            let slope = self.unary(Unary::Tanh, s).scaled(-f64::from(exponent));
            return self.product(&[f.into(), slope, tangent]);
        }
        let tangent = self.node_derivative(u, by);
        if tangent.is_zero() {
            return Expr::ZERO;
        }
        let square = self.power(f.into(), 2);
        let derivative = self.multiply(square, tangent).negated();
        if self.depends(u, grows_fast) {
            // Where u has overflowed, 1/u is 0 and does not change; u' may have overflowed too.
            return self.choose(square, Relation::HasMore, Expr::ZERO, derivative, Expr::ZERO);
        }
        derivative
    }

    /// (∂f/∂a, ∂f/∂b), where `f` is the node f(a, b) itself.
    pub(super) fn binary_derivatives(&mut self, function: Binary, a: Expr, b: Expr, f: Expr) -> [Expr; 2] {
        match function {
            Binary::Atan2 => {
                let (squares_a, squares_b) = (self.power(a, 2), self.power(b, 2));
                let squares = self.add(squares_a, squares_b);
                let over = self.reciprocal(squares);
                [self.multiply(b, over), self.multiply(a, over).negated()]
            }
            Binary::Hypot => {
                let over = self.reciprocal(f);
                [self.multiply(a, over), self.multiply(b, over)]
            }
            Binary::Powf => {
                let less = self.subtract(b, Expr::ONE);
                let power = self.binary(Binary::Powf, a, less);
                let logarithm = self.unary(Unary::Ln, a);
                // a⁰ does not change with a, not even where a⁻¹ is no number.
                let slope = self.multiply(b, power);
                let squared = self.power(b, 2);
                [self.where_asked(squared, slope), self.multiply(f, logarithm)]
            }
            Binary::OverRoot => {
                let over = self.reciprocal(b);
                [over, self.multiply(f, over).negated()]
            }
        }
    }
}
