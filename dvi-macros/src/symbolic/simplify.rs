//! Simplification at construction: the only way to make a node is through these rules.
//!
//! Floating-point policy. The identities hold exactly for finite operands, or cost at most one
//! rounding of a literal factor: 0·x = 0, x − x = 0, like terms are collected, literal factors are
//! multiplied together, odd and even functions take their sign outside. Factors of a product are
//! associative and commutative here (the order of evaluation is chosen by the compiler); sums keep the
//! grouping in which they were written. Nothing is distributed over a sum, x/x is not cancelled, and
//! no multiplication is fused with an addition. Each rule goes one way, and the right side never costs
//! more than the left.

use super::functions::Unary;
use super::graph::{Binary, Expr, Fold, Graph, Id, Node, Relation};
use super::index::{Atom, Index, Range};
use super::partial::Partial;
use super::rules;
use crate::internal::internal;

/// A product of more factors than this is one factor of other products. The derivative of a function of
/// a function of … is a product of as many factors as there are functions, and its own derivative a sum of
/// that many such products: written out they grow with the cube of the depth, as factors linearly.
const MOST_FACTORS: usize = 12;

/// Literal factors of powers beyond this size stay with their base: x⁶⁰/a⁶⁰ is no number where (x/a)⁶⁰ is.
const LARGEST_POWER: f64 = 1e100;

/// From this exponent on 1/uⁿ is (1/u)ⁿ, of whose derivatives fewer leave the range of numbers: squares of
/// 1/uⁿ are 1/u²ⁿ.
pub(super) const HIGH: u32 = 5;

/// The exponent as `powi` takes it.
fn signed_exponent(exponent: u32) -> i32 {
    whole(i32::try_from(exponent).ok())
}

/// Exponents add and multiply in 32 bits: no power of a user comes near the end of them.
fn whole<N>(exponent: Option<N>) -> N {
    exponent.unwrap_or_else(|| internal("an exponent has more than 31 bits"))
}

impl Graph {
    /// a + b + …: constants and like terms collect, and a positive factor common to all terms goes out. The
    /// signs stay where they were written, because the sign of a zero is that of the sum as it stands.
    pub(crate) fn sum(&mut self, terms: &[Expr]) -> Expr {
        let collected = collected(terms);
        if collected.len() < 2 {
            return collected.first().copied().unwrap_or(Expr::ZERO);
        }
        let factor = common_factor(&collected).abs();
        let node = self.intern(Node::Sum(divided(&collected, factor)));
        self.unsigned_sums.remove(&node);
        Expr { scale: factor, node }
    }

    /// A sum that a derivative produced: nobody wrote its signs, so all of them may go out, and do where the
    /// sum of the opposite signs is known already.
    pub(super) fn unsigned_sum(&mut self, terms: &[Expr]) -> Expr {
        let collected = collected(terms);
        if collected.len() < 2 {
            return collected.first().copied().unwrap_or(Expr::ZERO);
        }
        let factor = common_factor(&collected);
        let [kept, opposite] = [factor, -factor].map(|factor| Node::Sum(divided(&collected, factor)));
        if let Some(node) = self.find(&opposite) {
            return Expr { scale: -factor, node };
        }
        let is_new = self.find(&kept).is_none();
        let node = self.intern(kept);
        if is_new {
            self.unsigned_sums.insert(node);
        }
        Expr { scale: factor, node }
    }

    pub(crate) fn add(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum(&[a, b])
    }

    pub(crate) fn subtract(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum(&[a, b.negated()])
    }

    /// a · b · …: factors merge into powers, literal factors multiply.
    pub(crate) fn product(&mut self, factors: &[Expr]) -> Expr {
        let mut scale = 1.0;
        let mut collected: Vec<(Id, u32)> = Vec::new();
        let mut insert =
            |factor: Id, exponent: u32| match collected.iter_mut().find(|(known, _)| *known == factor) {
                Some((_, known)) => *known = whole(known.checked_add(exponent)),
                None => collected.push((factor, exponent)),
            };
        for factor in factors {
            let factor =
                if leaves_range(scale, factor.scale) { self.parenthesised(*factor) } else { *factor };
            scale *= factor.scale;
            match self.node(factor.node) {
                Node::One => {}
                Node::Product(inner) if inner.len() <= MOST_FACTORS => {
                    inner.iter().for_each(|(id, exponent)| insert(*id, *exponent));
                }
                _ => insert(factor.node, 1),
            }
        }
        if scale == 0.0 {
            return Expr::ZERO;
        }
        self.drop_signs(&mut collected);
        collected.sort_unstable();
        let node = match collected.as_slice() {
            [] => Self::ONE,
            [(single, 1)] => *single,
            _ => self.intern(Node::Product(collected)),
        };
        Expr { scale, node }
    }

