//! How large the mode is measured.

use dvi_core::prelude::*;
use dvi_tests::systems::{Oscillator, OscillatorState};

use super::{Outcome, fourth_order};

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
