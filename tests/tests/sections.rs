//! Poincaré sections and Lyapunov exponents.

use core::f64::consts::{FRAC_PI_2, TAU};
use dvi_tests::larger;

use dvi_core::prelude::*;
use dvi_tests::configurations::{chaotic, quasi_periodic};
use dvi_tests::systems::*;

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// The midpoint rule turns the oscillator by 2 atan(ωh/2) a step: its orbit is known between points.
fn largest_error(h: f64, direction: Direction) -> Result<(f64, f64), Box<dyn core::error::Error>> {
    let system = Oscillator { omega: 1.0 };
    let (radius, phase) = (1.5_f64, 0.3_f64);
    let start = OscillatorState { x: radius * phase.cos(), y: radius * phase.sin() };
    let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
    let rate = 2.0 * (h / 2.0).atan() / h;
    let section = Section::new(&mut run, direction, |q: &[f64]| q[0]);
    let (mut in_time, mut in_place) = (0.0_f64, 0.0_f64);
    for (k, crossing) in section.take(20).enumerate() {
        let crossing = crossing?;
        // x falls through zero at angle π/2, and rises at 3π/2.
        let (angle, y) = match (direction, k % 2) {
            (Direction::Falling, _) => (FRAC_PI_2 + TAU * k as f64, radius),
            (Direction::Rising, _) => (3.0 * FRAC_PI_2 + TAU * k as f64, -radius),
            (Direction::Either, 0) => (FRAC_PI_2 * (2 * k + 1) as f64, radius),
            (Direction::Either, _) => (FRAC_PI_2 * (2 * k + 1) as f64, -radius),
        };
        in_time = larger(in_time, (crossing.time - (angle - phase) / rate).abs());
        in_place = larger(larger(in_place, crossing.state.x.abs()), (crossing.state.y - y).abs());
    }
    Ok((in_time, in_place))
}

#[test]
fn crossings_are_located_to_near_rounding() -> Outcome {
    for direction in [Direction::Rising, Direction::Falling, Direction::Either] {
        let (in_time, in_place) = largest_error(0.05, direction)?;
        assert!(in_time < 1e-11 && in_place < 1e-12, "{direction:?}: {in_time:e}, {in_place:e}");
    }
    Ok(())
}

#[test]
fn crossings_converge_with_order_eight() -> Outcome {
    let mut errors = Vec::new();
    for h in [0.8, 0.6, 0.4, 0.3] {
        errors.push((h, largest_error(h, Direction::Rising)?.1));
    }
    let order = convergence_order(&errors).ok_or("no slope")?;
    assert!((order - 8.0).abs() < 0.8, "{order}: {errors:?}");
    Ok(())
}

#[test]
fn the_first_crossing_may_lie_in_the_first_step() -> Outcome {
    let system = Oscillator { omega: 1.0 };
    let start = OscillatorState { x: 0.01, y: 1.0 };
    let mut run = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?;
    let first = Section::new(&mut run, Direction::Falling, |q: &[f64]| q[0]).next();
    let crossing = first.ok_or("no crossing")??;
    assert!((crossing.time - 0.01).abs() < 1e-4, "{}", crossing.time);
    Ok(())
}

#[test]
fn a_section_ends_with_the_failure_of_its_run() -> Outcome {
    let (system, start) = quasi_periodic();
    let mut run = Integrator::new(&system, Sigma::midpoint(), 1.0, start)?;
    let mut section = Section::new(&mut run, Direction::Rising, |q: &[f64]| q[0]);
    let error = section.by_ref().find_map(Result::err);
    assert!(matches!(error, Some(StepError { failure: StepFailure::NotConverged { .. }, .. })));
    assert!(section.next().is_none());
    Ok(())
}

fn exponent(
    (system, start): (PointVortices<4>, PointVorticesState<4>),
    h: f64,
    time: f64,
) -> Result<f64, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
    let mut lyapunov = LyapunovExponent::new(&run);
    assert_eq!(lyapunov.exponent(), None);
    while run.time() < time {
        lyapunov.advance(&mut run)?;
    }
    lyapunov.exponent().ok_or_else(|| "no exponent".into())
}

