//! What the quadrature family keeps over many periods of Kepler's problem.

use core::f64::consts::TAU;
use dvi_core::discrete::{FrequencyIn, Rule};
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

#[test]
fn angular_momentum_is_conserved_by_every_reading() -> Outcome {
    let (system, e) = (Kepler { mu: 1.0 }, 0.5_f64);
    let pericentre = KeplerState { x: 1.0 - e, y: 0.0, dot_x: 0.0, dot_y: ((1.0 + e) / (1.0 - e)).sqrt() };
    fn drift<F: FrequencyIn<f64>, R: Rule>(
        system: &Kepler,
        start: KeplerState,
        method: Variational<F, R>,
    ) -> Outcome<f64> {
        let mut run = Integrator::new(system, method, TAU / 4000.0, start)?;
        let initial = run.momentum(0).ok_or("declared")?;
        let mut largest: f64 = 0.0;
        for _ in 0..100 {
            run.take_steps(4000)?;
            largest = larger(largest, (run.momentum(0).ok_or("declared")? - initial).abs());
        }
        Ok(largest)
    }
    let simpson = Variational::simpson();
    for found in [
        drift(&system, pericentre, Variational::trapezoid())?,
        drift(&system, pericentre, simpson)?,
        drift(&system, pericentre, simpson.phase_fitted(Constant(1.0)))?,
        drift(&system, pericentre, simpson.phase_fitted(Curvature(Reading::LeftFrozen)))?,
        drift(&system, pericentre, simpson.phase_fitted(Radial(Reading::Averaged)))?,
        drift(&system, pericentre, simpson.phase_fitted(Radial(Reading::Variational)))?,
    ] {
        assert!(found < 2e-10, "{found:e}");
    }
    Ok(())
}
