//! The σ-family: D₂L_d(q0, q1) + D₁L_d(q1, q2) = 0 at any three points of a run.

use dvi_core::prelude::*;
use dvi_core::{DegenerateLagrangian, State};
use dvi_tests::larger;

use super::equations::{Formula, Rule, defect, size, slots};
use super::systems::{Breathing, Driven, Guiding};
use super::{Outcome, START, STEPS};

const SOLVERS: [Solver; 3] = [Solver::Automatic, Solver::FixedPoint, Solver::Newton];

fn check<S: DegenerateLagrangian + Formula>(system: &S, start: &[f64], sigma: f64, steps: usize) -> Outcome {
    let name = S::REPORT.system;
    for (h, solver) in STEPS.into_iter().flat_map(|h| SOLVERS.map(|solver| (h, solver))) {
        // Each step is held against the equations, whatever becomes of the parasitic mode.
        let method = Sigma { solver, parasitic_limit: None, ..Sigma::new(sigma) };
        let state = S::State::read(|block| system.block_len(block), start, &[]);
        let mut run = Integrator::new_at(system, method, START, h, state)?;
        let mut points = vec![run.q().to_vec()];
        for _ in 0..steps {
            run.advance().map_err(|error| format!("{name}, sigma = {sigma}, {solver:?}: {error}"))?;
            points.push(run.q().to_vec());
        }
        let rule = Rule::new(&[sigma], &[1.0]);
        for (k, window) in points.windows(3).enumerate() {
            let [q0, q1, q2] = window else { return Err("a window of three".into()) };
            let t = START + k as f64 * h;
            let [_, left] = slots(system, &rule, [t, h], [q0, q1]);
            let [right, _] = slots(system, &rule, [t + h, h], [q1, q2]);
            let found = defect(&left, 1.0, &right) / (1.0 + size(&left) + size(q2));
            assert!(found < 1e-14, "{name}, sigma = {sigma}, {solver:?}, h = {h}, step {k}: {found:e}");
        }
    }
    Ok(())
}

#[test]
fn a_constant_matrix_with_time_in_the_form() -> Outcome {
    [0.0, 0.2, 0.5, 0.7, 1.0].into_iter().try_for_each(|sigma| check(&Driven {}, &[0.4, -0.3], sigma, 12))
}

#[test]
fn a_matrix_that_depends_on_time() -> Outcome {
    let system = Breathing { depth: 0.3 };
    [0.0, 0.2, 0.5, 0.7, 1.0].into_iter().try_for_each(|sigma| check(&system, &[0.4, -0.3], sigma, 8))
}

#[test]
fn a_form_that_is_not_linear() -> Outcome {
    let system = Guiding { kappa: 0.4 };
    let start = [0.6, -0.5, 0.2, 0.7];
    // Parasites grow where σ is not one half.
    [(0.4, 4), (0.5, 10), (0.6, 4)]
        .into_iter()
        .try_for_each(|(sigma, steps)| check(&system, &start, sigma, steps))
}

/// q(t) of the flow of α = ½(x dy − y dx) + t dx and H = 2x is y = y0 + 3t, x = x0: (Dα)ᵀ − Dα times q′ is
/// ∇H + ∂α/∂t.
#[test]
fn the_rate_of_the_form_drives_the_flow() -> Outcome {
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = (x * d(y) - y * d(x)) / 2.0 + t * d(x),
        hamiltonian = 2.0 * x,
    )]
    struct Ramp {}
    for (h, solver) in STEPS.into_iter().flat_map(|h| SOLVERS.map(|solver| (h, solver))) {
        for sigma in [0.0, 0.3, 0.5, 1.0] {
            let method = Sigma { solver, parasitic_limit: None, ..Sigma::new(sigma) };
            let start = RampState { x: 1.0, y: 0.0 };
            let mut run = Integrator::new_at(&Ramp {}, method, START, h, start)?;
            run.take_steps(10)?;
            let (expected, RampState { x, y }) = (3.0 * 10.0 * h, run.state());
            let apart = larger((x - 1.0).abs(), (y - expected).abs());
            assert!(
                apart < 1e-13,
                "sigma = {sigma}, {solver:?}, h = {h}: ({x}, {y}), expected (1, {expected})"
            );
        }
    }
    Ok(())
}
