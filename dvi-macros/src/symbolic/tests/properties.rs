//! Random formulas: simplified against raw, derivatives against dual numbers, and the promises of the
//! graph about its nodes.

use std::collections::HashSet;

use proptest::prelude::*;

use super::evaluate::{Evaluation, Point};
use super::field::{Bounded, Dual, Field};
use super::tree::{BLOCKS, Tree, point, tree};
use crate::symbolic::{Coordinate, Expr, Free, Graph, Index, Node};

/// All coordinates, then all velocities.
pub(super) fn variables(point: &Point) -> Vec<f64> {
    point.coordinates.iter().chain(&point.velocities).flatten().copied().collect()
}

pub(super) fn raw_value(tree: &Tree, point: &Point) -> Bounded {
    let variables: Vec<Bounded> = variables(point).into_iter().map(Bounded::lift).collect();
    tree.evaluate(point, &variables, &mut Vec::new())
}

pub(super) fn agree(what: &str, found: f64, expected: Bounded) -> Result<(), TestCaseError> {
    let off = (found - expected.value).abs();
    let tolerance = expected.tolerance();
    prop_assert!(
        off <= tolerance,
        "{what}: {found:e}, raw {:e}, off by {off:e}, bound {tolerance:e}",
        expected.value
    );
    Ok(())
}

proptest! {
    #![proptest_config(super::configuration(1024))]

    #[test]
    fn simplified_formulas_have_the_value_of_the_raw_ones(tree in tree(3), point in point()) {
        let expected = raw_value(&tree, &point);
        prop_assume!(expected.is_sharp());
        let mut graph = Graph::new(Vec::new());
        let root = tree.lower(&mut graph, 0);
        agree("value", Evaluation::new(&graph, &point).expr(root, &Vec::new()), expected)?;
    }

    #[test]
    fn derivatives_agree_with_dual_numbers(tree in tree(0), point in point()) {
        let mut graph = Graph::new(Vec::new());
        let root = tree.lower(&mut graph, 0);
        let values = variables(&point);
        let n = point.coordinates[0].len();
        for along in 0..BLOCKS * n {
            let seed = |(k, value): (usize, &f64)| Dual {
                re: Bounded::lift(*value),
                eps: Bounded::lift(if k == along { 1.0 } else { 0.0 }),
            };
            let duals: Vec<_> = values.iter().enumerate().map(seed).collect();
            let expected = tree.evaluate(&point, &duals, &mut Vec::new());
            prop_assume!(expected.re.is_sharp() && expected.eps.is_sharp());
            let index = Index::literal((along % n) as i64);
            let by = graph.intern(Node::Coordinate(Coordinate { block: (along / n) as u32, index }));
            let derivative = graph.derivative(root, by);
            agree("derivative", Evaluation::new(&graph, &point).expr(derivative, &Vec::new()), expected.eps)?;
        }
    }

    #[test]
    fn energies_agree_with_dual_numbers(tree in tree(3), point in point()) {
        let mut graph = Graph::new(Vec::new());
        let root = tree.lower(&mut graph, 0);
        let values = variables(&point);
        let first_velocity = point.coordinates.iter().map(Vec::len).sum::<usize>();
        // The derivative along v is Σ v ∂f/∂v.
        let seed = |(k, value): (usize, &f64)| Dual {
            re: Bounded::lift(*value),
            eps: Bounded::lift(if k < first_velocity { 0.0 } else { *value }),
        };
        let duals: Vec<_> = values.iter().enumerate().map(seed).collect();
        let expected = tree.evaluate(&point, &duals, &mut Vec::new());
        prop_assume!(expected.re.is_sharp() && expected.eps.is_sharp());
        let energy = graph.energy(root);
        let found = Evaluation::new(&graph, &point).expr(energy, &Vec::new());
        agree("energy", found, expected.eps - expected.re)?;
    }

    #[test]
    fn the_same_formula_is_the_same_node(tree in tree(3), other in tree(3), point in point()) {
        prop_assume!(raw_value(&tree, &point).is_sharp());
        let mut graph = Graph::new(Vec::new());
        let root = tree.lower(&mut graph, 0);
        other.lower(&mut graph, 0);
        prop_assert_eq!(tree.lower(&mut graph, 0), root);
        prop_assert_eq!(graph.rebuild(root.node, |_, _| None), Expr::from(root.node));
        prop_assert_eq!(graph.free(root.node), Free::default());
    }

    #[test]
    fn nodes_are_in_normal_form(tree in tree(3)) {
        let mut graph = Graph::new(Vec::new());
        let root = tree.lower(&mut graph, 0);
        let gradient = graph.gradient(root, &[]);
        let roots = gradient.iter().map(|contribution| contribution.value.node).chain([root.node]);
        let mut seen = HashSet::new();
        for id in graph.reachable(roots) {
            let node = graph.node(id);
            prop_assert!(seen.insert(node.clone()), "{node:?} is stored twice");
            prop_assert!(node.operands().into_iter().all(|operand| operand < id));
            prop_assert!(is_normal(&graph, node), "{node:?}");
        }
    }
}

fn is_normal(graph: &Graph, node: &Node) -> bool {
    match node {
        Node::Sum(terms) => {
            let ordered = terms.windows(2).all(|pair| pair[0].node < pair[1].node);
            terms.len() >= 2 && ordered && terms.iter().all(|term| !term.is_zero())
        }
        Node::Product(factors) => {
            let ordered = factors.windows(2).all(|pair| pair[0].0 < pair[1].0);
            let flat =
                factors.iter().all(|(id, _)| !matches!(graph.node(*id), Node::Product(_) | Node::One));
            let several = factors.len() > 1 || factors[0].1 > 1;
            ordered && flat && several && factors.iter().all(|(_, exponent)| *exponent > 0)
        }
        Node::Reciprocal(of) => !matches!(graph.node(*of), Node::Reciprocal(_) | Node::One),
        Node::Reduce { range, .. } => !range.is_empty(),
        Node::Unary(_, of) => of.as_number().is_none(),
        Node::Binary(_, a, b) => a.as_number().is_none() || b.as_number().is_none(),
        Node::Choose { then, otherwise, .. } => then != otherwise,
        _ => true,
    }
}
