//! Arenstorf's orbit in the frame that turns with the Earth and the Moon: where it closes, and as p dq − H.

use approx::abs_diff_eq;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::{
    RestrictedThreeBody, RestrictedThreeBodyForm, RestrictedThreeBodyFormState, RestrictedThreeBodyState,
};

const MU: f64 = 0.012_277_471;
/// Where it begins, at rest along x, and its period (Hairer, Nørsett & Wanner 1993, section II.0).
const X: f64 = 0.994;
const DOT_Y: f64 = -2.001_585_106_379_082_5;
const PERIOD: f64 = 17.065_216_560_157_964;
const STEPS: u64 = 20_000;

/// The coordinates after a share of the period, and the velocities or momenta.
fn after<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    parts: u64,
    start: S::State<f64>,
) -> Outcome<Vec<f64>> {
    let mut run = Integrator::new(system, method, PERIOD / STEPS as f64, start)?;
    run.take_steps(STEPS / parts)?;
    Ok(system.values(&run.state())?.collect())
}

#[test]
fn arenstorfs_orbit_closes() -> Outcome {
    let system = RestrictedThreeBody { mu: MU };
    let form = RestrictedThreeBodyForm { mu: MU };
    let start = RestrictedThreeBodyState { x: X, y: 0.0, dot_x: 0.0, dot_y: DOT_Y };
    let start_of_form = RestrictedThreeBodyFormState { x: X, y: 0.0, p_x: 0.0, p_y: DOT_Y + X };
    let gauss = Gauss::<8>::new();
    for ends in [after(&system, gauss, 1, start)?, after(&system, gauss.in_lanes(), 1, start)?] {
        for (found, exact) in ends.iter().zip([X, 0.0, 0.0, DOT_Y]) {
            assert!(abs_diff_eq!(*found, exact, epsilon = 1e-6), "{ends:?}");
        }
    }
    // Before rounding errors have grown: v = p + (y, −x).
    let [x, y, p_x, p_y] = after(&form, gauss, 8, start_of_form)?[..] else { panic!("four coordinates") };
    for ends in [after(&system, gauss, 8, start)?, after(&system, gauss.in_lanes(), 8, start)?] {
        for (found, other) in ends.iter().zip([x, y, p_x + y, p_y - x]) {
            assert!(abs_diff_eq!(*found, other, epsilon = 1e-11), "{ends:?} and {:?}", [x, y, p_x, p_y]);
        }
    }
    Ok(())
}
