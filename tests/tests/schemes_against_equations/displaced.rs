//! Interior displacements: p0 = −D₁L_d and p1 = D₂L_d where L_d(q0, q1, δ) is stationary in δ.

use dvi_core::State;
use dvi_core::discrete::FrequencyIn;
use dvi_core::prelude::*;
use dvi_tests::{larger, oracle};
use nalgebra::{DVector, RealField, convert};

use super::equations::{Formula, defect, dual, interpolation, size};
use super::systems::{Coupled, Fast, Magnetic, Shaken};
use super::{Outcome, START, STEPS};

/// P_n and its first two derivatives at x inside, by the recurrence of the polynomials and their
/// differential equation.
fn legendre(n: usize, x: f64) -> [f64; 3] {
    let (mut last, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (last, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * last) / k);
    }
    let n = n as f64;
    let first = n * (last - x * value) / (1.0 - x * x);
    [value, first, (2.0 * x * first - n * (n + 1.0) * value) / (1.0 - x * x)]
}

/// The Lobatto rules on [0, 1]: both ends, and the zeros of P'ₛ₋₁ by Newton's method from the extrema of a
/// Chebyshev polynomial; weights 2/(s(s−1)P²ₛ₋₁) on [−1, 1] (Abramowitz & Stegun 1964, 25.4.32).
fn lobatto(nodes: usize) -> (Vec<f64>, Vec<f64>) {
    let n = nodes - 1;
    let rule = (0..nodes).map(|j| {
        let mut x = -(core::f64::consts::PI * j as f64 / n as f64).cos();
        let mut value: f64 = 1.0;
        if j > 0 && j < n {
            for _ in 0..8 {
                let [_, first, second] = legendre(n, x);
                x -= first / second;
            }
            [value, ..] = legendre(n, x);
        }
        ((1.0 + x) / 2.0, 1.0 / ((nodes * n) as f64 * value * value))
    });
    rule.unzip()
}

/// The derivative at `at` of the Lagrange polynomial of node k.
fn lagrange_derivative(nodes: &[f64], k: usize, at: f64) -> f64 {
    let factor = |m: usize| (at - nodes[m]) / (nodes[k] - nodes[m]);
    let others = || (0..nodes.len()).filter(move |&m| m != k);
    others().map(|m| others().filter(|&l| l != m).map(factor).product::<f64>() / (nodes[k] - nodes[m])).sum()
}

/// Lobatto nodes and weights, the derivatives of the Lagrange polynomials at the nodes, and the frequency of
/// the interpolation.
struct Nodes {
    c: Vec<f64>,
    w: Vec<f64>,
    /// Of the polynomial of node k at node j.
    derivatives: Vec<Vec<f64>>,
    omega: f64,
}

impl Nodes {
    fn new(nodes: usize, omega: f64) -> Self {
        let (c, w) = lobatto(nodes);
        let of = |k| c.iter().map(|&at| lagrange_derivative(&c, k, at)).collect();
        Self { derivatives: (0..nodes).map(of).collect(), c, w, omega }
    }

    fn interior(&self) -> core::ops::Range<usize> {
        1..self.c.len() - 1
    }
}

/// L_d(q0, q1, δ), the displacements of one interior node after the other.
fn discrete_lagrangian<F: Formula, T: RealField + Copy>(
    formula: &F,
    nodes: &Nodes,
    [t, h]: [f64; 2],
    [q0, q1, displacements]: [&[T]; 3],
) -> T {
    let n = q0.len();
    let mut sum = T::zero();
    for (j, (&c, &w)) in nodes.c.iter().zip(&nodes.w).enumerate() {
        let [b0, b1, d0, d1] = interpolation(c, nodes.omega * h).map(convert::<f64, T>);
        let mut point: Vec<T> = (0..n).map(|i| b0 * q0[i] + b1 * q1[i]).collect();
        let mut velocity: Vec<T> = (0..n).map(|i| d0 * q0[i] + d1 * q1[i]).collect();
        for k in nodes.interior() {
            let derivative: T = convert(nodes.derivatives[k][j]);
            for i in 0..n {
                let displacement = displacements[(k - 1) * n + i];
                velocity[i] += derivative * displacement;
                if j == k {
                    point[i] += displacement;
                }
            }
        }
        velocity.iter_mut().for_each(|v| *v /= convert(h));
        sum += convert::<f64, T>(h * w) * formula.lagrangian(&point, &velocity, convert(t + c * h));
    }
    sum
}

