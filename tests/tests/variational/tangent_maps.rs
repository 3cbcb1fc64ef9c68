//! Second derivatives of discrete Lagrangians against hyper-dual numbers, and what is made of them: tangent
//! maps and exponents of runs on regular systems.

use super::Outcome;
use approx::assert_abs_diff_eq;
use dvi_core::discrete::{Interval, Rule};
use dvi_core::methods::{Method, VariationalMethod};
use dvi_core::prelude::*;
use dvi_core::{Lagrangian, State};
use dvi_tests::larger;
use dvi_tests::laws::equations::Nodes;
use dvi_tests::systems::LotkaVolterra;
use dvi_tests::zoo::regular::*;
use num_dual::HyperDual64;

/// Coordinates and velocities.
type Start = (Vec<f64>, Vec<f64>);

#[track_caller]
fn check<S, M>(system: &S, method: M, nodes: &Nodes, (q, v): &Start) -> Outcome
where
    S: Lagrangian + Lagrangian<HyperDual64>,
    M: Method<S, f64> + VariationalMethod<S, f64>,
    M: Clone + core::fmt::Debug,
{
    let (t, h, n) = (0.4, 0.07, q.len());
    let state = S::State::read(&|block| system.block_len(block), q, v);
    let mut run = Integrator::new_at(system, method.clone(), t, h, state)?;
    run.advance()?;
    let (interval, q1) = (Interval { t, h }, run.q());
    let mut map = TangentMap::new(system, &method);
    map.evaluate(system, interval, q, q1)?;
    let [d11, d12, _, d22] = map.hessian();
    for (matrix, first, second) in [(d11, 0, 0), (d12, 0, n), (d22, n, n)] {
        for k in 0..n * n {
            let (i, j) = (first + k / n, second + k % n);
            let entry = |place: usize, value: f64| {
                let unit = |on: bool| if on { 1.0 } else { 0.0 };
                HyperDual64::new(value, unit(place == i), unit(place == j), 0.0)
            };
            let a: Vec<_> = q.iter().enumerate().map(|(k, &q)| entry(k, q)).collect();
            let b: Vec<_> = q1.iter().enumerate().map(|(k, &q)| entry(n + k, q)).collect();
            let lagrangian = |q: &[_], v: &[_], t| system.lagrangian(q, v, t);
            let expected = nodes.discrete_lagrangian(lagrangian, [t, h], [&a, &b], &[]).eps1eps2;
            let error = (matrix[k] - expected).abs() / larger(1.0, expected.abs());
            assert!(error < 1e-13, "{}, {method:?}, ({i}, {j}): {} {expected}", S::REPORT.system, matrix[k]);
        }
    }
    let defect = map.symplectic_defect(system);
    assert!(defect < 1e-12, "{}, {method:?}: {defect:e}", S::REPORT.system);
    Ok(())
}

#[test]
fn second_derivatives_agree_with_hyper_dual_numbers() -> Outcome {
    let planar = (vec![0.5, 0.2], vec![0.4, -0.7]);
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    let driven = DrivenOscillator { depth: 0.3, omega: 2.0 };
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 1.5], coupling: 0.2 };
    for rule in
        [Quadrature::sigma(0.4), Quadrature::lobatto(2)?, Quadrature::lobatto(3)?, Quadrature::gauss(3)?]
    {
        let (linear, nodes) = (Variational::new(rule), &Nodes::new(rule.nodes(), rule.weights()));
        check(&pendulums, linear, nodes, &planar)?;
        check(&driven, linear, nodes, &(vec![0.4], vec![0.9]))?;
        check(&chain, linear, nodes, &(vec![0.1, -0.2, 0.3, 0.0], vec![0.5, 0.1, -0.4, 0.2]))?;
    }
    let prey = LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] };
    check(&prey, Sigma::midpoint(), &Nodes::new(&[0.5], &[1.0]), &(vec![1.3, 1.6], Vec::new()))
}

/// A pendulum on its head.
#[lagrangian(coordinates(a), lagrangian = dot(a).powi(2) / 2.0 + a.cos())]
#[derive(Clone, Debug)]
struct Pendulum;

#[test]
fn an_unstable_equilibrium_has_its_own_exponent() -> Outcome {
    // Störmer–Verlet on a'' = a: 2 cosh(λh) = 2 + h².
    let (h, start) = (0.1_f64, PendulumState { a: core::f64::consts::PI, dot_a: 0.0 });
    let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), h, start)?;
    let mut lyapunov = LyapunovExponent::new(&run);
    let mut settled = 0.0;
    for step in 0..250 {
        lyapunov.advance(&mut run)?;
        if step == 149 {
            settled = lyapunov.growth();
        }
    }
    let rate = (lyapunov.growth() - settled) / (100.0 * h);
    let exact = (1.0 + h * h / 2.0).acosh() / h;
    assert_abs_diff_eq!(rate, exact, epsilon = 1e-9);
    Ok(())
}
