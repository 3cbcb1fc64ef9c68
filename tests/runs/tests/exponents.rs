//! Lyapunov exponents.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::systems::*;

#[test]
fn a_saddle_has_its_own_exponent() -> Outcome {
    // H = ½z² + cos φ, α = −z dφ: near φ = 0 the midpoint rule grows by (1 + h/2)/(1 − h/2) a step.
    let (system, start) = (SphereForm { gamma: 1.0 }, SphereFormState { phi: 0.0, z: 0.0 });
    let h: f64 = 0.1;
    let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
    let mut lyapunov = LyapunovExponent::new(&run);
    for _ in 0..200 {
        lyapunov.advance(&mut run)?;
    }
    let settled = lyapunov.growth();
    for _ in 0..200 {
        lyapunov.advance(&mut run)?;
    }
    let rate = (lyapunov.growth() - settled) / 20.0;
    let exact = ((1.0 + h / 2.0) / (1.0 - h / 2.0)).ln() / h;
    assert!(abs_diff_eq!(rate, exact, epsilon = 1e-12), "{rate} and {exact}");
    Ok(())
}
