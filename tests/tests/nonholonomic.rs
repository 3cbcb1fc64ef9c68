//! Constraints of the velocities: coordinates that are light against the others, states far from the origin,
//! and velocities of which little is left.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::nonholonomic::{
    Bundle, BundleState, BundleStateOf, KnifeEdge, KnifeEdgeState, KnifeEdgeStateOf,
};
use dvi_tests::{Numbers, Outcome, larger};

/// Two constraints that a light coordinate dominates.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (mass * dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - z * z / 2.0,
    nonholonomic = [dot(x) + dot(y) - dot(z), dot(x) - dot(y)],
)]
#[derive(Clone, Copy, Debug)]
struct Light {
    mass: f64,
}

/// With ẋ = ẏ and ż = 2ẋ there is one velocity u along (1, 1, 2) left, that nearest to the given one:
/// (m + 5)u = m ẋ + ẏ + 2ż.
#[test]
fn a_light_coordinate_is_projected() -> Outcome {
    for mass in [1e6, 1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-16, 1e-18, 1e-30] {
        let system = Light { mass };
        let state = LightState { x: 0.0, y: 0.0, z: 1.0, dot_x: 0.3, dot_y: 0.2, dot_z: 1.0 };
        let found = system.projected(0.0, &state)?;
        let u = (mass * 0.3 + 0.2 + 2.0) / (mass + 5.0);
        let off = [found.dot_x - u, found.dot_y - u, found.dot_z - 2.0 * u];
        assert!(off.iter().all(|off: &f64| off.abs() < 1e-15), "{mass:e} {off:?}");
        // (m + 5) ü = −2z with ż = 2u: an oscillator.
        let mut run = Integrator::new(&system, Constrained::new(Midpoint), 0.01, found)?;
        for _ in 0..1000 {
            run.advance()?;
            let LightState { dot_x, dot_y, dot_z, .. } = run.state();
            let off = [dot_x + dot_y - dot_z, dot_x - dot_y].map(f64::abs);
            assert!(off[0] < 1e-15 && off[1] < 1e-15, "{mass:e} {off:?}");
        }
        let (omega, t) = (2.0 / (mass + 5.0).sqrt(), 10.0_f64);
        let z = (omega * t).cos() + 2.0 * u / omega * (omega * t).sin();
        assert!(abs_diff_eq!(run.state().z, z, epsilon = 1e-3), "{mass:e} {} {z}", run.state().z);
        let multipliers = system.multipliers_at(0.0, &found)?;
        // ü = −2/(m + 5), λ₁ = z + ż' and λ₁ + λ₂ = m ü.
        let u = -2.0 / (mass + 5.0);
        let expected = [-(1.0 + 2.0 * u), mass * u + 1.0 + 2.0 * u];
        let apart = [multipliers[0] - expected[0], multipliers[1] - expected[1]].map(f64::abs);
        assert!(apart[0] < 1e-15 && apart[1] < 2e-15 * larger(1.0, expected[1].abs()), "{mass:e} {apart:?}");
    }
    Ok(())
}

const BLADE: KnifeEdge = KnifeEdge { m: 1.0, inertia: 1.0, slope: 0.0 };

fn at(x: f64, slip: f64) -> KnifeEdgeState {
    KnifeEdgeState { x, y: 0.0, angle: 0.0, dot_x: 1.0, dot_y: slip, dot_angle: 0.5 }
}

/// What counts as a slip does not depend on the origin of coordinates, or on the step.
#[test]
fn a_slip_is_one_everywhere() {
    for x in [0.0, 1.0, 6.4e6, 1e15] {
        for h in [1e-6, 1e-3, 1.0] {
            let begun = |slip| Integrator::new(&BLADE, Constrained::new(Midpoint), h, at(x, slip)).map(drop);
            assert_eq!(begun(1e-13), Ok(()));
            for slip in [1e-10, 1e-6, 0.01] {
                assert_eq!(
                    begun(slip),
                    Err(StartError::AcrossConstraint { constraint: 0, rate: -slip }),
                    "{x} {h}"
                );
            }
        }
    }
    let single = |slip: f32| KnifeEdgeStateOf {
        x: 1.0_f32,
        y: 0.0,
        angle: 0.0,
        dot_x: 1.0,
        dot_y: slip,
        dot_angle: 0.5,
    };
    let begun = |slip| Integrator::new(&BLADE, Constrained::new(Midpoint), 1e-3, single(slip)).map(drop);
    assert!(begun(1e-5).is_ok() && matches!(begun(0.01), Err(StartError::AcrossConstraint { .. })));
}

/// Rates of change there are, for integrators that go through such states.
#[test]
fn states_off_the_constraints_have_no_multipliers() -> Outcome {
    let off = StartError::AcrossConstraint { constraint: 0, rate: -5.0 };
    assert_eq!(BLADE.multipliers_at(0.0, &at(2.0, 5.0)).map(drop), Err(off));
    assert!(BLADE.vector_field(0.0, &at(2.0, 5.0)).is_ok());
    BLADE.multipliers_at(0.0, &at(2.0, 0.0))?;
    Ok(())
}

/// What is projected is a start with every step, wherever the system is and however fast, in double and in
/// single precision.
#[test]
fn what_is_projected_is_a_start() -> Outcome {
    let mut numbers = Numbers(5);
    for number in 0..3000 {
        let m = core::array::from_fn(|_| (20.0 * numbers.next()).exp());
        let a = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let b = core::array::from_fn(|_| core::array::from_fn(|_| core::array::from_fn(|_| numbers.next())));
        let affine = if number % 3 == 0 { 1.0 } else { 0.0 };
        let c = core::array::from_fn(|_| affine * numbers.next());
        let far = 10.0_f64.powf(8.0 * numbers.next());
        let speed = if number % 5 == 0 { 0.0 } else { 10.0_f64.powf(10.0 * numbers.next()) };
        let (q, dot_q) = (
            core::array::from_fn(|_| far * numbers.next()),
            core::array::from_fn(|_| speed * numbers.next()),
        );
        let system = Bundle { m, a, b, c };
        let start = system.projected(0.0, &BundleState { q, dot_q })?;
        for h in [1e-6, 1.0, 1e6] {
            Integrator::new(&system, Constrained::new(Midpoint), h, start)?;
        }
        system.multipliers_at(0.0, &start)?;
        let single = BundleStateOf { q: q.map(|x| x as f32), dot_q: dot_q.map(|x| x as f32) };
        let start = system.projected(0.0, &single)?;
        Integrator::new(&system, Constrained::new(Midpoint), 1e-3_f32, start)?;
    }
    Ok(())
}
