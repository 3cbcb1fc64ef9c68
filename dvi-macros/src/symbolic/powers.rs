//! Products that are differentiated as what they are: powers of a root, and limits of 0/0.
//!
//! The product rule, factor by factor, differentiates u·√u to √u·u' + u·u'/(2√u), which is 0/0 at u = 0
//! where the derivative is 0; and it differentiates (1 − u)(1 + u) to (1 − u) − (1 + u), which loses the
//! digits of a small u. [`Graph::parts`] takes such factors together:
//!
//! | factors | derivative |
//! |---|---|
//! | uᵐ·√uᵏ, m ≥ 1 | (m + k/2)·uᵐ⁻¹·√uᵏ·u' |
//! | Rᵏ, k ≥ 2, R = √u or √(a² + b²) | (k/2)·Rᵏ⁻²·(R²)' |
//! | cᵏ, k ≥ 3, c = ∛u | (k/3)·cᵏ⁻³·u' |
//! | w·(1/R), R = √(w² + b²) | (b/R)·((b/R)·w' − (w/R)·b')/R |
//! | (s + c)ᵉ·(s − c)ᵉ | 2e·((s + c)(s − c))ᵉ⁻¹·s·s' |
//!
//! What stands beside a root is in [`limits`](super::limits).

use super::functions::Unary;
use super::graph::{Binary, Expr, Graph, Id, Node};
use crate::internal::internal;

/// Factors that belong together.
pub(super) struct Part {
    pub(super) factors: Vec<(Id, u32)>,
    /// The derivative of their product.
    pub(super) derivative: Expr,
}

/// A node whose square is smooth where it is not: √u, or √(a² + b²).
#[derive(Clone, Copy)]
pub(super) enum Root {
    Sqrt(Expr),
    Hypot(Expr, Expr),
}

fn multiplicity(factors: &[(Id, u32)], of: Id) -> u32 {
    factors.iter().find(|(id, _)| *id == of).map_or(0, |(_, exponent)| *exponent)
}

/// Takes `exponent` of the factor `of` away.
pub(super) fn take(factors: &mut Vec<(Id, u32)>, of: Id, exponent: u32) {
    for (id, left) in factors.iter_mut() {
        if *id == of {
            let rest = left.checked_sub(exponent);
            *left = rest.unwrap_or_else(|| internal("a factor is taken out more often than it is there"));
        }
    }
    factors.retain(|(_, left)| *left > 0);
}

impl Graph {
    /// The derivative of a product along `by`, times the factors `beside` it: the sum over its parts of (the
    /// derivative of the part)·(the others).
    pub(super) fn product_derivative(
        &mut self,
        factors: &[(Id, u32)],
        beside: &[(Id, u32)],
        by: Id,
    ) -> Expr {
        let parts = self.parts(factors, by);
        let mut terms = Vec::new();
        for (position, part) in parts.iter().enumerate().filter(|(_, part)| !part.derivative.is_zero()) {
            let others = parts.iter().enumerate().filter(|(other, _)| *other != position);
            let mut others: Vec<(Id, u32)> =
                others.flat_map(|(_, part)| part.factors.iter().copied()).collect();
            for (id, exponent) in beside {
                match others.iter_mut().find(|(known, _)| known == id) {
                    Some((_, sum)) => *sum += exponent,
                    None => others.push((*id, *exponent)),
                }
            }
            let derivative = self.limit(part, &mut others, by).unwrap_or(part.derivative);
            let mut term = vec![derivative];
            term.extend(others.iter().map(|(factor, exponent)| self.power((*factor).into(), *exponent)));
            terms.push(self.product(&term));
        }
        self.factored_sum(&terms)
    }

    fn parts(&mut self, factors: &[(Id, u32)], by: Id) -> Vec<Part> {
        let mut left = factors.to_vec();
        let mut parts = Vec::new();
        for (factor, exponent) in factors {
            let part = self.power_of_root(*factor, *exponent, &left, by);
            let part = part.or_else(|| self.power_of_cube_root(*factor, *exponent, &left, by));
            let part = part.or_else(|| self.transverse(*factor, &left, by));
            let part = part.or_else(|| self.difference_of_squares(*factor, *exponent, &left, by));
            if let Some(part) = part {
                part.factors.iter().for_each(|(id, exponent)| take(&mut left, *id, *exponent));
                parts.push(part);
            }
        }
        for (factor, exponent) in left {
            let tangent = self.node_derivative(factor, by);
            let derivative = if tangent.is_zero() {
                Expr::ZERO
            } else {
                let power = self.power(factor.into(), exponent - 1);
                self.multiply(power, tangent).scaled(f64::from(exponent))
            };
            parts.push(Part { factors: vec![(factor, exponent)], derivative });
        }
        parts
    }

    pub(super) fn root(&self, node: Id) -> Option<Root> {
        match self.node(node) {
            Node::Unary(Unary::Sqrt, u) => Some(Root::Sqrt(*u)),
            Node::Binary(Binary::Hypot, a, b) => Some(Root::Hypot(*a, *b)),
            _ => None,
        }
    }

