//! Derivatives at the zeros of a root, where the rules give 0/0 and a limit exists.
//!
//! R is √u or √(a² + b²). At an inner point of its domain where R = 0, R² is smallest, so that (R²)' is 0
//! there. A factor w is *below* R where |w| ≤ C·R for some C: then w/R stays bounded, and (w/R)·(R²)' has
//! the limit 0. The quotient is taken to be 0 at R = 0 ([`Binary::OverRoot`]), which makes the product what
//! it is in the limit:
//!
//! | | derivative |
//! |---|---|
//! | w·R | of its factor R: (w/R)·(R²)'/2 |
//! | f(R) where f' is below R, such as cos R | (f'(R)/R)·(R²)'/2 |
//! | w·(R + …) | term by term |
//! | w·uᵖ, where w and u' are below √u | of its factor uᵖ: p·uᵖ·(w/√u)·(u'/√u) |
//! | w·uᵖ, p > ½, where w is below √u | of its factor uᵖ: p·uᵖ⁻¹ᐟ²·(w/√u)·u' |
//! | Rᵖ, p > 1; uᵖ, ½ < p < 1 | p·Rᵖ⁻¹·((R²)'/2)/R; p·uᵖ⁻¹ᐟ²·u'/√u |
//! | √(a²ᵐ·b²ⁿ…) | it is \|a\|ᵐ·\|b\|ⁿ…, whose derivative at 0 is 0 |

use rustc_hash::FxHashMap as HashMap;

use super::functions::{Property, Unary};
use super::graph::{Binary, Coordinate, Expr, Fold, Graph, Id, Node, Relation};
use super::index::{Atom, Index, Range};
use super::powers::{Part, Root, take};
use crate::work::step;

impl Graph {
    /// The derivative of `part` with a factor of the others taken in.
    pub(super) fn limit(&mut self, part: &Part, others: &mut Vec<(Id, u32)>, by: Id) -> Option<Expr> {
        let [(node, 1)] = *part.factors.as_slice() else { return None };
        if let Some(root) = self.root(node) {
            let (w, _) = others.iter().copied().find(|(w, _)| self.is_below(*w, root))?;
            take(others, w, 1);
            let half = self.half_of_square(root, by);
            let quotient = self.over_root(w.into(), node);
            return Some(self.multiply(quotient, half));
        }
        if let Node::Sum(terms) = self.node(node).clone() {
            return self.limit_of_sum(&terms, others, by);
        }
        let Node::Binary(Binary::Powf, u, exponent) = *self.node(node) else { return None };
        let p = exponent.as_number().filter(|p| *p > 0.0)?;
        // Of uᵖ and of Rᵖ: p·f·(w/R)·(u'/R) with R = √u, and p·f·(w/R)·((R²)'/2)/R.
        let base = self.root(u.node);
        let (root, slope) = match base {
            Some(root) => (root, self.half_of_square(root, by)),
            None => (Root::Sqrt(u), self.derivative(u, by)),
        };
        let (w, _) = others.iter().copied().find(|(w, _)| self.is_below(*w, root))?;
        if !self.is_below(slope.node, root) {
            if base.is_some() || p < 0.5 {
                return None;
            }
            // p·uᵖ⁻¹ᐟ²·(w/√u)·u'
            take(others, w, 1);
            let (rest, length) =
                (self.binary(Binary::Powf, u, Expr::number(p - 0.5)), self.unary(Unary::Sqrt, u));
            let quotient = self.quotient(w.into(), length);
            return Some(self.product(&[rest, quotient, slope]).scaled(p));
        }
        take(others, w, 1);
        let length = if base.is_some() { u.node.into() } else { self.unary(Unary::Sqrt, u) };
        let quotients = [w.into(), slope].map(|w: Expr| self.quotient(w, length));
        Some(self.product(&[node.into(), quotients[0], quotients[1]]).scaled(p))
    }

