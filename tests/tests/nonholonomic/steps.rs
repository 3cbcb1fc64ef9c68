//! Steps on constraints of the velocities.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::nonholonomic::*;

use super::Outcome;

const BLADE: KnifeEdge = KnifeEdge { m: 1.5, inertia: 0.7, slope: 0.8 };

/// It goes down and up again while it turns, and drifts across the slope (Bloch 2015, section 1.6).
fn blade(t: f64) -> KnifeEdgeState {
    let (omega, slope) = (1.3, BLADE.slope);
    let ((sin, cos), a) = ((omega * t).sin_cos(), slope / (2.0 * omega * omega));
    KnifeEdgeState {
        x: a * sin * sin,
        y: a * (omega * t - sin * cos),
        angle: omega * t,
        dot_x: slope / omega * sin * cos,
        dot_y: slope / omega * sin * sin,
        dot_angle: omega,
    }
}

/// The acceleration of the motion in closed form, and its multiplier.
#[test]
fn a_knife_edge_moves_as_in_closed_form() -> Outcome {
    // The multiplier is the force across the blade: ẍ = λ sin/m + slope.
    for t in [0.4, 1.1, 2.9] {
        let (state, sin) = (blade(t), (1.3 * t).sin());
        let rates = BLADE.vector_field(0.0, &state)?;
        let acceleration = BLADE.slope * (2.0 * 1.3 * t).cos();
        assert_abs_diff_eq!(rates.dot_x, acceleration, epsilon = 1e-14);
        let multiplier = BLADE.multipliers_at(0.0, &state)?[0];
        assert_abs_diff_eq!(multiplier * sin / BLADE.m + BLADE.slope, acceleration, epsilon = 1e-14);
    }
    Ok(())
}
