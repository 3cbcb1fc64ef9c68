//! How forces are declared, what is said of them, and what is refused.

use dvi_core::field::{Axis, Spline};
use dvi_core::prelude::*;
use dvi_core::{IndexError, OutsideError, ScalarField};

use super::Outcome;
use dvi_tests::laws::systems::{Damped, Harvested, Pulled, Swirl, SwirlState};
use dvi_tests::zoo::regular::Kepler;

/// Forces as a list, with arrays of run-time size.
#[lagrangian(
    coordinates(x[n], y),
    lagrangian = sum(0..n, |i| dot(x[i]).powi(2) / 2.0) + dot(y).powi(2) / 2.0,
    force = [|i| -c[i] * dot(x[i]) + x[(i + 1) % n], -y * t],
)]
#[derive(Clone, Debug)]
struct Listed {
    n: usize,
    c: Vec<f64>,
}

#[test]
fn indices_of_forces_are_checked_against_their_arrays() {
    let short = Listed { n: 3, c: vec![0.1, 0.2] };
    let start = ListedState { x: vec![0.0; 3], y: 0.0, dot_x: vec![0.0; 3], dot_y: 0.0 };
    let error = Integrator::new(&short, Variational::midpoint(), 0.1, start).err();
    assert_eq!(error, Some(StartError::Index(IndexError { array: "c", index: 2, len: 2 })));
}

/// A pendulum with friction, driven, in phase space.
#[degenerate_lagrangian(
    coordinates(q, p),
    one_form = p * d(q),
    hamiltonian = p * p / 2.0 - q.cos(),
    force(q) = -gamma * p + 0.5 * (2.0 * t).cos(),
)]
struct Pendulum {
    gamma: f64,
}

#[test]
fn reports_name_the_forces_and_what_they_mean() {
    let text = Damped::REPORT.to_string();
    for line in [
        "force(x) = -dot(x)·gamma",
        "Forces act: no method preserves a form, and energy and momenta change as the forces make them.",
        "L = ½ v·M v − V(q, t) with a constant diagonal mass matrix M.",
        "A force depends on velocities: the trapezoidal step is implicit, and linear in the velocity if the force is.",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    assert!(text.contains("∂L/∂x + force(x) = "), "{text}");
    let text = Pulled::REPORT.to_string();
    assert!(text.contains("force(z[i]) = "), "{text}");
    let text = Pendulum::REPORT.to_string();
    assert!(text.contains("∂H/∂q − force(q) = ") && text.contains("∂H/∂p = "), "{text}");
    // What preserves Ω without forces does not with them.
    let text = Harvested::REPORT.to_string();
    assert!(text.contains("Begin with `OneStep::midpoint()`: it has no parasitic mode.\n"), "{text}");
    assert!(!text.contains("preserves Ω"), "{text}");
    // Without velocities in the forces the step stays explicit.
    let text = Swirl::REPORT.to_string();
    assert!(text.contains("step is explicit"), "{text}");
    const {
        assert!(
            <Swirl as NondegenerateLagrangian>::CONSTANT_MASS
                && <Damped as NondegenerateLagrangian>::CONSTANT_MASS
        );
    };
    const {
        assert!(
            <Swirl as NondegenerateLagrangian>::SEPARABLE && !<Damped as NondegenerateLagrangian>::SEPARABLE
        );
    };
    const { assert!(Swirl::FORCED && !Kepler::FORCED) };
}

#[test]
fn an_explicit_step_takes_one_evaluation_of_the_forces() -> Outcome {
    let system = Swirl { swirl: 0.4 };
    let mut run = Integrator::new(
        &system,
        Variational::trapezoid(),
        0.1,
        SwirlState { x: 0.7, y: 0.4, dot_x: -0.2, dot_y: 0.5 },
    )?;
    run.take_steps(100)?;
    assert_eq!((run.statistics().gradients, run.statistics().iterations), (100, 0));
    Ok(())
}

/// Friction in a table of velocities, which the motion leaves.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0, force(x) = -drag(dot(x)))]
#[derive(Clone, Debug)]
struct Dragged {
    drag: Spline<1>,
}

#[test]
fn a_force_outside_of_its_table_is_an_error_that_says_so_and_the_state_is_known() -> Outcome {
    let axis = Axis::uniform([-0.5, 0.5], 11)?;
    let values: Vec<f64> = (0..11).map(|i| 0.02 * f64::from(i - 5)).collect();
    let system = Dragged { drag: Spline::new([axis], &values)? };
    assert_eq!(system.drag.domain()[0], (-0.5, 0.5));
    for rule in [Quadrature::gauss(1)?, Quadrature::lobatto(3)?] {
        let begin =
            |dot_x| Integrator::new(&system, Variational::new(rule), 0.1, DraggedState { x: 1.0, dot_x });
        let mut run = begin(0.0)?;
        let error = (0..100).find_map(|_| run.advance().err()).ok_or("no error")?;
        let StepFailure::Outside(OutsideError { bound, .. }) = error.failure else {
            return Err(error.into());
        };
        assert_eq!(bound, -0.5, "{error}");
        assert!(run.state().dot_x.is_finite() && run.energy().is_finite(), "{:?}", run.state());
        assert!(matches!(begin(0.6).err(), Some(StartError::Outside(_))));
    }
    Ok(())
}
