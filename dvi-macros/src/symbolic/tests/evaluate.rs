//! An interpreter of the graph on one point.

use std::collections::HashMap;

use crate::symbolic::rules::evaluate_binary;
use crate::symbolic::{
    Atom, Coordinate, Expr, Fold, Graph, Id, Index, Loop, Node, Partial, Range, Relation, Weight,
};

/// What the names of a formula stand for. Every array has the one size that there is.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) coordinates: Vec<Vec<f64>>,
    pub(super) velocities: Vec<Vec<f64>>,
    pub(super) parameters: Vec<f64>,
    pub(super) time: f64,
}

/// The values of the indices, by name.
pub(super) type Bindings = Vec<(Atom, i64)>;

impl Point {
    pub(super) fn size(&self) -> i64 {
        self.coordinates[0].len() as i64
    }

    pub(super) fn index(&self, index: &Index, bindings: &Bindings) -> i64 {
        let of = |atom: &Atom| self.atom(atom, bindings);
        index.terms.iter().fold(index.constant, |sum, (atom, factor)| sum + factor * of(atom))
    }

    fn atom(&self, atom: &Atom, bindings: &Bindings) -> i64 {
        match atom {
            Atom::Open(_) | Atom::Bound(_) => bindings
                .iter()
                .rev()
                .find_map(|(known, value)| (known == atom).then_some(*value))
                .expect("an index outside of its loop"),
            Atom::Size(_) => self.size(),
            Atom::Remainder(value, modulus) => {
                self.index(value, bindings).rem_euclid(self.index(modulus, bindings))
            }
            Atom::Product(factors) => factors.iter().map(|factor| self.atom(factor, bindings)).product(),
            Atom::Row(row, length) => self.index(row, bindings) * self.index(length, bindings),
        }
    }

    pub(super) fn range(&self, range: &Range, bindings: &Bindings) -> Vec<i64> {
        let except: Vec<i64> = range.left_out().map(|except| self.index(except, bindings)).collect();
        let all = self.index(&range.lower, bindings)..self.index(&range.upper, bindings);
        all.filter(|value| !except.contains(value)).collect()
    }

    /// Calls `visit` in every pass of the loops.
    pub(super) fn passes(&self, loops: &[Loop], bindings: &Bindings, visit: &mut dyn FnMut(&Bindings)) {
        let Some((over, inner)) = loops.split_first() else { return visit(bindings) };
        for value in self.range(&over.range, bindings) {
            let mut inside = bindings.clone();
            inside.push((Atom::Open(over.depth), value));
            self.passes(inner, &inside, visit);
        }
    }

    /// The position of a coordinate among all coordinates, or of a velocity among these and the
    /// velocities behind them.
    pub(super) fn position(&self, node: &Node, bindings: &Bindings) -> usize {
        let blocks = self.coordinates.len();
        let (block, coordinate) = match node {
            Node::Coordinate(c) => (c.block as usize, c),
            Node::Velocity(c) => (blocks + c.block as usize, c),
            other => unreachable!("{other:?} is not a variable"),
        };
        block * self.coordinates[0].len() + self.index(&coordinate.index, bindings) as usize
    }

    fn entry(&self, array: &[Vec<f64>], c: &Coordinate, bindings: &Bindings) -> f64 {
        array[c.block as usize][self.index(&c.index, bindings) as usize]
    }

    /// The value of a node without operands.
    pub(super) fn leaf(&self, node: &Node, bindings: &Bindings) -> f64 {
        match node {
            Node::One => 1.0,
            Node::Coordinate(c) => self.entry(&self.coordinates, c, bindings),
            Node::Velocity(c) => self.entry(&self.velocities, c, bindings),
            Node::Time => self.time,
            Node::Parameter(p) => self.parameters[self.index(&p.indices[0], bindings) as usize],
            Node::Count(index) => self.index(index, bindings) as f64,
            Node::Weight(weight) => match weight {
                Weight::Qq => 0.7,
                Weight::Qv => -0.3,
                Weight::Vq => 0.4,
                Weight::Vv => 1.1,
                Weight::A => -0.9,
                Weight::B => 0.6,
                Weight::Q => -1.2,
                Weight::V => 0.8,
            },
            other => unreachable!("{other:?} has operands"),
        }
    }
}

