//! How large the mode is that a start leaves, and how large it is measured.

use dvi_core::prelude::*;
use dvi_tests::configurations::chaotic;
use dvi_tests::larger;
use dvi_tests::systems::*;

use super::{Outcome, curved, fourth_order, prey};

/// A one-form and a Hamiltonian that depend on time.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + 0.3 * t.sin() + 0.2 * x * x) * (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = (x * x + y * y) / 2.0 + 0.1 * x * t.cos(),
)]
struct Driven;

/// What the central difference of order 16 leaves of the first 17 points of a run: of the motion, (h/2)¹⁶
/// times a derivative.
fn first_amplitude<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
) -> Outcome<f64> {
    let mut run = Integrator::new(system, method, h, start.clone())?;
    let mut sums = vec![0.0; run.q().len()];
    // (−1)ʲ (16 over j)/2¹⁶
    let mut weight = 1.0 / 65536.0;
    for j in 0..=16_u8 {
        for (sum, q) in sums.iter_mut().zip(run.q()) {
            *sum += weight * q;
        }
        weight *= -(16.0 - f64::from(j)) / (f64::from(j) + 1.0);
        run.advance()?;
    }
    Ok(sums.iter().fold(0.0, |largest: f64, sum| larger(largest, sum.abs())))
}

/// The amplitudes that both starts leave at h and at h/2 fall with these powers of h.
fn falls<S: DegenerateLagrangian>(
    (system, start): &(S, S::State<f64>),
    sigma: f64,
    h: f64,
    [least, most]: [f64; 2],
) -> Outcome {
    for second in [Start::Consistent, Start::RungeKutta(RungeKutta::midpoint())] {
        let method = Sigma { start: second, parasitic_limit: None, ..Sigma::new(sigma) };
        let amplitude = |h: f64| first_amplitude(system, method, h, start);
        let (coarse, fine) = (amplitude(h)?, amplitude(h / 2.0)?);
        let slope = (coarse / fine).log2();
        let name = format!("{}, σ = {sigma}, {second:?}: {coarse:e}, {fine:e}", S::REPORT.system);
        assert!(slope > least && slope < most, "{name}: {slope}");
    }
    Ok(())
}

#[test]
fn a_start_by_a_step_leaves_a_mode_of_third_or_second_order() -> Outcome {
    let third = [2.8, 3.6];
    for sigma in [0.0, 0.25, 1.0] {
        falls(&chaotic(), sigma, 0.2, third)?;
    }
    falls(&prey(), 0.5, 0.1, third)?;
    falls(&curved(), 0.5, 0.1, third)?;
    falls(&(Driven, DrivenState { x: 0.8, y: 0.3 }), 0.5, 0.2, third)?;
    // Where the mode is not just reversed from step to step.
    falls(&(Oblique, ObliqueState { x: 0.8, y: 0.3 }), 0.25, 0.2, [1.9, 2.7])?;
    let sphere = (SphereForm { gamma: 1.0 }, SphereFormState { phi: 0.8, z: 0.3 });
    falls(&sphere, 0.25, 0.05, [1.5, 2.2])
}

/// An alternating part that is put in is what is measured, for every σ.
#[test]
fn the_amplitude_is_that_of_the_alternating_part() -> Outcome {
    let system = Oscillator { omega: 1.0 };
    let h = 0.01_f64;
    for sigma in [0.0, 0.25, fourth_order(), 0.5] {
        let start = OscillatorState { x: 1.0, y: 0.0 };
        // (−1)ᵏa on top of the motion.
        let a = 1e-4;
        let second = OscillatorState { x: h.cos() - 2.0 * a, y: h.sin() };
        let method = Sigma { parasitic_limit: None, ..Sigma::new(sigma) };
        let mut run = Integrator::from_two_points(&system, method, h, start, second)?;
        assert_eq!(run.memory().parasitic_mode(), None);
        run.take_steps(257)?;
        let Some(ParasiticMode { amplitude, relative, is_significant }) = run.memory().parasitic_mode()
        else {
            return Err("measured after 256 steps".into());
        };
        // The mode turns too, at (1 − 2σ)² times the rate of the motion; its norm is that of the second
        // point.
        assert!(amplitude > 0.7 * a && amplitude < 1.01 * a, "σ = {sigma}: {amplitude:e}");
        // 16a alternates in the differences of D, and 2h² of a circle does not.
        let expected = 8.0 * a / (2.0 * h * h);
        assert!(
            relative > 0.5 * expected && relative < 8.0 * expected,
            "σ = {sigma}: {relative} {expected}"
        );
        assert!(is_significant);
    }
    Ok(())
}
