//! Where runs with constraints can begin, and what is said where they cannot.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::constrained::*;
use dvi_tests::{failing, larger};

use super::{Outcome, PENDULUM};

/// Rods of many lengths.
fn links(n: usize) -> (Links, LinksState) {
    Links::stretched((0..n).map(|i| 0.5 + 0.1 * (i % 4) as f64).collect())
}

#[test]
fn a_start_off_a_constraint_is_an_error_that_names_it() {
    let double = Double { m: [1.0, 1.0], rod: 0.7 };
    let start = DoubleState { x: [0.0, 0.0], y: [-1.0, -1.8], dot_x: [0.0; 2], dot_y: [0.0; 2] };
    let Err(StartError::OffConstraint { constraint, value }) =
        Integrator::new(&double, Rattle::default(), 0.1, start).map(drop)
    else {
        panic!("a start beside the constraints")
    };
    assert!(constraint == 1 && (value - 0.1).abs() < 1e-14, "{constraint} {value}");
    let start = DoubleState { x: [0.0, 0.0], y: [-1.0, -1.7], dot_x: [0.1, 0.1], dot_y: [0.0, 0.3] };
    let Err(StartError::AcrossConstraint { constraint, rate }) =
        Integrator::new(&double, Constrained::new(Midpoint), 0.1, start).map(drop)
    else {
        panic!("a velocity across the constraints")
    };
    assert!(constraint == 1 && (rate + 0.3).abs() < 1e-14, "{constraint} {rate}");
}

#[test]
fn a_state_is_projected_to_the_constraints() -> Outcome {
    let (system, mut state) = links(20);
    for (i, x) in state.x.iter_mut().enumerate() {
        *x += 0.05 * (i as f64).sin();
    }
    state.dot_y = (0..20).map(|i| (i as f64).cos()).collect();
    let found = system.projected(0.0, &state)?;
    let mut values = vec![0.0; 20];
    let [q, v] =
        [[&found.x, &found.y], [&found.dot_x, &found.dot_y]].map(|parts| parts.map(Vec::as_slice).concat());
    system.constraint(&q, 0.0, &mut values);
    assert!(values.iter().all(|g: &f64| g.abs() < 1e-14), "{values:?}");
    system.constraint_rate(&q, &v, 0.0, &mut values);
    assert!(values.iter().all(|g: &f64| g.abs() < 1e-14), "{values:?}");
    // A state on the constraints stays where it is.
    let again = system.projected(0.0, &found)?;
    let apart = system.values(&again)?.zip(system.values(&found)?).map(|(a, b): (f64, f64)| (a - b).abs());
    assert!(apart.fold(0.0, larger) < 1e-14);
    Integrator::new(&system, Rattle::default(), 0.01, found)?.take_steps(10)?;
    Ok(())
}

const RELEASED: PendulumState = PendulumState { x: 0.8, y: -0.6, dot_x: 0.0, dot_y: 0.0 };

/// Starts that are off by more than rounding are none, beside a large coordinate that has nothing to do with
/// it too.
#[test]
fn starts_are_judged_by_rounding_errors() {
    let state = BesideState { far: 1e9, a: 1.0, b: 3.0, dot_far: 1e9, dot_a: 1.0, dot_b: -2.0 };
    let begun = Integrator::new(&Beside, Rattle::default(), 0.1, state).map(drop);
    assert!(matches!(begun, Err(StartError::OffConstraint { constraint: 0, .. })), "{begun:?}");
    let begun = Integrator::new(&Beside, Rattle::default(), 0.1, BesideState { a: 6.0, ..state }).map(drop);
    assert!(matches!(begun, Err(StartError::AcrossConstraint { constraint: 0, .. })), "{begun:?}");
}

/// A coordinate that is not constrained, and two that are.
#[lagrangian(
    coordinates(far, a, b),
    lagrangian = (dot(far).powi(2) + dot(a).powi(2) + dot(b).powi(2)) / 2.0,
    constraint = a - 2.0 * b,
)]
#[derive(Clone, Copy, Debug)]
struct Beside;

/// One circle twice, and two that do not meet.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0,
    constraint = x * x + y * y - 1.0,
    constraint = [z - x, weight * (x * x + y * y) + (1.0 - weight) * z - offset],
)]
#[derive(Clone, Copy, Debug)]
struct Circles {
    weight: f64,
    offset: f64,
}