    /// The square of a sign is 1: at 0 too, where |x|² has the second derivative 2.
    fn drop_signs(&self, factors: &mut Vec<(Id, u32)>) {
        for (id, exponent) in factors.iter_mut() {
            if matches!(self.node(*id), Node::Unary(Unary::Sign, _)) {
                *exponent %= 2;
            }
        }
        factors.retain(|(_, exponent)| *exponent > 0);
    }

    pub(crate) fn multiply(&mut self, a: Expr, b: Expr) -> Expr {
        self.product(&[a, b])
    }

    /// An expression as one factor, its literal factor inside: a sum of one term.
    fn parenthesised(&mut self, of: Expr) -> Expr {
        self.intern(Node::Sum(vec![of])).into()
    }

    /// 1/(c·x) = (1/c)·(1/x), 1/(1/x) = x, and 1/xⁿ = (1/x)ⁿ for high powers.
    pub(crate) fn reciprocal(&mut self, of: Expr) -> Expr {
        let scale = 1.0 / of.scale;
        match self.node(of.node) {
            Node::One => Expr::number(scale),
            _ if of.scale != 0.0 && !scale.is_normal() => {
                let of = self.parenthesised(of);
                self.reciprocal(of)
            }
            Node::Reciprocal(inner) => Expr { scale, node: *inner },
            _ => match *self.factors(of.node).as_slice() {
                [(base, exponent @ HIGH..)] => {
                    let reciprocal = self.reciprocal(base.into());
                    self.power(reciprocal, exponent).scaled(scale)
                }
                _ => Expr { scale, node: self.intern(Node::Reciprocal(of.node)) },
            },
        }
    }

    pub(crate) fn divide(&mut self, a: Expr, b: Expr) -> Expr {
        if let (Some(a), Some(b)) = (a.as_number(), b.as_number()) {
            return Expr::number(a / b);
        }
        let reciprocal = self.reciprocal(b);
        self.multiply(a, reciprocal)
    }

    pub(crate) fn power(&mut self, base: Expr, exponent: u32) -> Expr {
        let scale = base.scale.powi(signed_exponent(exponent));
        let is_large = !(LARGEST_POWER.recip()..=LARGEST_POWER).contains(&scale.abs());
        let node = match self.node(base.node) {
            Node::One => return Expr::number(scale),
            _ if exponent == 0 => return Expr::ONE,
            _ if exponent == 1 => base.node,
            _ if is_large => {
                let base = self.parenthesised(base);
                return self.power(base, exponent);
            }
            _ => {
                let factors = self.factors(base.node);
                let powers = factors.iter().map(|(id, known)| (*id, whole(known.checked_mul(exponent))));
                let mut powers: Vec<(Id, u32)> = powers.collect();
                self.drop_signs(&mut powers);
                match powers.as_slice() {
                    [] => Self::ONE,
                    [(single, 1)] => *single,
                    _ => self.intern(Node::Product(powers)),
                }
            }
        };
        Expr { scale, node }
    }

    /// x⁻ⁿ = 1/xⁿ.
    pub(crate) fn powi(&mut self, base: Expr, exponent: i32) -> Expr {
        let power = self.power(base, exponent.unsigned_abs());
        if exponent < 0 { self.reciprocal(power) } else { power }
    }

    /// f(−x) = ±f(x) for odd and even f; a literal argument gives a literal.
    pub(crate) fn unary(&mut self, function: Unary, of: Expr) -> Expr {
        if let Some(value) = of.as_number() {
            return Expr::number(function.evaluate(value));
        }
        if function == Unary::Sqrt
            && let Some(root) = self.root_of_square(of)
        {
            return root;
        }
        let sign = if of.scale < 0.0 { function.parity() } else { None };
        match sign {
            Some(sign) => {
                let node = self.intern(Node::Unary(function, of.negated()));
                Expr::from(node).scaled(sign)
            }
            None => self.intern(Node::Unary(function, of)).into(),
        }
    }

