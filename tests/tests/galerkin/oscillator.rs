//! What fitting does on the oscillator that it is fitted to.

use approx::abs_diff_eq;
use dvi_core::discrete::FrequencyIn;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

use super::Outcome;

#[test]
fn on_the_fitted_oscillator_three_nodes_have_their_closed_form() -> Outcome {
    // With q0 = E − O, q1 = E + O, L_d is (h/2)(λ E² + μ O²), and cos θ = (μ + λ)/(μ − λ). Without
    // displacement λ = −u²S/cos²(u/2), μ = u²S/sin²(u/2), S = (2 + cos u)/3, which would be exact; the
    // displacement of the middle node sees E only, and takes g²/H from λ.
    let start = SpringState { x: 0.6, dot_x: 0.9 };
    for u in [0.1, 0.5, 1.0, 1.5] {
        let half: f64 = u / 2.0;
        let s = (2.0 + u.cos()) / 3.0;
        let g = (4.0 * u * half.sin() - 2.0 * u * u) / (3.0 * half.cos());
        let lambda = -s * (u / half.cos()).powi(2) - g * g / (16.0 / 3.0 - 2.0 / 3.0 * u * u);
        let mu = s * (u / half.sin()).powi(2);
        let cosine = (mu + lambda) / (mu - lambda);
        let method = Galerkin::<3>::new().phase_fitted(Constant(2.0));
        let system = Spring { stiffness: 4.0 };
        let mut run = Integrator::new(&system, method, u / 2.0, start)?;
        let mut window = [run.q()[0]; 3];
        for step in 0..200 {
            run.advance()?;
            window = [window[1], window[2], run.q()[0]];
            let residual = window[0] - 2.0 * cosine * window[1] + window[2];
            assert!(step == 0 || residual.abs() < 2e-14, "u = {u}, step {step}: {residual:e}");
        }
    }
    Ok(())
}

/// The error of the angle of one step on the oscillator.
fn phase_error<F: FrequencyIn<f64>, const NODES: usize>(method: Galerkin<NODES, F>, u: f64) -> Outcome<f64> {
    let system = Spring { stiffness: 1.0 };
    let mut run = Integrator::new(&system, method, u, SpringState { x: 1.0, dot_x: 0.3 })?;
    let first = run.q()[0];
    run.advance()?;
    let second = run.q()[0];
    run.advance()?;
    Ok((((first + run.q()[0]) / (2.0 * second)).acos() - u).abs())
}

#[test]
fn fitted_interpolation_gains_two_orders_of_phase() -> Outcome {
    fn check<const NODES: usize>(u: [f64; 2]) -> Outcome
    where
        Galerkin<NODES>: Tabulated,
    {
        let (plain, fitted) =
            (Galerkin::<NODES>::new(), Galerkin::<NODES>::new().phase_fitted(Constant(1.0)));
        let ratio = (u[1] / u[0]).ln();
        let by_plain = (phase_error(plain, u[1])? / phase_error(plain, u[0])?).ln() / ratio;
        let by_fitted = (phase_error(fitted, u[1])? / phase_error(fitted, u[0])?).ln() / ratio;
        assert!(abs_diff_eq!(by_plain, (2 * NODES - 1) as f64, epsilon = 0.2), "{NODES} nodes: {by_plain}");
        assert!(
            abs_diff_eq!(by_fitted, (2 * NODES + 1) as f64, epsilon = 0.2),
            "{NODES} nodes: {by_fitted}"
        );
        Ok(())
    }
    check::<3>([0.3, 0.6])?;
    check::<4>([0.6, 0.9])?;
    check::<5>([1.0, 1.3])
}