    /// (R²)'/2
    pub(super) fn half_of_square(&mut self, root: Root, by: Id) -> Expr {
        match root {
            Root::Sqrt(u) => self.derivative(u, by).scaled(0.5),
            Root::Hypot(a, b) => {
                let (along_a, along_b) = (self.derivative(a, by), self.derivative(b, by));
                let terms = [self.multiply(a, along_a), self.multiply(b, along_b)];
                self.factored_sum(&terms)
            }
        }
    }

    /// Rᵏ with the powers of R² beside it.
    fn power_of_root(&mut self, node: Id, k: u32, factors: &[(Id, u32)], by: Id) -> Option<Part> {
        if multiplicity(factors, node) != k {
            return None;
        }
        let root = self.root(node)?;
        let radicand = match root {
            Root::Sqrt(u) => self.factors(u.node),
            Root::Hypot(..) => Vec::new(),
        };
        let whole = radicand.iter().map(|(id, exponent)| multiplicity(factors, *id) / exponent).min();
        let m = whole.unwrap_or(0);
        if m == 0 && k == 1 {
            return None;
        }
        let half = self.half_of_square(root, by);
        let taken: Vec<(Id, u32)> = radicand.iter().map(|(id, exponent)| (*id, exponent * m)).collect();
        let derivative = match root {
            Root::Sqrt(u) if m > 0 => {
                let (whole, roots) = (self.power(u.node.into(), m - 1), self.power(node.into(), k));
                // u = scale·node, and (R²)'/2 = scale·node'/2.
                self.product(&[whole, roots, half]).scaled(f64::from(2 * m + k) / u.scale)
            }
            _ => {
                let roots = self.power(node.into(), k - 2);
                self.multiply(roots, half).scaled(f64::from(k))
            }
        };
        let factors = taken.into_iter().filter(|(_, exponent)| *exponent > 0).chain([(node, k)]).collect();
        Some(Part { factors, derivative })
    }

    fn power_of_cube_root(&mut self, node: Id, k: u32, factors: &[(Id, u32)], by: Id) -> Option<Part> {
        let Node::Unary(Unary::Cbrt, u) = *self.node(node) else { return None };
        if k < 3 || multiplicity(factors, node) != k {
            return None;
        }
        let (rest, tangent) = (self.power(node.into(), k - 3), self.derivative(u, by));
        let derivative = self.multiply(rest, tangent).scaled(f64::from(k) / 3.0);
        Some(Part { factors: vec![(node, k)], derivative })
    }

    /// a·(1/R), R = √(a² + b²), of which the product rule makes 1/R − a²/R³.
    fn transverse(&mut self, node: Id, factors: &[(Id, u32)], by: Id) -> Option<Part> {
        let Node::Reciprocal(root) = *self.node(node) else { return None };
        let Some(Root::Hypot(a, b)) = self.root(root) else { return None };
        let sides = [(a, b), (b, a)];
        let (a, b) = sides.into_iter().find(|(a, _)| multiplicity(factors, a.node) == 1)?;
        if multiplicity(factors, node) != 1 {
            return None;
        }
        let (along_a, along_b) = (self.derivative(a, by), self.derivative(b, by));
        let (cosine, sine) = (self.over_root(a, root), self.over_root(b, root));
        let (across, back) = (self.multiply(sine, along_a), self.multiply(cosine, along_b));
        let turned = self.subtract(across, back);
        let derivative = self.product(&[sine, turned, node.into()]).scaled(1.0 / a.scale);
        Some(Part { factors: vec![(a.node, 1), (node, 1)], derivative })
    }

    fn difference_of_squares(&mut self, node: Id, e: u32, factors: &[(Id, u32)], by: Id) -> Option<Part> {
        let (constant, of) = self.constant_and_term(node)?;
        // (s + c)(s − c) = s² − c² and (c + s)(c − s) = c² − s².
        let sign = |(c, term): (f64, Expr)| match (c == constant, c == -constant) {
            (_, true) if term == of => Some(1.0),
            (true, _) if term == of.negated() => Some(-1.0),
            _ => None,
        };
        let (other, sign) = factors
            .iter()
            .filter(|(_, exponent)| *exponent == e)
            .find_map(|(other, _)| Some((*other, sign(self.constant_and_term(*other)?)?)))?;
        if multiplicity(factors, node) != e {
            return None;
        }
        let tangent = self.derivative(of, by);
        let both = self.multiply(node.into(), other.into());
        let powers = self.power(both, e - 1);
        let derivative = self.product(&[powers, of, tangent]).scaled(sign * 2.0 * f64::from(e));
        Some(Part { factors: vec![(node, e), (other, e)], derivative })
    }

    /// (c, s) of a sum c + s of a literal and one term.
    fn constant_and_term(&self, node: Id) -> Option<(f64, Expr)> {
        match self.node(node) {
            Node::Sum(terms) => match terms.as_slice() {
                [constant, term] if constant.node == Self::ONE => Some((constant.scale, *term)),
                _ => None,
            },
            _ => None,
        }
    }
}