    /// The derivative of a sum with all of `others` taken in, term by term, if one is below a root in a
    /// term.
    fn limit_of_sum(&mut self, terms: &[Expr], others: &mut Vec<(Id, u32)>, by: Id) -> Option<Expr> {
        let beside = others.clone();
        let is_beside_root = |factor: &(Id, u32)| {
            let root = match *self.node(factor.0) {
                Node::Binary(Binary::Powf, u, _) => Some(Root::Sqrt(u)),
                _ => self.root(factor.0),
            };
            root.is_some_and(|root| beside.iter().any(|(w, _)| self.is_below(*w, root)))
        };
        if !terms.iter().any(|term| self.factors(term.node).iter().any(is_beside_root)) {
            return None;
        }
        others.clear();
        let tangents: Vec<Expr> = terms
            .iter()
            .map(|term| self.product_derivative(&self.factors(term.node), &beside, by).scaled(term.scale))
            .collect();
        Some(self.factored_sum(&tangents))
    }

    /// The derivative of f(u) along `by`, if u is a root that f' is below; `f` is the node f(u).
    pub(super) fn function_of_root(&mut self, function: Unary, u: Expr, f: Id, by: Id) -> Option<Expr> {
        let root = self.root(u.node)?;
        let slope = self.unary_derivative(function, u, f.into());
        if !self.is_below(slope.node, root) {
            return None;
        }
        let half = self.half_of_square(root, by);
        let quotient = self.over_root(slope, u.node);
        Some(self.multiply(quotient, half).scaled(u.scale))
    }

    pub(super) fn over_root(&mut self, w: Expr, root: Id) -> Expr {
        let quotient = self.binary(Binary::OverRoot, w.node.into(), root.into());
        quotient.scaled(w.scale)
    }

    /// w/`length`, 0 where that is 0.
    fn quotient(&mut self, w: Expr, length: Expr) -> Expr {
        self.over_root(w, length.node).scaled(1.0 / length.scale)
    }

    /// Whether |w| ≤ C·R near the zeros of R.
    fn is_below(&self, w: Id, root: Root) -> bool {
        self.is_below_with(w, root, &mut HashMap::default())
    }

    fn is_below_with(&self, w: Id, root: Root, known: &mut HashMap<Id, bool>) -> bool {
        step();
        if let Some(is_below) = known.get(&w) {
            return *is_below;
        }
        let mut of = |part: Id| self.is_below_with(part, root, known);
        let is_below = match self.node(w) {
            _ if self.is_part_of(w, root) => true,
            Node::Sum(terms) => terms.iter().all(|term| of(term.node)),
            Node::Product(factors) => factors.iter().any(|(factor, _)| of(*factor)),
            Node::Unary(function, argument) if function.has(Property::BelowItsArgument) => of(argument.node),
            _ => false,
        };
        known.insert(w, is_below);
        is_below
    }

    /// Whether w is R itself, or w² is a term of R²; and R² is smooth and has no term that can be negative,
    /// so that its zeros are inner points (√x is no such root, nor is √(√x² + y²): their domains end at x =
    /// 0).
    fn is_part_of(&self, w: Id, root: Root) -> bool {
        match root {
            Root::Hypot(a, b) => {
                let itself = Node::Binary(Binary::Hypot, a, b);
                let belongs = a.node == w || b.node == w || *self.node(w) == itself;
                belongs && self.is_smooth(a.node) && self.is_smooth(b.node)
            }
            Root::Sqrt(u) => {
                let itself = Node::Unary(Unary::Sqrt, u);
                let belongs =
                    *self.node(w) == itself || self.holds_square(u.node, w) || self.holds_entries(u.node, w);
                belongs && u.scale > 0.0 && self.is_never_negative(u.node) && self.is_smooth(u.node)
            }
        }
    }

    /// Whether w² is a term of a sum, or of a sum in it.
    fn holds_square(&self, of: Id, w: Id) -> bool {
        self.terms_inside(of).into_iter().any(|term| match self.node(term) {
            Node::Reduce { fold: Fold::Sum, height, range, body } => {
                let mut entries = self.terms_inside(body.node).into_iter();
                entries.any(|entry| self.is_entry(entry, w, *height, range))
            }
            _ => self.factors(term) == [(w, 2)],
        })
    }

