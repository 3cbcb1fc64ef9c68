//! The quadrature family: p0 = −D₁L_d(q0, q1) and p1 = D₂L_d(q0, q1).

use dvi_core::State;
use dvi_core::discrete::{FrequencyIn, Rule as Nodes};
use dvi_core::prelude::*;
use dvi_tests::larger;

use super::equations::{Formula, Rule, defect, size, slots};
use super::systems::{Coupled, Fast, Magnetic, Shaken};
use super::{Outcome, START, STEPS};

const OMEGA: f64 = 1.3;

fn check<S, F, R>(system: &S, method: Variational<F, R>, omega: f64, (q, v): (&[f64], &[f64])) -> Outcome
where
    S: RegularLagrangian + Formula,
    F: FrequencyIn<f64> + Copy,
    R: Nodes,
{
    let name = S::REPORT.system;
    let mut solvers = vec![Solver::Automatic, Solver::Newton];
    if S::SEPARABLE {
        solvers.push(Solver::FixedPoint);
    }
    for (h, solver) in STEPS.into_iter().flat_map(|h| solvers.iter().map(move |solver| (h, *solver))) {
        let method = Variational { solver, ..method };
        let rule = Rule::new(method.rule.nodes(), method.rule.weights()).fitted(omega);
        let rule =
            if method.fitting == Fitting::PhaseAndMomentum { rule.with_fitted_momenta(h) } else { rule };
        let state = S::State::read(|block| system.block_len(block), q, v);
        let mut run = Integrator::new_at(system, method, START, h, state)?;
        for step in 0..5 {
            let (t, q0, p0) = (run.time(), run.q().to_vec(), run.memory().p().to_vec());
            run.advance().map_err(|error| format!("{name}, {method:?}: {error}"))?;
            let (q1, p1) = (run.q(), run.memory().p());
            let [left, right] = slots(system, &rule, [t, h], [&q0, q1]);
            let scale = 1.0 + size(&p0) + size(p1) + size(q1) / h.abs();
            let found = larger(defect(&p0, 1.0, &left), defect(p1, -1.0, &right)) / scale;
            assert!(found < 2e-14, "{name}, {method:?}, h = {h}, step {step}: {found:e}");
        }
    }
    Ok(())
}

fn check_rule<R: Nodes + Copy>(rule: R) -> Outcome {
    let linear = Variational::new(rule);
    let fitted = linear.phase_fitted(Constant(OMEGA));
    let both = Variational { fitting: Fitting::PhaseAndMomentum, ..fitted };
    let planar: (&[f64], &[f64]) = (&[0.5, -0.2], &[0.4, -0.3]);
    let line: (&[f64], &[f64]) = (&[0.2, -0.1, 0.4], &[0.3, 0.5, -0.2]);
    let (shaken, magnetic, fast) = (Shaken { depth: 0.4 }, Magnetic { b: 0.7 }, Fast { field: 0.6 });
    let coupled = Coupled { mass: vec![1.0, 2.0, 1.5] };
    for (omega, fitting) in [(0.0, None), (OMEGA, Some(fitted)), (OMEGA, Some(both))] {
        match fitting {
            None => {
                check(&shaken, linear, omega, planar)?;
                check(&coupled, linear, omega, line)?;
                check(&magnetic, linear, omega, planar)?;
                check(&fast, linear, omega, planar)?;
            }
            Some(method) => {
                check(&shaken, method, omega, planar)?;
                check(&coupled, method, omega, line)?;
                check(&magnetic, method, omega, planar)?;
                check(&fast, method, omega, planar)?;
            }
        }
    }
    Ok(())
}

#[test]
fn midpoint() -> Outcome {
    check_rule(Variational::midpoint().rule)
}

#[test]
fn trapezoid() -> Outcome {
    check_rule(Variational::trapezoid().rule)
}

#[test]
fn simpson() -> Outcome {
    check_rule(Variational::simpson().rule)
}

#[test]
fn one_node() -> Outcome {
    [0.0, 0.3, 1.0].into_iter().try_for_each(|sigma| check_rule(Variational::sigma(sigma).rule))
}

/// Nodes in any order and weights of both signs.
#[test]
fn rules_without_symmetry() -> Outcome {
    check_rule(Quadrature::new(&[0.9, 0.1, 0.4], &[0.5, 0.75, -0.25])?)?;
    check_rule(Quadrature::new(&[0.0, 1.0 / 3.0, 0.5, 0.8, 1.0], &[0.1, 0.3, 0.2, 0.25, 0.15])?)
}
