//! A sum over all pairs of bodies of a function of their distance, in an energy: H = H_rest + Σ_{j<k} w_j
//! w_k K(r²), or L = L_rest − Σ_{j<k} w_j w_k K(r²).

use crate::model::Model;
use crate::symbolic::{
    Atom, Binary, Coordinate, Expr, Fold, Graph, Id, Index, Node, Parameter, Range, Unary,
};

/// The most coordinates that a body has.
const MOST_AXES: usize = 3;

/// The sum over pairs that was found.
#[derive(Clone, Debug)]
pub(crate) struct PairSum {
    /// The number of bodies, known at run time only.
    pub(crate) bodies: Index,
    /// The block with each coordinate of a body.
    pub(crate) blocks: Vec<u32>,
    /// The factors of a weight: parameters with one index, that of the body.
    pub(crate) weights: Vec<(u32, u32)>,
    /// K(r²), with [`square`](Self::square) in the place of r².
    pub(crate) kernel: Expr,
    pub(crate) square: Id,
    /// H_rest or L_rest
    pub(crate) rest: Expr,
}

/// Σ_{j<k}, opened: the names of the two indices, the number of bodies, and what is summed.
struct Pairs {
    indices: [Atom; 2],
    bodies: Index,
    body: Expr,
}

impl PairSum {
    /// The first one in a Lagrangian.
    pub(crate) fn in_lagrangian(graph: &mut Graph, model: &Model, lagrangian: Expr) -> Option<Self> {
        let sum = Self::find(graph, model, lagrangian)?;
        Some(Self { kernel: sum.kernel.negated(), ..sum })
    }

    /// The first one among the terms of a Hamiltonian.
    pub(crate) fn find(graph: &mut Graph, model: &Model, energy: Expr) -> Option<Self> {
        let terms: Vec<Expr> = match graph.node(energy.node) {
            Node::Sum(terms) => terms.iter().map(|term| term.scaled(energy.scale)).collect(),
            _ => vec![energy],
        };
        (0..terms.len()).find_map(|number| {
            let mut sum = Self::of_term(graph, model, terms[number])?;
            let mut others = terms.clone();
            others.remove(number);
            sum.rest = graph.sum(&others);
            Some(sum)
        })
    }

    /// A sum over pairs times what depends on parameters alone.
    fn of_term(graph: &mut Graph, model: &Model, term: Expr) -> Option<Self> {
        let mut kernel = graph.factors(term.node);
        let is_sum = |id: Id| matches!(graph.node(id), Node::Reduce { fold: Fold::Sum, .. });
        let sum = kernel.iter().position(|(id, exponent)| *exponent == 1 && is_sum(*id))?;
        let (sum, _) = kernel.remove(sum);
        let pairs = pairs(graph, model, sum)?;
        let mut weights = [Vec::new(), Vec::new()];
        for (factor, exponent) in graph.factors(pairs.body.node) {
            let Some((body, field)) = weight(graph, &pairs, factor) else {
                kernel.push((factor, exponent));
                continue;
            };
            weights[body].push((field, exponent));
        }
        weights.iter_mut().for_each(|factors| factors.sort_unstable());
        let [weights, others] = weights;
        if weights != others {
            return None;
        }
        let powers: Vec<Expr> =
            kernel.into_iter().map(|(factor, exponent)| graph.power(factor.into(), exponent)).collect();
        let kernel = graph.product(&powers).scaled(term.scale * pairs.body.scale);
        let blocks = blocks(graph, &pairs, kernel)?;
        if blocks.iter().any(|block| model.block_size(*block as usize) != pairs.bodies) {
            return None;
        }
        let square = Node::Coordinate(Coordinate { block: blocks[0], index: Index::literal(0) });
        let square = graph.intern(square);
        let kernel = of_square(graph, &pairs, &blocks, kernel, square)?;
        Some(Self { bodies: pairs.bodies, blocks, weights, kernel, square, rest: Expr::ZERO })
    }

    /// The difference of two bodies along an axis, and the square of their distance.
    pub(crate) fn distance(&self, graph: &mut Graph, bodies: [Atom; 2]) -> (Vec<Expr>, Expr) {
        let differences: Vec<Expr> =
            self.blocks.iter().map(|block| difference(graph, *block, &bodies)).collect();
        let squares: Vec<Expr> = differences.iter().map(|difference| graph.power(*difference, 2)).collect();
        let square = graph.sum(&squares);
        (differences, square)
    }

    /// w_j w_k times a function of the square of the distance.
    pub(crate) fn weighted(&self, graph: &mut Graph, of_square: Expr, bodies: [Atom; 2]) -> Expr {
        let (_, square) = self.distance(graph, bodies.clone());
        let value = graph.rebuild(of_square.node, |_, id| (id == self.square).then_some(square));
        let mut factors = vec![value.scaled(of_square.scale)];
        for body in &bodies {
            for (field, exponent) in &self.weights {
                let weight = Parameter { field: *field, indices: vec![Index::atom(body.clone())] };
                let weight = graph.intern(Node::Parameter(weight));
                factors.push(graph.power(weight.into(), *exponent));
            }
        }
        graph.product(&factors)
    }
}

