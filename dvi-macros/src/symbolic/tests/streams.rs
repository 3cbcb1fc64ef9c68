//! Gradients and Hessians of formulas with sums: the contributions, carried out loop by loop for three
//! bodies, against dual numbers of the raw formula.

use proptest::prelude::*;

use super::evaluate::{Bindings, Evaluation, Point};
use super::field::{Bounded, Dual, Field};
use super::properties::{agree, raw_value, variables};
use super::tree::{Place, Range, Tree, point, tree};
use crate::symbolic::{Expr, Graph, Unary};

type HyperDual = Dual<Dual<Bounded>>;

fn raw_second(tree: &Tree, point: &Point, i: usize, j: usize) -> HyperDual {
    let lift = |on: bool| Bounded::lift(if on { 1.0 } else { 0.0 });
    let seed = |(k, value): (usize, f64)| Dual {
        re: Dual { re: Bounded::lift(value), eps: lift(k == i) },
        eps: Dual { re: lift(k == j), eps: lift(false) },
    };
    let variables: Vec<HyperDual> = variables(point).into_iter().enumerate().map(seed).collect();
    tree.evaluate(point, &variables, &mut Vec::new())
}

/// What a list of contributions adds up to.
fn gradient(graph: &mut Graph, root: Expr, point: &Point) -> Vec<f64> {
    let contributions = graph.gradient(root, &[]);
    let mut out = vec![0.0; variables(point).len()];
    for contribution in contributions {
        point.passes(&contribution.loops, &Bindings::new(), &mut |at| {
            let position = point.position(graph.node(contribution.target), at);
            out[position] += Evaluation::new(graph, point).expr(contribution.value, at);
        });
    }
    out
}

fn hessian(graph: &mut Graph, root: Expr, point: &Point) -> Vec<f64> {
    let contributions = graph.hessian(root);
    let n = variables(point).len();
    let mut out = vec![0.0; n * n];
    for contribution in contributions {
        point.passes(&contribution.loops, &Bindings::new(), &mut |at| {
            let row = point.position(graph.node(contribution.row), at);
            let column = point.position(graph.node(contribution.column), at);
            let value = Evaluation::new(graph, point).expr(contribution.value, at);
            out[n * row + column] += value;
            if contribution.mirrored {
                out[n * column + row] += value;
            }
        });
    }
    out
}

fn check(tree: &Tree, point: &Point) -> Result<(), TestCaseError> {
    prop_assume!(raw_value(tree, point).is_sharp());
    let mut graph = Graph::new(Vec::new());
    let root = tree.lower(&mut graph, 0);
    let (first, second) = (gradient(&mut graph, root, point), hessian(&mut graph, root, point));
    let n = first.len();
    for i in 0..n {
        for j in 0..=i {
            let expected = raw_second(tree, point, i, j);
            prop_assume!(expected.re.eps.is_sharp() && expected.eps.eps.is_sharp());
            agree(&format!("gradient[{i}]"), first[i], expected.re.eps)?;
            for entry in [n * i + j, n * j + i] {
                agree(&format!("Hessian[{}, {}]", entry / n, entry % n), second[entry], expected.eps.eps)?;
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(super::configuration(384))]

    #[test]
    fn derivatives_of_random_sums(tree in tree(6), point in point()) {
        check(&tree, &point)?;
    }

    #[test]
    fn derivatives_of_nonlinear_functions_of_sums(case in 0..NONLINEAR.len(), point in point()) {
        check(&NONLINEAR[case](), &point)?;
    }
}

fn x(up: usize) -> Box<Tree> {
    Box::new(Tree::Coordinate(0, Place { up, shift: 0 }))
}

fn y(up: usize, shift: i64) -> Box<Tree> {
    Box::new(Tree::Coordinate(1, Place { up, shift }))
}

fn sum(range: Range, body: Tree) -> Box<Tree> {
    Box::new(Tree::Sum(range, Box::new(body)))
}

/// Σ xⱼ²
fn squares() -> Box<Tree> {
    sum(Range::Whole, Tree::Powi(x(0), 2))
}

pub(super) const NONLINEAR: [fn() -> Tree; 9] = [
    // √Σ xⱼ²
    || Tree::Unary(Unary::Sqrt, squares()),
    // Σ xⱼ² · Σ yⱼ xⱼ
    || Tree::Multiply(squares(), sum(Range::Whole, Tree::Multiply(y(0, 0), x(0)))),
    // Σ xⱼ · Σ xⱼ yⱼ
    || {
        let product = Tree::Multiply(x(0), y(0, 0));
        Tree::Multiply(sum(Range::Whole, *x(0)), sum(Range::Whole, product))
    },
    // sin(Σ xⱼ²)/Σ xⱼ²
    || Tree::Divide(Box::new(Tree::Unary(Unary::Sin, squares())), squares()),
    // Σⱼ ln Σₖ exp(xⱼ yₖ)
    || {
        let inner = sum(Range::Whole, Tree::Unary(Unary::Exp, Box::new(Tree::Multiply(x(1), y(0, 0)))));
        *sum(Range::Whole, Tree::Unary(Unary::Ln, inner))
    },
    // √(Σⱼ (Σₖ xₖ yⱼ₊₁)² + Σ xⱼ²)
    || {
        let inner = sum(Range::Whole, Tree::Multiply(x(0), y(1, 1)));
        let outer = sum(Range::Whole, Tree::Powi(inner, 2));
        Tree::Unary(Unary::Sqrt, Box::new(Tree::Add(outer, squares())))
    },
    // cos Σⱼ sin Σₖ₌₀ʲ xₖ
    || {
        let inner = sum(Range::UpTo, *x(0));
        let outer = sum(Range::Whole, Tree::Unary(Unary::Sin, inner));
        Tree::Unary(Unary::Cos, outer)
    },
    // (Σⱼ Σₖ>ⱼ (xⱼ − xₖ)⁴)³
    || {
        let inner = sum(Range::Beyond, Tree::Powi(Box::new(Tree::Subtract(x(1), x(0))), 4));
        Tree::Powi(sum(Range::Whole, *inner), 3)
    },
    // (Σⱼ xⱼ² √(1 + Σₖ≠ⱼ xₖ² (Σₗ yₗ xₖ xⱼ)²))²
    || {
        let innermost = sum(Range::Whole, Tree::Multiply(y(0, 0), Box::new(Tree::Multiply(x(1), x(2)))));
        let term = Tree::Multiply(Box::new(Tree::Powi(x(0), 2)), Box::new(Tree::Powi(innermost, 2)));
        let radicand = Tree::Add(Box::new(Tree::Number(1.0)), sum(Range::Except, term));
        let root = Tree::Unary(Unary::Sqrt, Box::new(radicand));
        let body = Tree::Multiply(Box::new(Tree::Powi(x(0), 2)), Box::new(root));
        Tree::Powi(sum(Range::Whole, body), 2)
    },
];
