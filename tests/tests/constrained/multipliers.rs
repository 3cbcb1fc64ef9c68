//! Multipliers, against the same motion in coordinates without constraints, and constraints of which there
//! are none.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::apart;
use dvi_tests::zoo::constrained::*;

use super::Outcome;

const TIME: f64 = 2.0;

/// To order two in the middle of the step.
#[test]
fn multipliers_of_a_step_are_those_of_the_motion() -> Outcome {
    let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
    let system = Double { m: angles.m, rod: angles.rod };
    let begin = DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 };
    let mut errors = [const { Vec::new() }; 2];
    for steps in [48, 72, 96, 144_u64] {
        let h = TIME / steps as f64;
        let start = angles.masses(&begin);
        let mut rattle = Integrator::new(&system, Rattle::default(), h, start)?;
        let mut general = Integrator::new(&system, Constrained::new(Midpoint), h, start)?;
        rattle.take_steps(steps / 2)?;
        general.take_steps(steps / 2)?;
        let mut exact = Integrator::new(&angles, Gauss::<4>::new(), h / 2.0, begin)?;
        exact.take_steps(steps - 1)?;
        let expected = system.multipliers_at(0.0, &angles.masses(&exact.state()))?;
        let off = |found: Vec<f64>| apart(&found, &expected);
        errors[0].push((h, off(rattle.memory().multipliers().collect())));
        errors[1].push((h, off(general.memory().multipliers().collect())));
    }
    for errors in errors {
        let order = convergence_order(&errors).ok_or("no slope")?;
        assert!(abs_diff_eq!(order, 2.0, epsilon = 0.12), "{order}, {errors:?}");
    }
    Ok(())
}

/// Masses, and rods between as many of them as is said.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| (1.0 + i as f64) * dot(x[i]).powi(2) / 2.0 - x[i].powi(4) / 4.0),
    constraint(k in 0..rods) = x[k] - x[k + 1] - 1.0,
)]
#[derive(Clone, Copy, Debug)]
struct Rods {
    rods: usize,
}

/// The same masses without any.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| (1.0 + i as f64) * dot(x[i]).powi(2) / 2.0 - x[i].powi(4) / 4.0),
)]
#[derive(Clone, Copy, Debug)]
struct Free;

/// With no constraint among those that are declared, a step is that of Störmer and Verlet, bit by bit.
#[test]
fn without_a_constraint_rattle_is_verlet() -> Outcome {
    let (x, dot_x) = ([0.3, -0.8], [1.0, 0.7]);
    let mut rattle = Integrator::new(&Rods { rods: 0 }, Rattle::default(), 0.1, RodsState { x, dot_x })?;
    let mut verlet = Integrator::new(&Free, Variational::trapezoid(), 0.1, FreeState { x, dot_x })?;
    for _ in 0..100 {
        rattle.advance()?;
        verlet.advance()?;
        assert_eq!(rattle.q(), verlet.q());
        assert_eq!(rattle.state().dot_x, verlet.state().dot_x);
    }
    Ok(())
}
