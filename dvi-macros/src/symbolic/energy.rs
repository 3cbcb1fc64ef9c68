//! The energy E = v·∂f/∂v − f of a function of the velocities, term by term.
//!
//! By Euler's theorem v·∂f/∂v = k·f where f is homogeneous of degree k in v, so such a term gives
//! (k − 1)·f: a quadratic kinetic energy is kept, a linear term drops out, a potential changes its sign.
//! E is linear in f, so sums stay sums and their loops stay loops. What is not homogeneous, such as
//! cosh v, is differentiated along v.

use rustc_hash::FxHashMap as HashMap;

use super::functions::Unary;
use super::graph::{Binary, Expr, Fold, Graph, Id, Node, Weight};
use super::index::Atom;

impl Graph {
    /// v·∂f/∂v − f.
    pub(crate) fn energy(&mut self, of: Expr) -> Expr {
        Energy { graph: self, degrees: HashMap::default(), known: HashMap::default() }.of(of)
    }

    /// The degree k with f(q, s·v) = sᵏ·f(q, v) for s > 0, as far as the form of f shows it, from the
    /// degrees of its operands.
    fn velocity_degree(&self, id: Id, known: &HashMap<Id, Option<f64>>) -> Option<f64> {
        let known = |id: &Id| known.get(id).copied().flatten();
        let common = |operands: &[Id]| {
            let first = known(operands.first()?)?;
            operands.iter().all(|operand| known(operand) == Some(first)).then_some(first)
        };
        let operands = self.node(id).operands();
        match self.node(id) {
            Node::Velocity(_) => Some(1.0),
            Node::Sum(_) | Node::Reduce { fold: Fold::Sum, .. } => common(&operands),
            Node::Product(factors) => {
                factors.iter().map(|(factor, exponent)| Some(known(factor)? * f64::from(*exponent))).sum()
            }
            Node::Reciprocal(of) => Some(-known(of)?),
            Node::Unary(Unary::Sqrt, of) => Some(known(&of.node)? / 2.0),
            Node::Unary(Unary::Cbrt, of) => Some(known(&of.node)? / 3.0),
            Node::Unary(Unary::Abs, of) => known(&of.node),
            Node::Binary(Binary::Hypot, ..) => common(&operands),
            Node::Binary(Binary::Powf, base, exponent) if exponent.as_number().is_some() => {
                Some(known(&base.node)? * exponent.as_number()?)
            }
            Node::Choose { then, otherwise, .. } => common(&[then.node, otherwise.node]),
            _ => operands.iter().all(|operand| known(operand) == Some(0.0)).then_some(0.0),
        }
    }
}

/// Beyond this many terms nothing is sought that cancels.
const MOST_TERMS: usize = 64;

struct Energy<'a> {
    graph: &'a mut Graph,
    degrees: HashMap<Id, Option<f64>>,
    known: HashMap<Id, Expr>,
}

impl Energy<'_> {
    fn of(&mut self, of: Expr) -> Expr {
        self.of_node(of.node).scaled(of.scale)
    }

    fn of_node(&mut self, of: Id) -> Expr {
        if let Some(known) = self.known.get(&of) {
            return *known;
        }
        let energy = match self.degree(of) {
            Some(degree) => Expr::from(of).scaled(degree - 1.0),
            None => self.of_inhomogeneous(of),
        };
        self.known.insert(of, energy);
        energy
    }

    fn degree(&mut self, of: Id) -> Option<f64> {
        for id in self.graph.reachable([of]) {
            if !self.degrees.contains_key(&id) {
                let degree = self.graph.velocity_degree(id, &self.degrees);
                self.degrees.insert(id, degree);
            }
        }
        self.degrees.get(&of).copied().flatten()
    }

    fn of_inhomogeneous(&mut self, of: Id) -> Expr {
        match self.graph.node(of).clone() {
            Node::Sum(terms) => {
                let terms: Vec<Expr> = terms.iter().map(|term| self.of(*term)).collect();
                self.graph.sum(&terms)
            }
            Node::Reduce { fold: Fold::Sum, height, range, body } => {
                let depth = self.graph.free(of).depth();
                let inner = self.graph.opened(height, body, depth);
                let energy = self.of(inner);
                self.graph.fold(Fold::Sum, Atom::Open(depth), range, energy)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let (then, otherwise) = (self.of(then), self.of(otherwise));
                self.graph.choose(left, relation, right, then, otherwise)
            }
            Node::Product(factors) => self.of_product(of, &factors),
            Node::Unary(Unary::Sqrt, u) => self.of_root(of, u),
            _ => self.along_velocity(of),
        }
    }

    /// c·f for the only factor f with velocities gives c times the energy of f.
    fn of_product(&mut self, of: Id, factors: &[(Id, u32)]) -> Expr {
        let (resting, moving): (Vec<_>, Vec<_>) =
            factors.iter().partition(|(factor, _)| self.degree(*factor) == Some(0.0));
        let [(single, 1)] = moving.as_slice() else { return self.along_velocity(of) };
        let mut product = vec![self.of_node(*single)];
        for (factor, exponent) in resting {
            product.push(self.graph.power(factor.into(), exponent));
        }
        self.graph.product(&product)
    }

    /// v·∂√u/∂v − √u = (E(u) − u)/(2√u), where velocities often cancel: √(1 − v²) gives −1/√(1 − v²).
    fn of_root(&mut self, root: Id, u: Expr) -> Expr {
        let energy = self.of(u);
        let mut terms = Vec::new();
        self.flatten(energy, &mut terms);
        self.flatten(u.negated(), &mut terms);
        let numerator = self.graph.sum(&terms);
        let reciprocal = self.graph.reciprocal(root.into());
        self.graph.multiply(numerator, reciprocal).scaled(0.5)
    }

    /// Adds the terms of sums of sums, as far as they are few.
    fn flatten(&self, of: Expr, terms: &mut Vec<Expr>) {
        match self.graph.node(of.node) {
            Node::Sum(inner) if terms.len() < MOST_TERMS => {
                inner.iter().for_each(|term| self.flatten(term.scaled(of.scale), terms));
            }
            _ => terms.push(of),
        }
    }

    /// ∂f(q, s·v)/∂s − f at s = 1; a weight stands for s, because no formula has one.
    fn along_velocity(&mut self, of: Id) -> Expr {
        let graph = &mut *self.graph;
        let factor = graph.intern(Node::Weight(Weight::A));
        let stretch = |graph: &mut Graph, id: Id| {
            let velocity = graph.node(id).is_velocity();
            velocity.then(|| graph.multiply(factor.into(), id.into()))
        };
        let stretched = graph.rebuild(of, stretch);
        let along = graph.derivative(stretched, factor);
        let at_one = |_: &mut Graph, id: Id| (id == factor).then_some(Expr::ONE);
        let along = graph.rebuild(along.node, at_one).scaled(along.scale);
        graph.subtract(along, of.into())
    }
}
