//! Antiderivatives, term by term.
//!
//! A sum is integrated term by term and a product by one of these rules, in this order: what does not
//! depend on the variable is a factor; f(w)·w' is integrated in w, where w may be linear in the variable;
//! u·f(u) by parts; and a product with a sum in it is multiplied out. Where no rule applies there is no
//! answer. Whoever asks differentiates the answer again: the entries of an array are taken for independent
//! of each other here, though two of them may be the same.

use super::functions::Unary;
use super::graph::{Binary, Expr, Fold, Graph, Id, Node};
use super::index::Atom;

/// So many rules may be applied inside of one another, and so many in all.
const DEEPEST: u32 = 12;
const MOST_RULES: u32 = 200;
/// Higher powers are not integrated by parts.
const HIGHEST_POWER: i32 = 8;

/// What may stand between f and its argument w in f(w): a power, or a function with an exponent.
#[derive(Clone, Copy)]
enum Outer {
    Power(f64),
    Function(Unary, i32),
    /// A derivative of the user's function, by its number and order.
    Own(u32, u32),
}

/// What is asked of an antiderivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms<'a> {
    /// What is positive where the formulas have a value, as they take its logarithm or its root.
    pub(crate) positive: &'a [Id],
    /// Whether parameters may stand in new denominators: where they are zero, the antiderivative is no
    /// number.
    pub(crate) may_divide: bool,
    /// There is no answer once the graph has come to this node.
    pub(crate) last: Id,
}

struct Integral<'a> {
    graph: &'a mut Graph,
    by: Id,
    terms: Terms<'a>,
    depth: u32,
    rules: u32,
}

impl Graph {
    /// A function whose derivative along the node `by` is `of`.
    pub(crate) fn antiderivative(&mut self, of: Expr, by: Id, terms: Terms<'_>) -> Option<Expr> {
        Integral { graph: self, by, terms, depth: 0, rules: 0 }.of(of)
    }
}