#[test]
fn redundant_and_inconsistent_constraints_are_named() {
    let state = CirclesState { x: 1.0, y: 0.0, z: 1.0, dot_x: 0.0, dot_y: 0.0, dot_z: 0.0 };
    let redundant = Circles { weight: 1.0, offset: 1.0 };
    let named = |error: StartError| match error {
        StartError::Starter(StepFailure::RedundantConstraint { constraint, .. })
        | StartError::Projection(StepFailure::RedundantConstraint { constraint, .. }) => constraint,
        other => panic!("{other}"),
    };
    for error in [
        Integrator::new(&redundant, Rattle::default(), 0.1, state).map(drop),
        Integrator::new(&redundant, Constrained::new(Midpoint), 0.1, state).map(drop),
        redundant.projected(0.0, &state).map(drop),
    ] {
        assert_eq!(error.map_err(named), Err(2));
    }
    let message = redundant.projected(0.0, &state).map(drop).expect_err("redundant").to_string();
    assert!(message.contains("constraint 2 is redundant"), "{message}");
    // The gradient of a circle vanishes at its centre.
    let centre = PENDULUM.projected(0.0, &PendulumState { x: 0.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 });
    assert_eq!(centre.map(drop).map_err(named), Err(0));
    // z = x and z = 3 leave no point of the circle.
    let apart = Circles { weight: 0.0, offset: 3.0 };
    let near = CirclesState { x: 0.6, y: 0.8, z: 0.6, ..state };
    let Err(StartError::Inconsistent { constraint, value }) = apart.projected(0.0, &near).map(drop) else {
        panic!("there is no such state")
    };
    assert!(constraint < 3 && value.abs() > 0.1, "{constraint} {value}");
}

/// From anywhere on a ray the circle is met where the ray meets it, up to rounding.
#[test]
fn far_and_near_states_are_projected() -> Outcome {
    let at = |x: f64, y: f64| PendulumState { x, y, dot_x: -y.signum(), dot_y: x.signum() };
    for exponent in (-153..=153).step_by(3) {
        let size = 10_f64.powi(exponent);
        for (x, y) in [(1.0, 0.5), (1.0, 0.0), (0.0, -1.0), (-0.3, 0.7), (1.0, 1e-10), (-1e-5, -1.0)] {
            let found = PENDULUM.projected(0.0, &at(size * x, size * y))?;
            let radius = f64::hypot(x, y);
            // Some 500 iterations lead from the farthest, each with rounding errors.
            for (found, expected) in [(found.x, x / radius), (found.y, y / radius)] {
                assert!(abs_diff_eq!(found, expected, epsilon = 1e-14), "{size:e} ({x}, {y}): {found}");
            }
            let off = found.x * found.x + found.y * found.y - 1.0;
            assert!(off.abs() <= 3.0 * f64::EPSILON, "{found:?}");
            Integrator::new(&PENDULUM, Rattle::default(), 0.01, found)?;
        }
    }
    for exponent in -18..=18 {
        let size = 10_f32.powi(exponent);
        let start = PendulumStateOf { x: size, y: 0.5 * size, dot_x: 1.0, dot_y: 0.0 };
        let found: PendulumStateOf<f32> = PENDULUM.projected(0.0, &start)?;
        let off = [found.x - 0.8_f32.sqrt(), found.y - 0.2_f32.sqrt()];
        assert!(off.iter().all(|off| off.abs() < 2e-6), "{size:e}: {found:?}");
        Integrator::new(&PENDULUM, Constrained::new(Midpoint), 0.01_f32, found)?;
    }
    // Where the squares are no numbers, that is said.
    let said = |x: f64| PENDULUM.projected(0.0, &at(x, 0.0)).map_err(|error| error.to_string());
    for x in [1e155, 1e300, 1e-160, 1e-300] {
        assert!(
            said(x).is_err_and(|said| said.contains("constraint 0") && said.contains("inf")),
            "{:?}",
            said(x)
        );
    }
    Ok(())
}

/// Of higher degrees, in coordinates of several sizes.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + 1e-6 * dot(z).powi(2)) / 2.0,
    constraint = [x.powi(4) - 1.0, y.powi(3) - 2.0 * x, (z - 1e3 * x).powi(3) - y + 8.0],
)]
#[derive(Clone, Copy, Debug)]
struct Curved;

