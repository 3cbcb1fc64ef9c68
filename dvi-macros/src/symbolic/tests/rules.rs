//! A walk over the whole tables of functions: values, signs, first and second derivatives against
//! finite differences.

use crate::symbolic::functions::{Row, UNARY};
use crate::symbolic::rules::BINARY;
use crate::symbolic::{Coordinate, Expr, Graph, Id, Index, Node};

use super::evaluate::{Evaluation, Point};

type Interval = (f64, f64);

/// Intervals on which each function is smooth; every row of the table needs one.
#[rustfmt::skip]
const DOMAINS: &[(&str, &[Interval])] = &[
    ("sqrt",   &[(0.3, 4.0)]),
    ("cbrt",   &[(0.3, 4.0), (-4.0, -0.3)]),
    ("exp",    &[(-2.0, 2.0)]),
    ("exp2",   &[(-2.0, 2.0)]),
    ("exp_m1", &[(-2.0, 2.0)]),
    ("ln",     &[(0.3, 4.0)]),
    ("ln_1p",  &[(-0.6, 3.0)]),
    ("log2",   &[(0.3, 4.0)]),
    ("log10",  &[(0.3, 4.0)]),
    ("sin",    &[(-4.0, 4.0)]),
    ("cos",    &[(-4.0, 4.0)]),
    ("tan",    &[(-1.2, 1.2), (2.0, 4.2)]),
    ("asin",   &[(-0.8, 0.8)]),
    ("acos",   &[(-0.8, 0.8)]),
    ("atan",   &[(-3.0, 3.0)]),
    ("sinh",   &[(-2.0, 2.0)]),
    ("cosh",   &[(-2.0, 2.0)]),
    ("tanh",   &[(-2.0, 2.0)]),
    ("asinh",  &[(-3.0, 3.0)]),
    ("acosh",  &[(1.3, 4.0)]),
    ("atanh",  &[(-0.8, 0.8)]),
    ("abs",    &[(0.1, 3.0), (-3.0, -0.1)]),
    ("signum", &[(0.1, 3.0), (-3.0, -0.1)]),
    ("sign",   &[(0.1, 3.0), (-3.0, -0.1)]),
    ("erf",    &[(-3.0, 3.0)]),
    ("sinc",   &[(-5.0, 5.0)]),
    ("sinc1",  &[(-5.0, 5.0)]),
    ("sinc2",  &[(-5.0, 5.0)]),
    ("sinc3",  &[(1.0, 5.0), (-5.0, -1.0)]),
];

/// Rectangles of the plane, by the ranges of a and b.
#[rustfmt::skip]
const PLANE: &[(&str, &[[Interval; 2]])] = &[
    ("atan2", &[[(0.2, 2.0), (-2.0, 2.0)], [(-2.0, -0.2), (-2.0, 2.0)], [(-2.0, 2.0), (0.2, 2.0)]]),
    ("hypot", &[[(0.3, 2.0), (-2.0, 2.0)], [(-2.0, 2.0), (-2.0, -0.3)]]),
    ("powf",  &[[(0.4, 3.0), (-2.5, 2.5)]]),
    ("over_root", &[[(-2.0, 2.0), (2.0, 3.0)]]),
    ("over_squares", &[[(0.4, 2.0), (-2.0, 2.0)], [(-2.0, 2.0), (-2.0, -0.4)]]),
];

const STEPS: i32 = 7;

fn samples((low, high): Interval) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |step| low + (high - low) * f64::from(step) / f64::from(STEPS))
}

/// Five points (Abramowitz and Stegun 25.3.6); error below 1e-9 for the functions of the table.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

fn close(what: &str, found: f64, expected: f64) {
    let tolerance = 1e-8 * (1.0 + expected.abs());
    assert!((found - expected).abs() < tolerance, "{what}: {found} instead of {expected}");
}

struct Variables {
    graph: Graph,
    a: Id,
    b: Id,
}

impl Variables {
    fn new() -> Self {
        let mut graph = Graph::new(Vec::new());
        let mut coordinate =
            |block| graph.intern(Node::Coordinate(Coordinate { block, index: Index::literal(0) }));
        let (a, b) = (coordinate(0), coordinate(1));
        Self { graph, a, b }
    }

    fn at(&self, of: Expr, a: f64, b: f64) -> f64 {
        let point = Point {
            coordinates: vec![vec![a], vec![b]],
            velocities: Vec::new(),
            parameters: Vec::new(),
            time: 0.0,
        };
        Evaluation::new(&self.graph, &point).expr(of, &Vec::new())
    }

