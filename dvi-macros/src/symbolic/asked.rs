//! How often a formula as written asks for the value of one of its parts.
//!
//! A part that stands in a branch that is not taken, or in a sum without terms, has no value to be asked
//! for, and need not be a number. The derivative of the whole by that part is zero there, and zero times
//! what is no number is none: so the product is chosen only where the part is asked for.

use rustc_hash::FxHashMap as HashMap;

use super::functions::{Property, Unary};
use super::graph::{Expr, Fold, Graph, Id, Node, Relation};
use super::index::Atom;

impl Graph {
    /// `value` where `asked` is not zero, else zero.
    pub(super) fn where_asked(&mut self, asked: Expr, value: Expr) -> Expr {
        if asked.is_zero() {
            return Expr::ZERO;
        }
        let may_be_none = self.has_domain(value.node) || self.grows_fast(value.node);
        if asked.as_number().is_some() || value.is_zero() || !may_be_none {
            return value;
        }
        self.choose(asked, Relation::HasMore, Expr::ZERO, value, Expr::ZERO)
    }

    /// `value` where it is finite, else zero.
    pub(crate) fn where_finite(&mut self, value: Expr) -> Expr {
        if !self.has_domain(value.node) || !self.depends(value.node, Node::varies) {
            return value;
        }
        let size = self.unary(Unary::Abs, value);
        let largest = Expr::number(f64::MAX);
        self.choose(largest, Relation::HasMore, size, value, Expr::ZERO)
    }

    /// How often `whole` asks for `part`; 1 where it always does, whatever the number.
    pub(super) fn asked(&mut self, whole: Id, part: Id) -> Expr {
        // No sum is opened in search of what does not stand in it.
        let mut known: HashMap<Id, Expr> = HashMap::default();
        for id in self.reachable([whole]) {
            let leads_there =
                |operand: &Id| *operand == part || (*operand > part && !known.contains_key(operand));
            if id != part && !self.node(id).operands().iter().any(leads_there) {
                known.insert(id, Expr::ZERO);
            }
        }
        self.count_asked(whole, part, &mut known)
    }

    fn count_asked(&mut self, whole: Id, part: Id, known: &mut HashMap<Id, Expr>) -> Expr {
        if whole == part {
            return Expr::ONE;
        }
        // An operand has a smaller id than the node that uses it.
        if whole < part {
            return Expr::ZERO;
        }
        if let Some(count) = known.get(&whole) {
            return *count;
        }
        let count = match self.node(whole).clone() {
            Node::Choose { left, relation, right, then, otherwise } => {
                let [then, otherwise] =
                    [then, otherwise].map(|branch| self.count_asked(branch.node, part, known));
                self.choose(left, relation, right, then, otherwise)
            }
            Node::Reduce { fold: _, height, range, body } => {
                let depth = self.free(whole).depth().max(self.free(part).depth());
                let inner = self.opened(height, body, depth);
                // Opened, it is another formula.
                let inside = self.asked(inner.node, part);
                match inside.as_number() {
                    Some(_) if range.is_filled() => inside,
                    _ => self.fold(Fold::Sum, Atom::Open(depth), range, inside),
                }
            }
            _ => {
                let operands = self.node(whole).operands();
                let counts: Vec<Expr> =
                    operands.into_iter().map(|operand| self.count_asked(operand, part, known)).collect();
                let always = counts.iter().any(|count| count.as_number().is_some_and(|count| count > 0.0));
                if always { Expr::ONE } else { self.sum(&counts) }
            }
        };
        known.insert(whole, count);
        count
    }

    /// Whether it may be no number somewhere.
    pub(super) fn has_domain(&self, id: Id) -> bool {
        self.depends(id, Node::has_domain)
    }
}

impl Node {
    /// The same of one that is no number somewhere though its operands are.
    pub(super) fn has_domain(&self) -> bool {
        match self {
            Self::Unary(function, _) => !function.has(Property::Smooth),
            Self::Reciprocal(_) | Self::Binary(..) | Self::Call(..) | Self::ScalarField(..) => true,
            _ => false,
        }
    }
}
