//! Expressions multiplied out, to see whether they vanish.
//!
//! The simplifier distributes nothing over a sum, so (x + y)² − x² − 2xy − y² stays as it stands. Here an
//! expression becomes a Laurent polynomial in what is neither a sum nor a product, in which all of that
//! cancels. What vanishes in this form is zero wherever it is a number; the converse does not hold.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::functions::Unary;
use super::graph::{Binary, Expr, Fold, Graph, Id, Node};
use super::index::Atom;
use crate::work::step;

/// More terms than these are not multiplied out.
const MOST_TERMS: usize = 64;

/// A coefficient is zero if it is no more than this part of what it was added up from.
const ROUNDING: f64 = 1e-13;

/// Factors in id order with exponents that are not zero.
type Monomial = Vec<(Id, i32)>;

/// Each term with its coefficient and the sum of the absolute values that were added to it.
#[derive(Clone, Debug, Default)]
pub(super) struct Polynomial(BTreeMap<Monomial, [f64; 2]>);

impl Polynomial {
    fn term(coefficient: f64, monomial: Monomial) -> Self {
        Self(BTreeMap::from([(monomial, [coefficient, coefficient.abs()])]))
    }

    fn add(&mut self, other: &Self, factor: f64) -> Option<()> {
        for (monomial, [value, size]) in &other.0 {
            let known = self.0.entry(monomial.clone()).or_default();
            known[0] += factor * value;
            known[1] += (factor * size).abs();
        }
        self.0.retain(|_, [value, size]| value.abs() > ROUNDING * *size);
        (self.0.len() <= MOST_TERMS).then_some(())
    }

    fn times(&self, other: &Self) -> Option<Self> {
        let mut product = Self::default();
        for (one, [a, _]) in &self.0 {
            for (two, [b, _]) in &other.0 {
                product.add(&Self::term(a * b, joined(one, two)), 1.0)?;
            }
        }
        Some(product)
    }
}

fn joined(one: &[(Id, i32)], two: &[(Id, i32)]) -> Monomial {
    let mut exponents: BTreeMap<Id, i32> = BTreeMap::new();
    for (id, exponent) in one.iter().chain(two) {
        *exponents.entry(*id).or_default() += exponent;
    }
    exponents.into_iter().filter(|(_, exponent)| *exponent != 0).collect()
}

impl Graph {
    /// Whether the sum of these is zero wherever it is a number, as far as multiplying out shows it, with
    /// exponents up to rounding.
    pub(crate) fn vanishes(&mut self, values: &[Expr]) -> bool {
        self.polynomial_of_sum(values, true).is_some_and(|polynomial| polynomial.0.is_empty())
    }

    /// The sum of these multiplied out, unless it is too long for that.
    pub(crate) fn multiplied_out(&mut self, values: &[Expr]) -> Option<Expr> {
        let polynomial = self.polynomial_of_sum(values, false)?;
        let terms = polynomial.0.iter();
        let terms = terms.map(|(monomial, [value, _])| self.monomial(monomial).scaled(*value));
        let terms: Vec<Expr> = terms.collect();
        Some(self.sum(&terms))
    }

    /// The factors of a node and their exponents, those of denominators negative.
    pub(super) fn quotient_factors(&self, node: Id) -> Vec<(Id, i32)> {
        let mut factors = Vec::new();
        for (factor, exponent) in self.factors(node) {
            let exponent = exponent as i32;
            match *self.node(factor) {
                Node::Reciprocal(of) => {
                    factors.extend(self.factors(of).into_iter().map(|(id, e)| (id, -exponent * e as i32)));
                }
                _ => factors.push((factor, exponent)),
            }
        }
        joined(&factors, &[])
    }

    /// The product of these powers.
    pub(super) fn monomial(&mut self, factors: &[(Id, i32)]) -> Expr {
        let powers: Vec<Expr> =
            factors.iter().map(|(id, exponent)| self.powi((*id).into(), *exponent)).collect();
        self.product(&powers)
    }

    fn polynomial_of_sum(&mut self, terms: &[Expr], loose: bool) -> Option<Polynomial> {
        let mut sum = Polynomial::default();
        for term in terms {
            let polynomial = self.polynomial_of(term.node, loose)?;
            sum.add(&polynomial, term.scale)?;
        }
        Some(sum)
    }

    /// A node is multiplied out once, wherever it stands.
    fn polynomial_of(&mut self, id: Id, loose: bool) -> Option<Rc<Polynomial>> {
        if let Some(known) = self.multiplied_out.get(&(id, loose)) {
            return known.clone();
        }
        let polynomial = self.new_polynomial_of(id, loose).map(Rc::new);
        self.multiplied_out.insert((id, loose), polynomial.clone());
        polynomial
    }