    /// An integer power is a product, a half-integer power of what is no root a product and a square root.
    pub(crate) fn binary(&mut self, function: Binary, a: Expr, b: Expr) -> Expr {
        if let (Some(a), Some(b)) = (a.as_number(), b.as_number()) {
            return Expr::number(rules::evaluate_binary(function, a, b));
        }
        match (function, b.as_number()) {
            (Binary::OverSquares, _) if a.is_zero() => Expr::ZERO,
            (Binary::Powf, Some(exponent))
                if exponent.abs() <= 64.0
                    && (2.0 * exponent).fract() == 0.0
                    && (exponent.fract() == 0.0 || self.root(a.node).is_none()) =>
            {
                // Both casts are exact: small integers.
                let whole = self.power(a, exponent.abs().trunc() as u32);
                let magnitude = if exponent.fract() == 0.0 {
                    whole
                } else {
                    let root = self.unary(Unary::Sqrt, a);
                    self.multiply(whole, root)
                };
                if exponent < 0.0 { self.reciprocal(magnitude) } else { magnitude }
            }
            _ => self.intern(Node::Binary(function, a, b)).into(),
        }
    }

    pub(crate) fn call(&mut self, function: u32, order: u32, of: Expr) -> Expr {
        self.intern(Node::Call(function, order, of)).into()
    }

    pub(crate) fn scalar_field(&mut self, field: u32, partial: Partial, at: Vec<Expr>) -> Expr {
        self.intern(Node::ScalarField(field, partial, at)).into()
    }

    /// Both branches alike: no choice.
    pub(crate) fn choose(
        &mut self,
        left: Expr,
        relation: Relation,
        right: Expr,
        then: Expr,
        otherwise: Expr,
    ) -> Expr {
        if then == otherwise {
            return then;
        }
        self.intern(Node::Choose { left, relation, right, then, otherwise }).into()
    }

    /// The sum or product over `range` of a body whose index is called `index`; Σ c·f = c·Σ f for a
    /// literal c.
    pub(crate) fn fold(&mut self, fold: Fold, index: Atom, range: Range, body: Expr) -> Expr {
        match fold {
            Fold::Sum if body.is_zero() || range.is_empty() => return Expr::ZERO,
            Fold::Product if body == Expr::ONE || range.is_empty() => return Expr::ONE,
            Fold::Sum | Fold::Product => {}
        }
        let (height, body) = self.closed(&index, body);
        let (scale, body) = match fold {
            Fold::Sum => (body.scale, body.node.into()),
            Fold::Product => (1.0, body),
        };
        Expr { scale, node: self.intern(Node::Reduce { fold, height, range, body }) }
    }

    /// An index as a number.
    pub(crate) fn count(&mut self, index: Index) -> Expr {
        match index.as_literal() {
            Some(value) => Expr::number(value as f64),
            None => self.intern(Node::Count(index)).into(),
        }
    }

    pub(crate) fn factors(&self, node: Id) -> Vec<(Id, u32)> {
        match self.node(node) {
            Node::One => Vec::new(),
            Node::Product(factors) => factors.clone(),
            _ => vec![(node, 1)],
        }
    }
}

/// Whether the product of two literals is beyond the range of numbers, or has lost digits at its end.
fn leaves_range(a: f64, b: f64) -> bool {
    a.is_normal() && b.is_normal() && !(a * b).is_normal()
}

/// Terms of distinct nodes, in id order.
fn collected(terms: &[Expr]) -> Vec<Expr> {
    let mut collected: Vec<Expr> = Vec::with_capacity(terms.len());
    for term in terms.iter().filter(|term| !term.is_zero()) {
        match collected.iter_mut().find(|known| known.node == term.node) {
            Some(known) => known.scale += term.scale,
            None => collected.push(*term),
        }
    }
    collected.retain(|term| term.scale != 0.0);
    collected.sort_by_key(|term| term.node);
    collected
}

fn divided(terms: &[Expr], factor: f64) -> Vec<Expr> {
    terms.iter().map(|term| Expr { scale: term.scale / factor, node: term.node }).collect()
}

/// The sign of the first term that is not the constant, times the magnitude where all terms share it
/// or where it is a power of two, which divides exactly; of moderate size, so that nothing overflows.
fn common_factor(terms: &[Expr]) -> f64 {
    const MODERATE: std::ops::RangeInclusive<f64> = 1e-30..=1e30;
    let leading = terms.iter().find(|term| term.node != Graph::ONE).map_or(1.0, |term| term.scale);
    let magnitude = leading.abs();
    let shared = terms.iter().all(|term| term.scale.abs() == magnitude);
    let power_of_two = magnitude.to_bits() & ((1 << 52) - 1) == 0;
    let divides = MODERATE.contains(&magnitude) && (shared || power_of_two);
    if divides { magnitude.copysign(leading) } else { leading.signum() }
}
