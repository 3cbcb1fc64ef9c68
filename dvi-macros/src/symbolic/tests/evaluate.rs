//! An interpreter of the graph on one point of the plane.

use std::collections::HashMap;

use crate::symbolic::rules::evaluate_binary;
use crate::symbolic::{Expr, Graph, Id, Node};

pub(super) fn evaluate(graph: &Graph, expr: Expr, point: [f64; 2]) -> f64 {
    let mut values: HashMap<Id, f64> = HashMap::new();
    for id in graph.reachable([expr.node]) {
        let of = |expr: &Expr| expr.scale * values[&expr.node];
        let value = match graph.node(id) {
            Node::One => 1.0,
            Node::Coordinate(c) => point[c.block as usize],
            Node::Sum(terms) => terms.iter().map(of).sum(),
            Node::Product(factors) => {
                factors.iter().map(|(factor, exponent)| values[factor].powi(*exponent as i32)).product()
            }
            Node::Reciprocal(u) => 1.0 / values[u],
            Node::Unary(function, u) => function.evaluate(of(u)),
            Node::Binary(function, a, b) => evaluate_binary(*function, of(a), of(b)),
            Node::Choose { left, relation, right, then, otherwise } => {
                of(if relation.holds(of(left), of(right)) { then } else { otherwise })
            }
            other => unreachable!("no formula here has {other:?}"),
        };
        values.insert(id, value);
    }
    expr.scale * values[&expr.node]
}