    fn new_polynomial_of(&mut self, id: Id, loose: bool) -> Option<Polynomial> {
        step();
        match self.node(id).clone() {
            Node::Sum(terms) if terms.len() > 1 => self.polynomial_of_sum(&terms, loose),
            Node::One | Node::Product(_) | Node::Reciprocal(_) => self.polynomial_of_product(id, loose),
            Node::Choose { left, relation, right, then, otherwise } => {
                // Each term stays behind the condition: elsewhere it need not be a number.
                let mut sum = Polynomial::default();
                for (branch, holds) in [(then, true), (otherwise, false)] {
                    for (monomial, [value, _]) in self.polynomial_of_sum(&[branch], loose)?.0 {
                        let term = self.monomial(&monomial);
                        let (then, otherwise) = if holds { (term, Expr::ZERO) } else { (Expr::ZERO, term) };
                        let guarded = self.choose(left, relation, right, then, otherwise);
                        sum.add(&Polynomial::term(value * guarded.scale, vec![(guarded.node, 1)]), 1.0)?;
                    }
                }
                Some(sum)
            }
            Node::Reduce { fold: Fold::Sum, height, range, body } => {
                let mut sum = Polynomial::default();
                for (monomial, [value, _]) in self.polynomial_of_sum(&[body], loose)?.0 {
                    // In a sum without terms, a factor need not be a number.
                    let stays = |(factor, _): &(Id, i32)| {
                        let changes = self.free(*factor).bound & (1 << height) != 0;
                        changes || (self.has_domain(*factor) && !range.is_filled())
                    };
                    let (inside, outside): (Monomial, Monomial) = monomial.into_iter().partition(stays);
                    let body = self.monomial(&inside);
                    let fold = self.fold(Fold::Sum, Atom::Bound(height), range.clone(), body);
                    let term = Polynomial::term(value * fold.scale, joined(&outside, &[(fold.node, 1)]));
                    sum.add(&term, 1.0)?;
                }
                Some(sum)
            }
            _ => {
                let other = self.in_other_functions(id, 1, loose);
                other.or_else(|| Some(Polynomial::term(1.0, vec![(id, 1)])))
            }
        }
    }

    fn polynomial_of_product(&mut self, id: Id, loose: bool) -> Option<Polynomial> {
        let mut product = Polynomial::term(1.0, Vec::new());
        for (factor, exponent) in self.without_squared_roots(id) {
            let one = Polynomial::term(1.0, vec![(factor.node, exponent)]);
            let power = match self.node(factor.node) {
                // One term is one factor, lest the power of its literal leave the range of numbers.
                Node::Sum(terms) if terms.len() == 1 => None,
                Node::Sum(_) | Node::Reduce { fold: Fold::Sum, .. } if exponent > 0 => {
                    self.polynomial_of_power(factor.node, exponent, loose)
                }
                _ => self.in_other_functions(factor.node, exponent, loose),
            };
            // What is too long stays one factor.
            product = match power.and_then(|power| product.times(&power)) {
                Some(product) => product,
                None => product.times(&one)?,
            };
            product = product.times(&Polynomial::term(factor.scale.powi(exponent), Vec::new()))?;
        }
        Some(product)
    }

    fn polynomial_of_power(&mut self, base: Id, exponent: i32, loose: bool) -> Option<Polynomial> {
        let base = self.polynomial_of(base, loose)?;
        (1..exponent).try_fold((*base).clone(), |power, _| power.times(&base))
    }

    /// A derivative of `atan2` as the quotient that it is; loosely also tanh as sinh/cosh, and a power with
    /// a broken exponent as a whole power times one with an exponent below 1, rounded.
    fn in_other_functions(&mut self, factor: Id, exponent: i32, loose: bool) -> Option<Polynomial> {
        /// Of exponents, 40 bits are compared.
        const GRID: f64 = (1_u64 << 40) as f64;
        match *self.node(factor) {
            Node::Binary(Binary::OverSquares, u, w) => {
                let [square, other] = [u, w].map(|of| self.power(of, 2));
                let squares = self.add(square, other);
                let quotient = self.divide(u, squares);
                let power = self.powi(quotient, exponent);
                self.polynomial_of(power.node, loose)?.times(&Polynomial::term(power.scale, Vec::new()))
            }
            Node::Unary(Unary::Tanh, w) if loose => {
                let [sinh, cosh] = [Unary::Sinh, Unary::Cosh].map(|function| self.unary(function, w));
                let factors = joined(&[(sinh.node, exponent)], &[(cosh.node, -exponent)]);
                Some(Polynomial::term(sinh.scale.powi(exponent), factors))
            }
            Node::Binary(Binary::Powf, w, power) if loose && w.scale == 1.0 => {
                let power = (power.as_number()? * GRID).round() / GRID;
                let whole = power.floor();
                let broken = self.binary(Binary::Powf, w, Expr::number(power - whole));
                let factors = joined(&[(broken.node, exponent)], &[(w.node, exponent * whole as i32)]);
                Some(Polynomial::term(broken.scale.powi(exponent), factors))
            }
            _ => None,
        }
    }

    /// The factors of a quotient, with w in place of (√w)².
    fn without_squared_roots(&self, id: Id) -> Vec<(Expr, i32)> {
        let mut factors: Vec<(Expr, i32)> = Vec::new();
        let mut insert =
            |factor: Expr, exponent: i32| match factors.iter_mut().find(|(known, _)| *known == factor) {
                Some((_, known)) => *known += exponent,
                None => factors.push((factor, exponent)),
            };
        for (factor, exponent) in self.quotient_factors(id) {
            match *self.node(factor) {
                Node::Unary(Unary::Sqrt, of) if exponent.abs() > 1 => {
                    insert(of, exponent / 2);
                    insert(factor.into(), exponent % 2);
                }
                _ => insert(factor.into(), exponent),
            }
        }
        factors.retain(|(_, exponent)| *exponent != 0);
        factors
    }
}