pub(super) fn holds(left: f64, relation: Relation, right: f64) -> bool {
    match relation {
        Relation::Less => left < right,
        Relation::LessOrEqual => left <= right,
        Relation::Greater | Relation::HasMore => left > right,
        Relation::GreaterOrEqual => left >= right,
    }
}

/// The user's own function is the sine.
pub(super) fn own_function(order: u32, x: f64) -> f64 {
    match order % 4 {
        0 => x.sin(),
        1 => x.cos(),
        2 => -x.sin(),
        _ => -x.cos(),
    }
}

/// The user's function of two variables is the sine of a + 2b.
pub(super) fn scalar_field(partial: Partial, at: &[f64]) -> f64 {
    let slopes = [1.0, 2.0];
    let angle = at.iter().zip(slopes).map(|(x, slope)| slope * x).sum();
    let axes = partial.axes();
    axes.iter().map(|axis| slopes[*axis]).product::<f64>() * own_function(axes.len() as u32, angle)
}

/// One evaluation; a node is computed once for each value of the indices that it depends on.
pub(super) struct Evaluation<'a> {
    graph: &'a Graph,
    point: &'a Point,
    known: HashMap<(Id, Bindings), f64>,
}

impl<'a> Evaluation<'a> {
    pub(super) fn new(graph: &'a Graph, point: &'a Point) -> Self {
        Self { graph, point, known: HashMap::new() }
    }

    pub(super) fn expr(&mut self, expr: Expr, bindings: &Bindings) -> f64 {
        if expr.is_zero() { 0.0 } else { expr.scale * self.node(expr.node, bindings) }
    }

    fn node(&mut self, id: Id, bindings: &Bindings) -> f64 {
        let free = self.graph.free(id);
        let is_free = |name: &Atom| {
            let own = Index::atom(name.clone()).free();
            own.open & free.open != 0 || own.bound & free.bound != 0
        };
        let relevant: Bindings = bindings.iter().filter(|(name, _)| is_free(name)).cloned().collect();
        if let Some(value) = self.known.get(&(id, relevant.clone())) {
            return *value;
        }
        let value = self.compute(id, &relevant);
        self.known.insert((id, relevant), value);
        value
    }

    fn compute(&mut self, id: Id, at: &Bindings) -> f64 {
        match self.graph.node(id).clone() {
            Node::Sum(terms) => terms.iter().map(|term| self.expr(*term, at)).sum(),
            Node::Product(factors) => factors
                .iter()
                .map(|(factor, exponent)| self.node(*factor, at).powi(*exponent as i32))
                .product(),
            Node::Reciprocal(of) => 1.0 / self.node(of, at),
            Node::Unary(function, of) => function.evaluate(self.expr(of, at)),
            Node::Binary(function, a, b) => evaluate_binary(function, self.expr(a, at), self.expr(b, at)),
            Node::Call(_, order, of) => own_function(order, self.expr(of, at)),
            Node::ScalarField(_, partial, of) => {
                let of: Vec<f64> = of.iter().map(|of| self.expr(*of, at)).collect();
                scalar_field(partial, &of)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let chosen = holds(self.expr(left, at), relation, self.expr(right, at));
                self.expr(if chosen { then } else { otherwise }, at)
            }
            Node::Reduce { fold, height, range, body } => {
                let values = self.point.range(&range, at).into_iter().map(|value| {
                    let inside: Bindings =
                        at.iter().cloned().chain([(Atom::Bound(height), value)]).collect();
                    self.expr(body, &inside)
                });
                match fold {
                    Fold::Sum => values.sum(),
                    Fold::Product => values.product(),
                }
            }
            leaf => self.point.leaf(&leaf, at),
        }
    }
}