impl Integral<'_> {
    fn depends(&self, id: Id) -> bool {
        self.graph.depends_on(id, self.by)
    }

    fn of(&mut self, of: Expr) -> Option<Expr> {
        let is_long = self.rules == MOST_RULES || self.graph.next() > self.terms.last;
        if self.depth == DEEPEST || is_long {
            return None;
        }
        self.rules += 1;
        self.depth += 1;
        let integral = self.of_node(of.node).map(|integral| integral.scaled(of.scale));
        self.depth -= 1;
        integral
    }

    fn of_node(&mut self, of: Id) -> Option<Expr> {
        if !self.depends(of) {
            return Some(self.graph.multiply(of.into(), self.by.into()));
        }
        match self.graph.node(of).clone() {
            Node::Sum(terms) => {
                let integrals = terms.into_iter().map(|term| self.of(term)).collect::<Option<Vec<_>>>()?;
                Some(self.graph.sum(&integrals))
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let decides = [left, right].iter().any(|side| self.depends(side.node));
                let (then, otherwise) = (self.of(then)?, self.of(otherwise)?);
                (!decides).then(|| self.graph.choose(left, relation, right, then, otherwise))
            }
            Node::Reduce { fold: Fold::Sum, height, range, body } => {
                let depth = self.graph.free(of).depth().max(self.graph.free(self.by).depth());
                let inner = self.graph.opened(height, body, depth);
                let integral = self.of(inner)?;
                Some(self.graph.fold(Fold::Sum, Atom::Open(depth), range, integral))
            }
            _ => self.of_product(of),
        }
    }

    fn of_product(&mut self, of: Id) -> Option<Expr> {
        let factors = self.graph.quotient_factors(of);
        let (varying, constant): (Vec<_>, Vec<_>) =
            factors.into_iter().partition(|(id, _)| self.depends(*id));
        self.by_substitution(&varying, &constant)
            .or_else(|| {
                let integral = self.by_parts(&varying)?;
                let constant = self.graph.monomial(&constant);
                Some(self.graph.multiply(constant, integral))
            })
            .or_else(|| {
                let expanded = self.graph.multiplied_out(&[of.into()])?;
                (expanded.node != of && matches!(self.graph.node(expanded.node), Node::Sum(_)))
                    .then(|| self.of(expanded))?
            })
    }

    /// c·∫f(w) dw where the product is c·f(w)·w' with c constant.
    fn by_substitution(&mut self, varying: &[(Id, i32)], constant: &[(Id, i32)]) -> Option<Expr> {
        for (place, factor) in varying.iter().enumerate() {
            for (outer, w, scale) in self.outers(*factor) {
                let slope = self.graph.derivative(w, self.by);
                if slope.is_zero() {
                    continue;
                }
                let mut rest = [varying, constant].concat();
                rest.remove(place);
                let rest = self.graph.monomial(&rest);
                let ratio = self.graph.divide(rest, slope);
                let Some(ratio) = self.graph.multiplied_out(&[ratio]) else { continue };
                if self.depends(ratio.node) || self.divides_by_more(ratio, constant) {
                    continue;
                }
                if let Some(integral) = self.of_outer(outer, w) {
                    return Some(self.graph.multiply(ratio, integral).scaled(scale));
                }
            }
        }
        None
    }

    /// Whether there is something in a denominator of `ratio` that stands in none of the factors: the
    /// antiderivative would be singular where the integrand is not.
    fn divides_by_more(&self, ratio: Expr, factors: &[(Id, i32)]) -> bool {
        let may_divide = self.terms.may_divide;
        let varies = |node: &Node| match node {
            Node::Parameter(_) => !may_divide,
            node => node.varies(),
        };
        let denominators = |id: Id| -> Vec<Id> {
            let below = self.graph.quotient_factors(id).into_iter().filter(|(_, exponent)| *exponent < 0);
            below.map(|(id, _)| id).collect()
        };
        let terms: Vec<Id> = match self.graph.node(ratio.node) {
            Node::Sum(terms) => terms.iter().map(|term| term.node).collect(),
            _ => vec![ratio.node],
        };
        let known: Vec<Id> =
            factors.iter().filter(|(_, exponent)| *exponent < 0).map(|(id, _)| *id).collect();
        let mut found = terms.into_iter().flat_map(denominators);
        found.any(|id| self.graph.depends(id, varies) && !known.contains(&id))
    }

    /// The ways to read a factor as scale·f(w).
    fn outers(&self, (factor, exponent): (Id, i32)) -> Vec<(Outer, Expr, f64)> {
        let power = f64::from(exponent);
        let mut found = Vec::new();
        match *self.graph.node(factor) {
            Node::Unary(function, w) => {
                let root = match function {
                    // Of c·w, a positive factor goes out.
                    Unary::Sqrt if w.scale > 0.0 => Some((power / 2.0, w.scale.powf(power / 2.0))),
                    Unary::Cbrt => Some((power / 3.0, w.scale.cbrt().powi(exponent))),
                    _ => None,
                };
                found.extend(root.map(|(p, scale)| (Outer::Power(p), w.node.into(), scale)));
                found.push((Outer::Function(function, exponent), w, 1.0));
            }
            Node::Binary(Binary::Powf, w, exponent_of) => {
                if let Some(p) = exponent_of.as_number().filter(|_| w.scale > 0.0) {
                    found.push((Outer::Power(p * power), w.node.into(), w.scale.powf(p * power)));
                }
            }
            Node::Call(function, order, w) if exponent == 1 && order > 0 => {
                found.push((Outer::Own(function, order), w, 1.0));
            }
            _ => {}
        }
        found.push((Outer::Power(power), factor.into(), 1.0));
        found
    }

    fn of_outer(&mut self, outer: Outer, w: Expr) -> Option<Expr> {
        match outer {
            Outer::Power(-1.0) => Some(self.logarithm(w)),
            Outer::Power(p) => Some(self.power(w, p + 1.0)?.scaled(1.0 / (p + 1.0))),
            Outer::Own(function, order) => Some(self.graph.call(function, order - 1, w)),
            Outer::Function(function, 1) => self.of_function(function, w),
            Outer::Function(function, exponent) => self.of_power(function, exponent, w),
        }
    }

    /// wᵖ for powers that are written with products, roots of second or third degree, or not at all
    /// otherwise.
    fn power(&mut self, w: Expr, p: f64) -> Option<Expr> {
        const MOST: f64 = 64.0;
        let is_whole = |p: f64| (p - p.round()).abs() < 1e-12 && p.abs() < MOST;
        let graph = &mut *self.graph;
        if is_whole(p) {
            return Some(graph.powi(w, p.round() as i32));
        }
        for (root, degree) in [(Unary::Sqrt, 2.0), (Unary::Cbrt, 3.0)] {
            if is_whole(degree * p) {
                let root = graph.unary(root, w);
                return Some(graph.powi(root, (degree * p).round() as i32));
            }
        }
        (p.abs() < MOST).then(|| graph.binary(Binary::Powf, w, Expr::number(p)))
    }

    /// ln w for positive w, else ½ ln w².
    fn logarithm(&mut self, w: Expr) -> Expr {
        let w = Expr::from(w.node);
        if self.terms.positive.contains(&w.node) {
            return self.graph.unary(Unary::Ln, w);
        }
        let square = self.graph.power(w, 2);
        self.graph.unary(Unary::Ln, square).scaled(0.5)
    }

    /// ∫f(w) dw
    fn of_function(&mut self, function: Unary, w: Expr) -> Option<Expr> {
        let graph = &mut *self.graph;
        let f = graph.unary(function, w);
        let product = graph.multiply(w, f);
        Some(match function {
            Unary::Exp => f,
            Unary::Exp2 => f.scaled(1.0 / std::f64::consts::LN_2),
            Unary::ExpM1 => graph.subtract(f, w),
            Unary::Sin => graph.unary(Unary::Cos, w).negated(),
            Unary::Cos => graph.unary(Unary::Sin, w),
            Unary::Sinh => graph.unary(Unary::Cosh, w),
            Unary::Cosh => graph.unary(Unary::Sinh, w),
            Unary::Tanh => {
                let cosh = graph.unary(Unary::Cosh, w);
                graph.unary(Unary::Ln, cosh)
            }
            Unary::Ln => graph.subtract(product, w),
            Unary::Log2 => graph.subtract(product, w.scaled(std::f64::consts::LOG2_E)),
            Unary::Log10 => graph.subtract(product, w.scaled(std::f64::consts::LOG10_E)),
            Unary::Ln1p => {
                let product = graph.add(product, f);
                graph.subtract(product, w)
            }
            Unary::Atan => {
                let square = graph.power(w, 2);
                let logarithm = graph.unary(Unary::Ln1p, square);
                graph.subtract(product, logarithm.scaled(0.5))
            }
            Unary::Asin | Unary::Acos => {
                let square = graph.power(w, 2);
                let radicand = graph.subtract(Expr::ONE, square);
                let root = graph.unary(Unary::Sqrt, radicand);
                graph.add(product, root.scaled(if function == Unary::Asin { 1.0 } else { -1.0 }))
            }
            Unary::Asinh => {
                let root = graph.binary(Binary::Hypot, Expr::ONE, w);
                graph.subtract(product, root)
            }
            Unary::Erf => {
                let square = graph.power(w, 2);
                let bell = graph.unary(Unary::Exp, square.negated());
                graph.add(product, bell.scaled(1.0 / std::f64::consts::PI.sqrt()))
            }
            Unary::Abs => product.scaled(0.5),
            Unary::Signum => graph.unary(Unary::Abs, w),
            Unary::Sqrt
            | Unary::Cbrt
            | Unary::Tan
            | Unary::Acosh
            | Unary::Atanh
            | Unary::Sign
            | Unary::Sinc
            | Unary::Sinc1
            | Unary::Sinc2
            | Unary::Sinc3 => return None,
        })
    }

    /// ∫f(w)ⁿ dw for n other than 1.
    fn of_power(&mut self, function: Unary, exponent: i32, w: Expr) -> Option<Expr> {
        let graph = &mut *self.graph;
        Some(match (function, exponent) {
            (Unary::Exp, _) => {
                let f = graph.unary(Unary::Exp, w);
                graph.powi(f, exponent).scaled(1.0 / f64::from(exponent))
            }
            (Unary::Sin | Unary::Cos, 2) => {
                let (sin, cos) = (graph.unary(Unary::Sin, w), graph.unary(Unary::Cos, w));
                let product = graph.multiply(sin, cos);
                let product = product.scaled(if function == Unary::Sin { -1.0 } else { 1.0 });
                graph.add(w, product).scaled(0.5)
            }
            (Unary::Cos, -2) => graph.unary(Unary::Tan, w),
            (Unary::Cosh, -2) => graph.unary(Unary::Tanh, w),
            (Unary::Tan, 2) => {
                let f = graph.unary(Unary::Tan, w);
                graph.subtract(f, w)
            }
            (Unary::Tanh, 2) => {
                let f = graph.unary(Unary::Tanh, w);
                graph.subtract(w, f)
            }
            _ => return None,
        })
    }

    /// ∫uⁿ f du, from the antiderivatives of f if it stays what it is, or else from its derivative.
    fn by_parts(&mut self, varying: &[(Id, i32)]) -> Option<Expr> {
        let (powers, others): (Vec<_>, Vec<_>) = varying.iter().copied().partition(|(id, _)| *id == self.by);
        let ([(u, n @ 1..=HIGHEST_POWER)], [(f, exponent)]) = (powers.as_slice(), others.as_slice()) else {
            return None;
        };
        let f_power = self.graph.powi((*f).into(), *exponent);
        let is_logarithm =
            matches!(self.graph.node(*f), Node::Unary(Unary::Ln | Unary::Log2 | Unary::Log10, _));
        if is_logarithm {
            let power = self.graph.powi((*u).into(), n + 1).scaled(1.0 / f64::from(n + 1));
            let whole = self.graph.multiply(power, f_power);
            let slope = self.graph.derivative(f_power, self.by);
            let rest = self.graph.multiply(power, slope);
            let rest = self.graph.multiplied_out(&[rest])?;
            let rest = self.of(rest)?;
            return Some(self.graph.subtract(whole, rest));
        }
        let integral = self.of(f_power)?;
        let power = self.graph.powi((*u).into(), *n);
        let whole = self.graph.multiply(power, integral);
        let less = self.graph.powi((*u).into(), n - 1).scaled(f64::from(*n));
        let rest = self.graph.multiply(less, integral);
        let rest = self.of(rest)?;
        Some(self.graph.subtract(whole, rest))
    }
}