/// What a sum over j < k sums, if the number of bodies is known at run time only.
fn pairs(graph: &Graph, model: &Model, sum: Id) -> Option<Pairs> {
    let Node::Reduce { fold: Fold::Sum, height: outer, range: first, body } = graph.node(sum) else {
        return None;
    };
    let Node::Reduce { fold: Fold::Sum, height: inner, range: second, body: term } = graph.node(body.node)
    else {
        return None;
    };
    let indices = [Atom::Bound(*outer), Atom::Bound(*inner)];
    let one = Index::literal(1);
    let is_plain = |range: &Range| range.left_out().next().is_none();
    let above = Index::atom(indices[0].clone()).plus(&one, 1);
    let ends_before = |range: &Range, end: &Index| range.upper == *end || range.upper.plus(&one, 1) == *end;
    let is_after = second.lower == above && ends_before(first, &second.upper);
    let bodies = second.upper.clone();
    let is_all = is_plain(first) && is_plain(second) && first.lower == Index::literal(0) && is_after;
    let is_known_late = bodies.free() == crate::symbolic::Free::default() && !model.is_constant(&bodies);
    (is_all && is_known_late).then(|| Pairs { indices, bodies, body: term.scaled(body.scale) })
}

/// Whose weight a factor is, and which parameter.
fn weight(graph: &Graph, pairs: &Pairs, factor: Id) -> Option<(usize, u32)> {
    let Node::Parameter(Parameter { field, indices }) = graph.node(factor) else { return None };
    let [index] = indices.as_slice() else { return None };
    let body = pairs.indices.iter().position(|body| *index == Index::atom(body.clone()))?;
    Some((body, *field))
}

/// The blocks of the coordinates in a kernel, if all of them are those of the two bodies.
fn blocks(graph: &Graph, pairs: &Pairs, kernel: Expr) -> Option<Vec<u32>> {
    let mut blocks = Vec::new();
    for id in graph.reachable([kernel.node]) {
        let Node::Coordinate(Coordinate { block, index }) = graph.node(id) else { continue };
        if !pairs.indices.iter().any(|body| *index == Index::atom(body.clone())) {
            return None;
        }
        if !blocks.contains(block) {
            blocks.push(*block);
        }
    }
    blocks.sort_unstable();
    (1..=MOST_AXES).contains(&blocks.len()).then_some(blocks)
}

fn difference(graph: &mut Graph, block: u32, bodies: &[Atom; 2]) -> Expr {
    let [first, second] = bodies
        .clone()
        .map(|body| graph.intern(Node::Coordinate(Coordinate { block, index: Index::atom(body) })));
    graph.subtract(first.into(), second.into())
}

/// The terms of a sum, with those of sums among them.
fn ungrouped(graph: &Graph, terms: &[Expr]) -> Vec<Expr> {
    let inside = terms.iter().flat_map(|term| match graph.node(term.node) {
        Node::Sum(inner) => {
            let scaled: Vec<Expr> = inner.iter().map(|inner| inner.scaled(term.scale)).collect();
            ungrouped(graph, &scaled)
        }
        _ => vec![*term],
    });
    inside.collect()
}

/// The kernel with `square` in the place of the square of the distance, if it depends on nothing else of the
/// bodies.
fn of_square(graph: &mut Graph, pairs: &Pairs, blocks: &[u32], kernel: Expr, square: Id) -> Option<Expr> {
    let [first, second] = pairs.indices.clone();
    let mut differences = Vec::new();
    let mut squares = Vec::new();
    for block in blocks {
        // Differences are kept as they were written.
        let both = [[first.clone(), second.clone()], [second.clone(), first.clone()]]
            .map(|bodies| difference(graph, *block, &bodies));
        squares.push(both.map(|difference| graph.power(difference, 2).node));
        differences.push(both.map(|difference| difference.node));
    }
    let replace = |graph: &mut Graph, id: Id| match graph.node(id).clone() {
        Node::Sum(terms) => {
            let terms = ungrouped(graph, &terms);
            let of = |known: &[Id; 2]| terms.iter().position(|term| known.contains(&term.node));
            let places: Vec<usize> = squares.iter().map(of).collect::<Option<_>>()?;
            let scale = terms[places[0]].scale;
            if places.iter().any(|place| terms[*place].scale != scale) {
                return None;
            }
            let others = terms.iter().enumerate().filter(|(place, _)| !places.contains(place));
            let mut sum: Vec<Expr> = others.map(|(_, term)| *term).collect();
            sum.push(Expr { scale, node: square });
            Some(graph.sum(&sum))
        }
        Node::Product(_) if blocks.len() == 1 && squares[0].contains(&id) => Some(square.into()),
        Node::Binary(Binary::Hypot, a, b) => {
            let is =
                |axis: usize, of: Expr| differences.get(axis).is_some_and(|known| known.contains(&of.node));
            let is_distance = blocks.len() == 2 && a.scale.abs() == 1.0 && b.scale.abs() == 1.0;
            let is_distance = is_distance && (is(0, a) && is(1, b) || is(1, a) && is(0, b));
            is_distance.then(|| graph.unary(Unary::Sqrt, square.into()))
        }
        _ => None,
    };
    let replaced = graph.rebuild(kernel.node, replace).scaled(kernel.scale);
    let depends_otherwise = graph.free(replaced.node) != crate::symbolic::Free::default()
        || graph.depends(replaced.node, |node| {
            matches!(
                node,
                Node::Velocity(_)
                    | Node::Time
                    | Node::ScalarField(..)
                    | Node::Weight(_)
                    | Node::Reduce { .. }
            )
        });
    (!depends_otherwise && graph.depends(replaced.node, |node| *node == *graph.node(square)))
        .then_some(replaced)
}
