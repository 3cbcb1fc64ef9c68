//! Newmark's method: stability, and what is refused.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::*;

#[test]
fn average_acceleration_is_stable_at_every_step() -> Outcome {
    let start = SpringState { x: 1.0, dot_x: 0.0 };
    let mut run = Integrator::new(&SPRING, Newmark::new(0.25), 50.0, start)?;
    for _ in 0..1000 {
        run.advance()?;
        assert_abs_diff_eq!(run.energy(), 0.5, epsilon = 1e-11);
    }
    Ok(())
}

#[test]
fn a_beta_out_of_range_is_refused() {
    for beta in [-0.1, 0.6, f64::NAN] {
        let failure = Integrator::new(&KEPLER, Newmark::new(beta), 0.1, pericentre(0.3)).err();
        assert!(matches!(failure, Some(StartError::Parameter { name: "beta", .. })), "{failure:?}");
    }
}
