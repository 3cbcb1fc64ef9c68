//! Quotients, and the functions of two numbers: name, value and derivatives.

use super::functions::{Property, Unary};
use super::graph::{Binary, Expr, Graph, Id, Node, Relation};

pub(super) type BinaryRow = (&'static str, Binary, fn(f64, f64) -> f64);

#[rustfmt::skip]
pub(super) const BINARY: &[BinaryRow] = &[
    ("atan2", Binary::Atan2, f64::atan2),
    ("hypot", Binary::Hypot, f64::hypot),
    ("powf",  Binary::Powf,  f64::powf),
    ("over_root", Binary::OverRoot, over_root),
    ("over_squares", Binary::OverSquares, over_squares),
];

fn over_root(w: f64, root: f64) -> f64 {
    if root <= 0.0 { 0.0 * w } else { w / root }
}

fn over_squares(u: f64, w: f64) -> f64 {
    let (less, more) = if u.abs() < w.abs() { (u, w) } else { (w, u) };
    let quotient = less / more;
    (if u.abs() < w.abs() { quotient } else { 1.0 }) / (more + less * quotient)
}

/// The rows are in the order of the variants.
fn binary_row(function: Binary) -> &'static BinaryRow {
    &BINARY[function as usize]
}

pub(super) fn evaluate_binary(function: Binary, a: f64, b: f64) -> f64 {
    let (_, _, value) = binary_row(function);
    value(a, b)
}

pub(crate) fn binary_by_name(name: &str) -> Option<Binary> {
    written().find(|(known, ..)| *known == name).map(|(_, function, _)| *function)
}

/// Those that a formula may use.
fn written() -> impl Iterator<Item = &'static BinaryRow> {
    BINARY.iter().filter(|(_, function, _)| !matches!(function, Binary::OverRoot | Binary::OverSquares))
}

/// Their names, in the order of the table.
pub(crate) fn binary_names() -> impl Iterator<Item = &'static str> {
    written().map(|(name, ..)| *name)
}

impl Binary {
    pub(crate) fn name(self) -> &'static str {
        binary_row(self).0
    }
}

impl Graph {
    /// (1/u)' along `by`, where `f` is the node 1/u: −f²·u', and −n·f·tanh s·s' for u = coshⁿ s, since
    /// sinh s overflows where f is 0. Where u grows fast f² is 0 long before u·f' is, and it is −f·(f·u').
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
        if self.grows_fast(u) {
            // Where u has overflowed, 1/u is 0 and does not change; u' may have overflowed too.
            let relative = self.multiply(f.into(), tangent.node.into());
            let relative = self.where_finite(relative);
            return self.multiply(f.into(), relative).scaled(-tangent.scale);
        }
        let square = self.power(f.into(), 2);
        self.multiply(square, tangent).negated()
    }

    /// Whether it overflows at moderate arguments.
    pub(super) fn grows_fast(&self, id: Id) -> bool {
        self.depends(
            id,
            |node| matches!(node, Node::Unary(function, _) if function.has(Property::GrowsFast)),
        )
    }

    /// (∂f/∂a, ∂f/∂b), where `f` is the node f(a, b) itself.
    pub(super) fn binary_derivatives(&mut self, function: Binary, a: Expr, b: Expr, f: Expr) -> [Expr; 2] {
        match function {
            Binary::Atan2 => {
                let [along, across] = [(b, a), (a, b)].map(|(u, w)| self.binary(Binary::OverSquares, u, w));
                [along, across.negated()]
            }
            Binary::Hypot => {
                let over = self.reciprocal(f);
                [self.multiply(a, over), self.multiply(b, over)]
            }
            Binary::Powf => {
                let less = self.subtract(b, Expr::ONE);
                let power = self.binary(Binary::Powf, a, less);
                let logarithm = self.unary(Unary::Ln, a);
                let mut slope = self.multiply(b, power);
                if !self.depends(b.node, Node::varies) {
                    // a⁰ does not change with a, not even where a⁻¹ is no number.
                    let squared = self.power(b, 2);
                    slope = self.where_asked(squared, slope);
                }
                // Where a and f are 0 the logarithm is infinite, and the product has the limit 0, which f
                // is.
                let [size, of_base] = [f, a].map(|of| self.unary(Unary::Abs, of));
                let (sizes, product) = (self.add(size, of_base), self.multiply(f, logarithm));
                [slope, self.choose(sizes, Relation::HasMore, Expr::ZERO, product, f)]
            }
            Binary::OverRoot => {
                let over = self.reciprocal(b);
                [over, self.multiply(f, over).negated()]
            }
            Binary::OverSquares => {
                // f = u/(u² + w²) and g = w/(u² + w²): g² − f² and −2fg.
                let g = self.binary(Binary::OverSquares, b, a);
                let (less, more) = (self.subtract(g, f), self.add(g, f));
                [self.multiply(less, more), self.multiply(f, g).scaled(-2.0)]
            }
        }
    }
}