#[test]
fn chaos_has_a_positive_exponent_and_quasi_periodic_motion_has_none() -> Outcome {
    let (chaos, order) = (exponent(chaotic(), 0.2, 4000.0)?, exponent(quasi_periodic(), 0.1, 4000.0)?);
    assert!(chaos > 0.03, "{chaos}");
    assert!(order.abs() < 0.006, "{order}");
    Ok(())
}

#[test]
fn a_saddle_has_its_own_exponent() -> Outcome {
    // H = ½z² + cos φ, α = −z dφ: near φ = 0 the midpoint rule grows by (1 + h/2)/(1 − h/2) a step.
    let (system, start) = (SphereForm { gamma: 1.0 }, SphereFormState { phi: 0.0, z: 0.0 });
    let h: f64 = 0.1;
    let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
    let mut lyapunov = LyapunovExponent::new(&run);
    for _ in 0..200 {
        lyapunov.advance(&mut run)?;
    }
    let settled = lyapunov.growth();
    for _ in 0..200 {
        lyapunov.advance(&mut run)?;
    }
    let rate = (lyapunov.growth() - settled) / 20.0;
    let exact = ((1.0 + h / 2.0) / (1.0 - h / 2.0)).ln() / h;
    assert!((rate - exact).abs() < 1e-12, "{rate} and {exact}");
    Ok(())
}

/// A regular oscillator, whose exact steps are known between points.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) - x * x - y * y) / 2.0,
)]
#[derive(Clone, Debug)]
struct Planar;

#[test]
fn crossings_of_a_regular_system_have_velocities() -> Outcome {
    let method = Variational::simpson().phase_fitted(Constant(1.0));
    let method = Variational { fitting: Fitting::PhaseAndMomentum, ..method };
    // x = cos t, y = 2 sin t: x rises through zero at 3π/2.
    let start = PlanarState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 2.0 };
    let mut run = Integrator::new(&Planar, method, 0.05, start)?;
    let section = Section::new(&mut run, Direction::Rising, |q: &[f64]| q[0]);
    for (k, crossing) in section.take(5).enumerate() {
        let Crossing { time, state, .. } = crossing?;
        let exact = 3.0 * FRAC_PI_2 + TAU * k as f64;
        assert!((time - exact).abs() < 1e-10, "{time}");
        for (found, exact) in [(state.x, 0.0), (state.y, -2.0), (state.dot_x, 1.0), (state.dot_y, 0.0)] {
            assert!((found - exact).abs() < 1e-9, "{state:?}");
        }
    }
    Ok(())
}

#[test]
fn crossings_of_a_run_with_controlled_steps_lie_on_its_orbit() -> Outcome {
    // Each step is exact, whatever its length: x = cos t, y = 2 sin t, and the steps vary by more than two to one.
    let method = Variational::simpson().phase_fitted(Constant(1.0));
    let method = Variational { fitting: Fitting::PhaseAndMomentum, ..method };
    let start = PlanarState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 2.0 };
    let mut run = ControlledIntegrator::new(&Planar, method, Reversible::power(0.05, 1.5), start)?;
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
    for _ in 0..200 {
        run.advance()?;
        (shortest, longest) = (f64::min(run.step_size(), shortest), larger(longest, run.step_size()));
    }
    assert!(longest > 2.0 * shortest, "{shortest} {longest}");
    let begin = run.time();
    let section = Section::new(&mut run, Direction::Rising, |q: &[f64]| q[0]);
    let first = ((begin - 3.0 * FRAC_PI_2) / TAU).ceil();
    for (k, crossing) in section.take(5).enumerate() {
        let Crossing { time, state, .. } = crossing?;
        let exact = 3.0 * FRAC_PI_2 + TAU * (first + k as f64);
        assert!((time - exact).abs() < 1e-9, "{time} {exact}");
        for (found, exact) in [(state.x, 0.0), (state.y, -2.0), (state.dot_x, 1.0), (state.dot_y, 0.0)] {
            assert!((found - exact).abs() < 1e-7, "{state:?}");
        }
    }
    Ok(())
}
