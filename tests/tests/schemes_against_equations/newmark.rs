//! Newmark's method: M(x1 − x0)/h = p0 + h[(½ − β)F0 + βF1] and p1 = p0 + (h/2)(F0 + F1), with F = ∂L/∂q.

use dvi_core::prelude::*;
use dvi_core::{Separable, State};
use dvi_tests::larger;

use super::equations::{Formula, dual};
use super::systems::{Coupled, Shaken};
use super::{Outcome, START, STEPS};

/// ∂L/∂q at rest, and M v = ∂L/∂v, by dual numbers.
fn force<F: Formula>(formula: &F, q: &[f64], t: f64) -> Vec<f64> {
    let rest = dual(&vec![0.0; q.len()], None);
    (0..q.len()).map(|i| formula.lagrangian(&dual(q, Some(i)), &rest, t.into()).eps).collect()
}

fn momentum<F: Formula>(formula: &F, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
    (0..q.len()).map(|i| formula.lagrangian(&dual(q, None), &dual(v, Some(i)), t.into()).eps).collect()
}

fn check<S: Separable + RegularLagrangian + Formula>(system: &S, q: &[f64], v: &[f64]) -> Outcome {
    let name = S::REPORT.system;
    for (h, beta) in STEPS.into_iter().flat_map(|h| [0.0, 1.0 / 12.0, 0.25, 0.5].map(|beta| (h, beta))) {
        for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
            let method = Newmark { solver, ..Newmark::new(beta) };
            let state = S::State::read(|block| system.block_len(block), q, v);
            let mut run = Integrator::new_at(system, method, START, h, state)?;
            for step in 0..8 {
                let (t, x0, p0) = (run.time(), run.q().to_vec(), run.memory().p().to_vec());
                run.advance().map_err(|error| format!("{name}, {method:?}: {error}"))?;
                let (x1, p1) = (run.q(), run.memory().p());
                let (f0, f1) = (force(system, &x0, t), force(system, x1, t + h));
                let mean: Vec<f64> = x0.iter().zip(x1).map(|(x0, x1)| (x1 - x0) / h).collect();
                let carried = momentum(system, &x0, &mean, t);
                for i in 0..x0.len() {
                    let position = carried[i] - p0[i] - h * ((0.5 - beta) * f0[i] + beta * f1[i]);
                    let kick = p1[i] - p0[i] - h / 2.0 * (f0[i] + f1[i]);
                    let scale = 1.0 + p0[i].abs() + x1[i].abs() / h.abs();
                    let found = larger(position.abs(), kick.abs()) / scale;
                    assert!(found < 2e-14, "{name}, {method:?}, h = {h}, step {step}: {found:e}");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn a_potential_that_depends_on_time() -> Outcome {
    check(&Shaken { depth: 0.4 }, &[0.5, -0.2], &[0.4, -0.3])
}

#[test]
fn a_mass_matrix_that_is_not_diagonal() -> Outcome {
    check(&Coupled { mass: vec![1.0, 2.0, 1.5] }, &[0.2, -0.1, 0.4], &[0.3, 0.5, -0.2])
}
