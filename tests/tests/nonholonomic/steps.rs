//! Steps on constraints of the velocities.

use approx::{assert_abs_diff_eq, relative_eq};
use dvi_core::error::StartError;
use dvi_core::prelude::*;
use dvi_examples::models::{RollingDisc, RollingDiscState};
use dvi_tests::larger;
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

const PARTICLE: ParticleState =
    ParticleState { x: 1.0, y: 0.5, z: 0.2, dot_x: 0.4, dot_y: -0.8, dot_z: 0.2 };

/// The energy of the particle has no trend over twenty thousand steps.
#[test]
fn the_energy_of_a_reversible_motion_has_no_trend() -> Outcome {
    let mut run = Integrator::new(&Particle, Constrained::new(Variational::midpoint()), 0.1, PARTICLE)?;
    let begin = run.energy();
    let mut quarters = [0.0_f64; 4];
    for quarter in &mut quarters {
        for _ in 0..5_000 {
            run.advance()?;
            *quarter = larger(*quarter, (run.energy() - begin).abs());
        }
    }
    assert!(quarters.iter().all(|&error| error < 4e-3), "{quarters:?}");
    assert!(relative_eq!(quarters[3], quarters[0], epsilon = 0.0, max_relative = 0.02), "{quarters:?}");
    Ok(())
}

#[test]
fn a_velocity_across_a_constraint_is_an_error_that_names_it() -> Outcome {
    let disc = RollingDisc { radius: 0.4, stiffness: [0.0; 2], field: [0.0; 2], gradient: 0.0 };
    let state = RollingDiscState { dot_y: 0.5, ..disc.rolling([0.0; 2], 0.0, [2.0, 1.0]) };
    let begun = Integrator::new(&disc, Constrained::new(Variational::midpoint()), 0.1, state).map(drop);
    let Err(StartError::AcrossConstraint { constraint, rate }) = begun else { panic!("{begun:?}") };
    assert!(constraint == 1 && (rate - 0.5).abs() < 1e-15, "{constraint} {rate}");
    let projected: RollingDiscState = disc.projected(0.0, &state)?;
    assert!((projected.dot_y).abs() < 1e-15 && (projected.dot_phi - 1.0).abs() < 1e-15);
    Integrator::new(&disc, Constrained::new(Variational::midpoint()), 0.1, projected)?.take_steps(10)?;
    Ok(())
}
