//! The table of functions: name, value and derivative of each, side by side.
//!
//! A derivative may use the result `f` itself, so that sharing comes for free: (√u)' = 1/(2f).

use core::f64::consts::{LN_2, LOG2_E, LOG10_E};

use super::graph::{Binary, Expr, Graph, Unary};

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
];

#[rustfmt::skip]
pub(super) const BINARY: &[BinaryRow] = &[
    ("atan2", Binary::Atan2, f64::atan2),
    ("hypot", Binary::Hypot, f64::hypot),
    ("powf",  Binary::Powf,  f64::powf),
];

fn row(function: Unary) -> Option<&'static UnaryRow> {
    UNARY.iter().find(|(_, known, _, _)| *known == function)
}

pub(super) fn parity(function: Unary) -> Option<f64> {
    row(function).and_then(|(_, _, _, parity)| *parity)
}

pub(super) fn evaluate_unary(function: Unary, x: f64) -> f64 {
    row(function).map_or(f64::NAN, |(_, _, value, _)| value(x))
}

pub(super) fn evaluate_binary(function: Binary, a: f64, b: f64) -> f64 {
    BINARY.iter().find(|(_, known, _)| *known == function).map_or(f64::NAN, |(_, _, value)| value(a, b))
}

pub(crate) fn unary_by_name(name: &str) -> Option<Unary> {
    UNARY.iter().find(|(known, ..)| *known == name).map(|(_, function, ..)| *function)
}

pub(crate) fn binary_by_name(name: &str) -> Option<Binary> {
    BINARY.iter().find(|(known, ..)| *known == name).map(|(_, function, _)| *function)
}

/// The names of all functions, in the order of the tables.
pub(crate) fn unary_names() -> impl Iterator<Item = &'static str> {
    UNARY.iter().map(|(name, ..)| *name).chain(BINARY.iter().map(|(name, ..)| *name))
}

impl Unary {
    pub(crate) fn name(self) -> &'static str {
        row(self).map_or("?", |(name, ..)| name)
    }
}

impl Binary {
    pub(crate) fn name(self) -> &'static str {
        BINARY.iter().find(|(_, known, _)| *known == self).map_or("?", |(name, ..)| name)
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
            Unary::ExpM1  => self.add(f, one),
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
            Unary::Tanh   => { let g = self.power(f, 2); self.subtract(one, g) }
            Unary::Asinh  => { let g = self.power(u, 2); let g = self.add(one, g); self.inverse_root(g) }
            Unary::Acosh  => { let g = self.one_minus_square(u).negated(); self.inverse_root(g) }
            Unary::Atanh  => { let g = self.one_minus_square(u); self.reciprocal(g) }
            Unary::Abs    => self.unary(Unary::Signum, u),
            Unary::Signum => Expr::ZERO,
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
                [self.multiply(b, power), self.multiply(f, logarithm)]
            }
        }
    }
}
