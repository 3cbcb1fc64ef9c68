//! What the quadrature family keeps over many periods of Kepler's problem.

use core::f64::consts::TAU;
use dvi_core::discrete::{FrequencyIn, Rule};
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{KEPLER, pericentre};

#[test]
fn angular_momentum_is_conserved_by_every_reading() -> Outcome {
    fn drift<F: FrequencyIn<f64>, R: Rule>(method: Variational<F, R>) -> Outcome<f64> {
        let mut run = Integrator::new(&KEPLER, method, TAU / 4000.0, pericentre(0.5))?;
        let (initial, mut largest) = (run.momentum(0).ok_or("declared")?, 0.0_f64);
        for _ in 0..400_000 {
            run.advance()?;
            largest = larger(largest, (run.momentum(0).ok_or("declared")? - initial).abs());
        }
        Ok(largest)
    }
    let simpson = Variational::simpson();
    for found in [
        drift(Variational::trapezoid())?,
        drift(simpson)?,
        drift(simpson.phase_fitted(Constant(1.0)))?,
        drift(simpson.phase_fitted(Curvature(Reading::LeftFrozen)))?,
        drift(simpson.phase_fitted(Radial(Reading::Averaged)))?,
        drift(simpson.phase_fitted(Radial(Reading::Variational)))?,
        drift(Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational)))?,
    ] {
        assert!(found < 2e-10, "{found:e}");
    }
    Ok(())
}