    fn difference(&self, of: Expr, by: Id, (a, b): (f64, f64)) -> f64 {
        if by == self.a {
            difference(|a| self.at(of, a, b), a)
        } else {
            difference(|b| self.at(of, a, b), b)
        }
    }

    /// ∂f and all ∂∂f against differences of f and of ∂f.
    fn check(&mut self, name: &str, f: Expr, points: &[(f64, f64)]) {
        for by in [self.a, self.b] {
            let first = self.graph.derivative(f, by);
            self.compare(&format!("∂{name}"), first, (f, by), points);
            for then in [self.a, self.b] {
                let second = self.graph.derivative(first, then);
                self.compare(&format!("∂∂{name}"), second, (first, then), points);
            }
        }
    }

    fn compare(&self, what: &str, derivative: Expr, (of, by): (Expr, Id), points: &[(f64, f64)]) {
        for point in points {
            let expected = self.difference(of, by, *point);
            close(&format!("{what} at {point:?}"), self.at(derivative, point.0, point.1), expected);
        }
    }
}

#[test]
fn every_function_of_one_argument() {
    assert_eq!(DOMAINS.len(), UNARY.len());
    for Row { name, function, value, .. } in UNARY {
        let (_, domains) =
            DOMAINS.iter().find(|(known, _)| known == name).expect("every function has a domain");
        let mut variables = Variables::new();
        let f = variables.graph.unary(*function, variables.a.into());
        for x in domains.iter().flat_map(|domain| samples(*domain)) {
            variables.check(name, f, &[(x, 0.0)]);
            assert_eq!(variables.at(f, x, 0.0), value(x), "{name}({x})");
            if let Some(sign) = function.parity() {
                let (here, there) = (value(x), sign * value(-x));
                assert!((here - there).abs() <= 4.0 * f64::EPSILON * here.abs(), "parity of {name} at {x}");
                let mirrored = variables.graph.unary(*function, Expr::from(variables.a).negated());
                assert_eq!(mirrored, f.scaled(sign), "{name}(−x) is not shared with {name}(x)");
            }
        }
    }
}

#[test]
fn every_function_of_two_arguments() {
    assert_eq!(PLANE.len(), BINARY.len());
    for (name, function, value) in BINARY {
        let (_, squares) =
            PLANE.iter().find(|(known, _)| known == name).expect("every function has a domain");
        let mut variables = Variables::new();
        let f = variables.graph.binary(*function, variables.a.into(), variables.b.into());
        for [along_a, along_b] in *squares {
            let points: Vec<(f64, f64)> =
                samples(*along_a).flat_map(|a| samples(*along_b).map(move |b| (a, b))).collect();
            for (a, b) in &points {
                assert_eq!(variables.at(f, *a, *b), value(*a, *b), "{name}({a}, {b})");
            }
            variables.check(name, f, &points);
        }
    }
}

/// Powers have no row: they become products, roots and reciprocals.
#[test]
fn every_kind_of_power() {
    for exponent in [-3, -2, -1, 0, 1, 2, 3, 5, 8] {
        let mut variables = Variables::new();
        let f = variables.graph.powi(variables.a.into(), exponent);
        for a in [-1.3, -0.8, 0.7, 1.2] {
            let power = f64::powi(a, exponent);
            close(&format!("{a}.powi({exponent})"), variables.at(f, a, 0.0), power);
        }
        variables.check(&format!("powi({exponent})"), f, &[(0.9, 0.0), (-0.8, 0.0)]);
    }
    for exponent in [-2.5, -2.0, -0.5, 0.0, 0.3, 0.5, 1.0, 1.5, 3.0, 3.7] {
        let mut variables = Variables::new();
        let f = variables.graph.binary(
            crate::symbolic::Binary::Powf,
            variables.a.into(),
            Expr::number(exponent),
        );
        for a in [0.4, 0.9, 1.2, 2.3] {
            let power = f64::powf(a, exponent);
            close(&format!("{a}.powf({exponent})"), variables.at(f, a, 0.0), power);
        }
        variables.check(&format!("powf({exponent})"), f, &[(0.5, 0.0), (1.7, 0.0)]);
    }
}

/// The user's functions are differentiated by their order.
#[test]
fn the_functions_of_the_user() {
    let mut variables = Variables::new();
    let product = variables.graph.multiply(variables.a.into(), variables.b.into());
    let f = variables.graph.call(0, 0, product);
    variables.check("own", f, &[(0.7, -0.4), (1.9, 1.1)]);
}
