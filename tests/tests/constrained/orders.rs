//! The orders of constrained steps, against the same motion in coordinates without constraints.

use approx::abs_diff_eq;
use dvi_core::discrete::Constant;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::constrained::*;

use super::Outcome;

const TIME: f64 = 2.0;

/// The entries of the state after the time, with `steps` steps.
fn after<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    start: S::State<f64>,
    steps: u64,
) -> Result<Vec<f64>, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, TIME / steps as f64, start)?;
    run.take_steps(steps)?;
    Ok(system.values(&run.state())?.collect())
}

fn order<S: Lagrangian, M: Method<S, f64> + Clone>(
    system: &S,
    method: &M,
    [start, end]: [&S::State<f64>; 2],
    steps: u64,
) -> Result<f64, Box<dyn core::error::Error>> {
    let expected: Vec<f64> = system.values(end)?.collect();
    let mut errors = Vec::new();
    for steps in [steps, steps * 5 / 4, steps * 3 / 2, 2 * steps] {
        let found = after(system, method.clone(), start.clone(), steps)?;
        let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        errors.push((TIME / steps as f64, error));
    }
    convergence_order(&errors).ok_or_else(|| "no slope".into())
}

/// `of_order!(system, start, end => method, expected order, steps of the coarsest run; …)`
macro_rules! of_order {
    ($system:expr, $ends:expr => $($method:expr, $expected:literal, $steps:literal;)*) => {$(
        let found = order(&$system, &$method, $ends, $steps)?;
        assert!(abs_diff_eq!(found, $expected, epsilon = 0.12), "{}: {found}", stringify!($method));
    )*};
}

/// The end of the motion by Gauss of order eight in short steps.
fn end<S>(system: &S, start: S::State<f64>) -> Result<S::State<f64>, Box<dyn core::error::Error>>
where
    S: Lagrangian + System<Kind: dvi_core::mechanics::FirstOrder<S, f64>>,
{
    let mut run = Integrator::new(system, Gauss::<4>::new(), TIME / 1000.0, start)?;
    run.take_steps(1000)?;
    Ok(run.state())
}

#[test]
fn two_masses_on_rods() -> Outcome {
    let angles = DoubleAngles { m: [1.0, 2.5], rod: 0.7 };
    let system = Double { m: angles.m, rod: angles.rod };
    let begin = DoubleAnglesState { a: 1.0, b: -0.4, dot_a: 0.3, dot_b: 1.1 };
    let ends = [begin, end(&angles, begin)?].map(|state| angles.masses(&state));
    let ends = [&ends[0], &ends[1]];
    of_order! { system, ends =>
        Rattle::default(), 2.0, 100;
        Constrained::new(Variational::trapezoid()), 2.0, 100;
        Constrained::new(Variational::midpoint()), 2.0, 100;
        Constrained::new(Variational::simpson()), 2.0, 100;
        Constrained::new(Variational::sigma(0.0)), 1.0, 800;
        Constrained::new(Variational::sigma(0.3)), 1.0, 800;
        Constrained::new(Variational::midpoint().phase_fitted(Constant(1.5))), 2.0, 100;
        Composition::triple_jump(Rattle::default()), 4.0, 100;
        Composition::suzuki(Constrained::new(Variational::midpoint())), 4.0, 60;
        Composition::kahan_li_6(Rattle::default()), 6.0, 60;
    }
    Ok(())
}

#[test]
fn a_moved_pivot_with_friction() -> Outcome {
    let (system, angle) = (Swing { gamma: 0.4 }, SwingAngle { gamma: 0.4 });
    let begin = SwingAngleState { a: 1.2, dot_a: 0.5 };
    let ends = [swinging(&begin, 0.0), swinging(&end(&angle, begin)?, TIME)];
    let ends = [&ends[0], &ends[1]];
    of_order! { system, ends =>
        Constrained::new(Variational::trapezoid()), 2.0, 60;
        Constrained::new(Variational::midpoint()), 2.0, 60;
        Constrained::new(Variational::sigma(1.0)), 1.0, 800;
    }
    Ok(())
}

#[test]
fn a_momentum_that_is_no_affine_function_of_the_velocity() -> Outcome {
    let begin = BeadParameterState { s: 0.4, dot_s: 0.5 };
    let ends = [on_ring(&begin), on_ring(&end(&BeadParameter, begin)?)];
    let ends = [&ends[0], &ends[1]];
    of_order! { Bead, ends =>
        Constrained::new(Variational::trapezoid()), 2.0, 60;
        Constrained::new(Variational::midpoint()), 2.0, 60;
        Composition::triple_jump(Constrained::new(Variational::trapezoid())), 4.0, 60;
    }
    Ok(())
}

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
        let off = |found: Vec<f64>| {
            found.iter().zip(expected.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
        };
        errors[0].push((h, off(rattle.memory().multipliers().collect())));
        errors[1].push((h, off(general.memory().multipliers().collect())));
    }
    for errors in errors {
        let order = convergence_order(&errors).ok_or("no slope")?;
        assert!(abs_diff_eq!(order, 2.0, epsilon = 0.12), "{order}, {errors:?}");
    }
    Ok(())
}