    /// The terms of a sum, and of the sums in it.
    fn terms_inside(&self, of: Id) -> Vec<Id> {
        self.reachable_by([of], |node| match node {
            Node::Sum(terms) => terms.iter().map(|term| term.node).collect(),
            _ => Vec::new(),
        })
    }

    /// Whether a term of a sum over `range` stands for the squares of all entries of an array, of which w is
    /// one.
    fn is_entry(&self, of: Id, w: Id, height: u32, range: &Range) -> bool {
        let [(of, 2)] = *self.factors(of).as_slice() else { return false };
        let (entry, w) = match (self.node(of), self.node(w)) {
            (Node::Coordinate(entry), Node::Coordinate(w)) | (Node::Velocity(entry), Node::Velocity(w)) => {
                (entry, w)
            }
            _ => return false,
        };
        let follows = entry.index == Index::atom(Atom::Bound(height));
        entry.block == w.block && follows && self.is_whole(range, w.block)
    }

    /// Whether the squares of all entries of an array, of which w is one, are terms of a sum, one by one:
    /// `r[i]` beside the length of `r[3]`.
    fn holds_entries(&self, of: Id, w: Id) -> bool {
        let (entry, kind): (_, fn(Coordinate) -> Node) = match self.node(w) {
            Node::Coordinate(entry) => (entry, Node::Coordinate),
            Node::Velocity(entry) => (entry, Node::Velocity),
            _ => return false,
        };
        let size = self.block_sizes.get(entry.block as usize).and_then(Index::as_literal);
        let is_there = |number| {
            let other = kind(Coordinate { index: Index::literal(number), ..entry.clone() });
            self.find(&other).is_some_and(|other| self.holds_square(of, other))
        };
        size.is_some_and(|size| size > 0 && (0..size).all(is_there))
    }

    /// Whether a range runs over all entries of a block of coordinates.
    fn is_whole(&self, range: &Range, block: u32) -> bool {
        let size = self.block_sizes.get(block as usize);
        range.lower == Index::default() && Some(&range.upper) == size && range.left_out().next().is_none()
    }

    /// Whether it is made of functions that are smooth everywhere.
    fn is_smooth(&self, id: Id) -> bool {
        !self.depends(id, |node| match node {
            Node::Choose { .. } | Node::Reduce { fold: Fold::Product, .. } => true,
            node => node.has_domain(),
        })
    }

    /// The derivative of uᵖ along `by`, p a number, where it has the limit 0 at a zero of √u, or of u if
    /// that is a root itself.
    pub(super) fn power_of_square(&mut self, u: Expr, p: f64, by: Id) -> Option<Expr> {
        if let Some(root) = self.root(u.node) {
            // Rᵖ: p·Rᵖ⁻¹·((R²)'/2)/R
            let half = self.half_of_square(root, by);
            if p <= 1.0 || !self.is_below(half.node, root) {
                return None;
            }
            if p > 2.0 {
                // p·Rᵖ⁻²·(R²)'/2: u = c·R, so that uᵖ⁻² takes c² too few.
                let rest = self.binary(Binary::Powf, u, Expr::number(p - 2.0));
                return Some(self.multiply(rest, half).scaled(p * u.scale * u.scale));
            }
            let rest = self.binary(Binary::Powf, u, Expr::number(p - 1.0));
            let quotient = self.over_root(half, u.node);
            return Some(self.multiply(rest, quotient).scaled(p * u.scale));
        }
        // uᵖ: p·uᵖ⁻¹ᐟ²·u'/√u
        let (root, tangent) = (Root::Sqrt(u), self.derivative(u, by));
        if p <= 0.5 || p >= 1.0 || tangent.is_zero() || !self.is_below(tangent.node, root) {
            return None;
        }
        let length = self.unary(Unary::Sqrt, u);
        let rest = self.binary(Binary::Powf, u, Expr::number(p - 0.5));
        let quotient = self.quotient(tangent, length);
        Some(self.multiply(rest, quotient).scaled(p))
    }