/// The displacements at which L_d is stationary.
fn stationary<F: Formula>(formula: &F, nodes: &Nodes, th: [f64; 2], [q0, q1]: [&[f64]; 2]) -> Vec<f64> {
    let size = q0.len() * nodes.interior().len();
    let (q0, q1) = (dual(q0, None), dual(q1, None));
    let gradient = |x: &DVector<f64>| {
        let entry =
            |i, _| discrete_lagrangian(formula, nodes, th, [&q0, &q1, &dual(x.as_slice(), Some(i))]).eps;
        DVector::from_fn(size, entry)
    };
    oracle::stationary(size, gradient).expect("a regular matrix")
}

fn check<S, F, const NODES: usize>(
    system: &S,
    method: Galerkin<NODES, F>,
    omega: f64,
    (q, v): (&[f64], &[f64]),
) -> Outcome
where
    S: RegularLagrangian + Formula,
    F: FrequencyIn<f64> + Copy,
{
    let (name, nodes) = (S::REPORT.system, Nodes::new(NODES, omega));
    let mut solvers = vec![Solver::Automatic, Solver::Newton];
    if S::SEPARABLE {
        solvers.push(Solver::FixedPoint);
    }
    for (h, solver) in STEPS.into_iter().flat_map(|h| solvers.iter().map(move |solver| (h, *solver))) {
        let method = Galerkin { solver, ..method };
        let state = S::State::read(|block| system.block_len(block), q, v);
        let mut run = Integrator::new_at(system, method, START, h, state)?;
        for step in 0..3 {
            let (t, q0, p0) = (run.time(), run.q().to_vec(), run.memory().p().to_vec());
            run.advance().map_err(|error| format!("{name}, {method:?}: {error}"))?;
            let (q1, p1) = (run.q(), run.memory().p());
            let x = dual(&stationary(system, &nodes, [t, h], [&q0, q1]), None);
            let value =
                |a, b| discrete_lagrangian(system, &nodes, [t, h], [&dual(&q0, a), &dual(q1, b), &x]).eps;
            let left: Vec<f64> = (0..q0.len()).map(|i| value(Some(i), None)).collect();
            let right: Vec<f64> = (0..q0.len()).map(|i| value(None, Some(i))).collect();
            let scale = 1.0 + size(&p0) + size(p1) + size(q1) / h.abs();
            let found = larger(defect(&p0, 1.0, &left), defect(p1, -1.0, &right)) / scale;
            assert!(found < 4e-14, "{name}, {method:?}, h = {h}, step {step}: {found:e}");
        }
    }
    Ok(())
}

fn check_nodes<const NODES: usize>() -> Outcome {
    let planar: (&[f64], &[f64]) = (&[0.5, -0.2], &[0.4, -0.3]);
    let line: (&[f64], &[f64]) = (&[0.2, -0.1, 0.4], &[0.3, 0.5, -0.2]);
    let (shaken, magnetic, fast) = (Shaken { depth: 0.4 }, Magnetic { b: 0.7 }, Fast { field: 0.6 });
    let coupled = Coupled { mass: vec![1.0, 2.0, 1.5] };
    let linear = Galerkin::<NODES>::new();
    check(&shaken, linear, 0.0, planar)?;
    check(&coupled, linear, 0.0, line)?;
    check(&magnetic, linear, 0.0, planar)?;
    check(&fast, linear, 0.0, planar)?;
    let fitted = linear.phase_fitted(Constant(1.3));
    check(&shaken, fitted, 1.3, planar)?;
    check(&coupled, fitted, 1.3, line)?;
    check(&magnetic, fitted, 1.3, planar)?;
    check(&fast, fitted, 1.3, planar)
}

#[test]
fn three_nodes() -> Outcome {
    check_nodes::<3>()
}

#[test]
fn four_nodes() -> Outcome {
    check_nodes::<4>()
}

#[test]
fn five_nodes() -> Outcome {
    check_nodes::<5>()
}

#[test]
fn six_nodes() -> Outcome {
    check_nodes::<6>()
}
