//! One period of Kepler's problem against the values of independent programs: what the frequency is that is
//! read from the curvature.

use approx::assert_abs_diff_eq;
use core::f64::consts::TAU;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{KEPLER, pericentre};
use dvi_tests::{Outcome, larger};

#[test]
fn one_period_has_the_reference_values() -> Outcome {
    const STEPS: u32 = 200;
    let method = Variational::trapezoid().phase_fitted(Curvature(Reading::LeftFrozen));
    let mut run = Integrator::new(&KEPLER, method, TAU / f64::from(STEPS), pericentre(0.2))?;
    let (initial, mut largest) = (run.energy(), 0.0);
    for _ in 0..STEPS {
        run.advance()?;
        largest = larger(largest, (run.energy() - initial).abs());
    }
    assert_abs_diff_eq!(run.state().x, 0.799_914_909_563_45, epsilon = 1e-11);
    assert_abs_diff_eq!(run.state().y, -0.011_460_521_261_26, epsilon = 1e-11);
    assert_abs_diff_eq!(largest, 3.101_285_800_05e-4, epsilon = 1e-13);
    Ok(())
}
