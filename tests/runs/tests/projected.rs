//! The projected scheme in many steps.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// By order h⁴ per unit of time, where nothing reverses the motion.
#[test]
fn an_energy_drifts_by_its_order() -> Outcome {
    #[degenerate_lagrangian(
        coordinates(phi, j, x, y),
        one_form = (j + 0.3 * x * x + 0.2 * j * y) * d(phi) + (y + 0.1 * y.powi(3) + 0.2 * j * j * x) * d(x)
            + 0.2 * x * y * d(y) + 0.1 * x * y * d(j),
        hamiltonian = j * j / 2.0 + (x * x + y * y) / 2.0 + 0.1 * j * x + 0.1 * x.powi(3),
    )]
    struct Angle;
    let drift = |h: f64| -> Outcome<f64> {
        let steps = (8_000.0 / h) as u64;
        let start = AngleState { phi: 0.1, j: 0.8, x: 0.3, y: -0.2 };
        let mut run = Integrator::new(&Angle, Projected::symmetric(), h, start)?;
        let mut means = [0.0; 2];
        for mean in &mut means {
            for _ in 0..steps / 2 {
                run.advance()?;
                *mean += run.energy() / (steps / 2) as f64;
            }
        }
        Ok((means[1] - means[0]).abs() / (0.5 * h * steps as f64))
    };
    let drifts = [(0.2, drift(0.2)?), (0.1, drift(0.1)?)];
    let found = convergence_order(&drifts).ok_or("no slope")?;
    assert!(abs_diff_eq!(found, 4.0, epsilon = 0.7), "{drifts:?}");
    Ok(())
}
