//! One period of Kepler's problem against the values of independent programs.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use core::f64::consts::TAU;
use dvi_core::discrete::{Frequency, Rule};
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{KEPLER, KeplerState, pericentre};

type Period = (KeplerState, f64);

/// The state after one period of `steps` steps, and max |ΔE| on the way.
fn period<F: Frequency, R: Rule>(method: Variational<F, R>, e: f64, steps: u64) -> Outcome<Period> {
    let mut run = Integrator::new(&KEPLER, method, TAU / steps as f64, pericentre(e))?;
    let initial = run.energy();
    let mut largest: f64 = 0.0;
    for _ in 0..steps {
        run.advance()?;
        largest = larger(largest, (run.energy() - initial).abs());
    }
    Ok((run.state(), largest))
}

#[test]
fn one_period_has_the_reference_values() -> Outcome {
    let (verlet, energy) = period(Variational::trapezoid(), 0.2, 200)?;
    assert!(abs_diff_eq!(verlet.x, 0.799_989_183_048_22, epsilon = 1e-11), "{verlet:?}");
    assert!((verlet.y + 0.004_327_113_757_24).abs() < 1e-11, "{verlet:?}");
    assert_abs_diff_eq!(energy, 1.287_935_994_34e-4, epsilon = 1e-13);
    let fitted = Variational::trapezoid().phase_fitted(Curvature(Reading::LeftFrozen));
    let (fitted, energy) = period(fitted, 0.2, 200)?;
    assert!(abs_diff_eq!(fitted.x, 0.799_914_909_563_45, epsilon = 1e-11), "{fitted:?}");
    assert!((fitted.y + 0.011_460_521_261_26).abs() < 1e-11, "{fitted:?}");
    assert_abs_diff_eq!(energy, 3.101_285_800_05e-4, epsilon = 1e-13);
    Ok(())
}