#[test]
fn several_constraints_are_met_from_far_away() -> Outcome {
    let y = 2_f64.cbrt();
    let z = 1e3 - (8.0 - y).cbrt();
    for (x, far_y, far_z) in [
        (1.1, 0.5, 1.0),
        (1e3, 300.0, -1e9),
        (1e16, 100.0, 1e20),
        (1e50, -700.0, 1e60),
        (1e76, 1e100, -1e100),
        (1e-3, 1e-9, 0.0),
    ] {
        let start = CurvedState { x, y: far_y, z: far_z, dot_x: 1.0, dot_y: 1.0, dot_z: 1.0 };
        let found = Curved.projected(0.0, &start)?;
        let off = [found.x - 1.0, (found.y - y) / y, (found.z - z) / z];
        assert!(off.iter().all(|off| off.abs() < 1e-15), "{x:e}: {off:?}");
        // Three constraints leave no velocity.
        assert!([found.dot_x, found.dot_y, found.dot_z].iter().all(|v| v.abs() < 1e-12), "{found:?}");
        Integrator::new(&Curved, Rattle::default(), 0.01, found)?;
    }
    let (system, mut state) = links(20);
    let mut numbers = dvi_tests::Numbers(19);
    for size in [1e-3, 0.1, 10.0, 1e3, 1e100] {
        state.x.iter_mut().chain(&mut state.y).for_each(|x| *x = size * numbers.next());
        let found = match system.projected(0.0, &state) {
            Ok(found) => found,
            // Twenty constraints hinder each other, and come near too slowly.
            Err(StartError::Inconsistent { value, .. }) if size == 1e100 && value.abs() > 1.0 => continue,
            Err(error) => return Err(error.into()),
        };
        let joint = |i: usize| (found.x[i], found.y[i]);
        for i in 0..20 {
            let (before, here) = (if i == 0 { (0.0, 0.0) } else { joint(i - 1) }, joint(i));
            let length = f64::hypot(here.0 - before.0, here.1 - before.1);
            assert!((length / system.rod[i] - 1.0).abs() < 1e-13, "{size:e}, rod {i}: {length}");
        }
        Integrator::new(&system, Rattle::default(), 0.01, found)?;
    }
    Ok(())
}

/// A redundant constraint of a chain, whose equations are banded.
#[test]
fn redundant_constraints_of_a_chain_are_named() {
    let (mut system, mut state) = links(30);
    // A rod without length: its gradient vanishes.
    system.rod[17] = 0.0;
    for i in 17..30 {
        state.x[i] = state.x[i - 1] + system.rod[i];
    }
    let error = Integrator::new(&system, Constrained::new(Midpoint), 0.1, state).map(drop);
    let Err(StartError::Starter(StepFailure::RedundantConstraint { constraint, .. })) = error else {
        panic!("{error:?}")
    };
    assert_eq!(constraint, 17);
}

/// The tension of a rod, m (v²/l + g cos a) at the angle a from below.
#[test]
fn multipliers_at_a_state_in_closed_form() -> Outcome {
    let system = Pendulum { m: 1.7, g: 2.0, length: 1.3 };
    for (a, speed) in [(0.3_f64, 0.7), (2.0, -1.1), (-1.0, 0.0)] {
        let (sin, cos) = a.sin_cos();
        let state = PendulumState { x: 1.3 * sin, y: -1.3 * cos, dot_x: speed * cos, dot_y: speed * sin };
        let tension = 1.7 * (speed * speed / 1.3 + 2.0 * cos);
        let multipliers = system.multipliers_at(0.0, &state)?;
        // The force of the rod is 2λ(x, y).
        assert!((multipliers[0] + tension / 2.6).abs() < 1e-14, "{}", multipliers[0]);
    }
    Ok(())
}

/// The limit of an energy goes around.
#[test]
fn the_energy_of_constrained_steps_is_limited() -> Outcome {
    let method = EnergyLimit { method: Constrained::new(Midpoint), limit: 1e-6 };
    let (_, error) = failing(&PENDULUM, method, 0.5, RELEASED)?;
    assert!(matches!(error.failure, StepFailure::Energy { .. }), "{error}");
    Ok(())
}
