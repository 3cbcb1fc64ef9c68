//! Projected schemes in many steps, on the guiding centre in a magnetic mirror.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::particles::{Mirror, MirrorState};

use crate::one_step::energy_errors;

/// The largest energy error within the first tenth of the steps, and within all.
fn errors(method: Projected, steps: u64) -> Result<[f64; 2], StepError> {
    let start = MirrorState { x: 0.4, y: 0.3, z: 0.2, u: 0.5 };
    energy_errors(Integrator::new(&Mirror, method, 0.1, start).expect("starts"), [steps / 10, steps])
}

#[test]
fn the_symmetric_projection_keeps_the_energy_and_the_standard_one_does_not() -> Result<(), StepError> {
    let [early, all] = errors(Projected::symmetric(), 200_000)?;
    assert!(all < 1.01 * early, "{early:e} and {all:e}");
    let [early, all] = errors(Projected::standard(), 200_000)?;
    assert!(all > 8.0 * early, "{early:e} and {all:e}");
    Ok(())
}

/// By order h⁴ per unit of time, where nothing reverses the motion, and by h³ for the standard projection.
#[test]
fn energies_drift_by_their_orders() -> Outcome {
    #[degenerate_lagrangian(
        coordinates(phi, j, x, y),
        one_form = (j + 0.3 * x * x + 0.2 * j * y) * d(phi) + (y + 0.1 * y.powi(3) + 0.2 * j * j * x) * d(x)
            + 0.2 * x * y * d(y) + 0.1 * x * y * d(j),
        hamiltonian = j * j / 2.0 + (x * x + y * y) / 2.0 + 0.1 * j * x + 0.1 * x.powi(3),
    )]
    struct Angle;
    let drift = |method: Projected, h: f64| -> Outcome<f64> {
        let steps = (8_000.0 / h) as u64;
        let start = AngleState { phi: 0.1, j: 0.8, x: 0.3, y: -0.2 };
        let mut run = Integrator::new(&Angle, method, h, start)?;
        let mut means = [0.0; 2];
        for mean in &mut means {
            for _ in 0..steps / 2 {
                run.advance()?;
                *mean += run.energy() / (steps / 2) as f64;
            }
        }
        Ok((means[1] - means[0]).abs() / (0.5 * h * steps as f64))
    };
    for (method, order) in [(Projected::symmetric(), 4.0), (Projected::standard(), 3.0)] {
        let drifts = [(0.2, drift(method, 0.2)?), (0.1, drift(method, 0.1)?)];
        let found = convergence_order(&drifts).ok_or("no slope")?;
        assert!(abs_diff_eq!(found, order, epsilon = 0.7), "{method:?}: {drifts:?}");
    }
    Ok(())
}