    /// The derivative of f(u), where u or u' may be a sum of no terms or a branch that is zero: f does not
    /// change then, whatever its own derivative is.
    pub(super) fn unless_empty(&mut self, sums: &[Expr], derivative: Expr) -> Expr {
        if derivative.is_zero() {
            return derivative;
        }
        let sums = sums.iter().filter(|sum| !sum.is_zero());
        let counts: Vec<Expr> = sums.map(|sum| self.terms(sum.node)).collect();
        if counts.iter().any(|count| count.as_number().is_some()) {
            return derivative;
        }
        let terms = self.sum(&counts);
        self.choose(terms, Relation::HasMore, Expr::ZERO, derivative, Expr::ZERO)
    }

    /// The number of terms in a sum over indices, in the sums inside of it, and in products with such sums;
    /// a branch that is written as zero has none. They are counted once, wherever the sum stands.
    fn terms(&mut self, node: Id) -> Expr {
        step();
        if let Some(known) = self.term_counts.get(&node) {
            return *known;
        }
        let count = self.count_terms(node);
        self.term_counts.insert(node, count);
        count
    }

    fn count_terms(&mut self, node: Id) -> Expr {
        match self.node(node).clone() {
            Node::Reduce { fold: Fold::Sum, height, range, body } => {
                let depth = self.free(node).depth();
                let inner = self.opened(height, body, depth);
                let inside = self.terms(inner.node);
                if inside.as_number().is_some() && range.is_filled() {
                    return Expr::ONE;
                }
                self.fold(Fold::Sum, Atom::Open(depth), range, inside)
            }
            Node::Sum(terms) => {
                let counts: Vec<Expr> = terms.iter().map(|term| self.terms(term.node)).collect();
                match counts.iter().any(|count| count.as_number().is_some()) {
                    true => Expr::ONE,
                    false => self.sum(&counts),
                }
            }
            Node::Product(factors) => {
                let counts: Vec<Expr> = factors.iter().map(|(factor, _)| self.terms(*factor)).collect();
                self.product(&counts)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let [then, otherwise] = [then, otherwise].map(|branch| match branch.is_zero() {
                    true => Expr::ZERO,
                    false => self.terms(branch.node),
                });
                self.choose(left, relation, right, then, otherwise)
            }
            _ => Expr::ONE,
        }
    }

    /// Whether only even powers are multiplied.
    fn is_square(&self, node: Id) -> bool {
        self.factors(node).iter().all(|(_, exponent)| exponent.is_multiple_of(2))
    }

    /// √u, if u is a product of even powers.
    pub(super) fn root_of_square(&mut self, u: Expr) -> Option<Expr> {
        if u.scale <= 0.0 || u.node == Self::ONE || !self.is_square(u.node) {
            return None;
        }
        let mut factors = vec![Expr::number(u.scale.sqrt())];
        for (base, exponent) in self.factors(u.node) {
            let half = exponent / 2;
            let size = if self.is_never_negative(base) || half.is_multiple_of(2) {
                base.into()
            } else {
                self.unary(Unary::Abs, base.into())
            };
            let rest = self.power(base.into(), half - 1);
            factors.extend([rest, size]);
        }
        Some(self.product(&factors))
    }

    pub(super) fn is_never_negative(&self, id: Id) -> bool {
        self.never_negative[id.0 as usize]
    }

    /// The same of a node that is new, from what is known of its operands.
    pub(super) fn stays_above_zero(&self, node: &Node) -> bool {
        let is_positive = |term: &Expr| term.scale > 0.0 && self.is_never_negative(term.node);
        match node {
            Node::One => true,
            Node::Sum(terms) => terms.iter().all(is_positive),
            Node::Product(factors) => {
                let even = |(base, exponent): &(Id, u32)| {
                    exponent.is_multiple_of(2) || self.is_never_negative(*base)
                };
                factors.iter().all(even)
            }
            Node::Unary(function, _) => function.has(Property::NeverNegative),
            Node::Binary(function, ..) => *function == Binary::Hypot,
            Node::Reduce { fold: Fold::Sum, body, .. } => is_positive(body),
            _ => false,
        }
    }
}
