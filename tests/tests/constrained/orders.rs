//! The order of multipliers, against the same motion in coordinates without constraints.

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
        let mut general = Integrator::new(&system, Constrained::new(Variational::midpoint()), h, start)?;
        rattle.take_steps(steps / 2)?;
        general.take_steps(steps / 2)?;
        let mut exact = Integrator::new(&angles, Gauss::<4>::new(), h / 16.0, begin)?;
        exact.take_steps(8 * steps - 8)?;
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
