//! Gauss collocation on q'' = f(q, t), where the velocities of the stages are eliminated: it is the method
//! on (q, p), it keeps bilinear invariants to rounding errors, and its energy does not drift; nor does that
//! of as many interior nodes, or where L has terms that are linear in the velocity.

use core::f64::consts::TAU;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{Gravity, GravityState, KEPLER, Kepler, KeplerState, pericentre};
use dvi_tests::{Outcome, larger};

/// Two coupled oscillators of different masses, with a drive.
#[dvi_core::lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + 0.3 * dot(y).powi(2) - (x * x + y * y) / 2.0 - x.powi(4) / 4.0 - x * y / 5.0 + x * (1.3 * t).sin(),
)]
struct Positions;

/// The same motion: L differs by the rate of change of xy + x²y/2, and forces depend on velocities.
#[dvi_core::lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + 0.3 * dot(y).powi(2) - (x * x + y * y) / 2.0 - x.powi(4) / 4.0 - x * y / 5.0 + x * (1.3 * t).sin()
        + dot(x) * y + x * dot(y) + x * y * dot(x) + x * x * dot(y) / 2.0,
)]
struct PhaseSpace;

#[test]
fn it_is_the_method_on_phase_space() -> Outcome {
    fn check<const S: usize>(tolerance: f64) -> Outcome
    where
        Gauss<S>: Tabulated,
    {
        let (h, method) = (0.1, Gauss::<S>::new());
        let start = PositionsState { x: 0.7, y: -0.4, dot_x: 0.2, dot_y: 0.9 };
        let mut short = Integrator::new_at(&Positions, method, 0.3, h, start)?;
        let start = PhaseSpaceState { x: 0.7, y: -0.4, dot_x: 0.2, dot_y: 0.9 };
        let mut long = Integrator::new_at(&PhaseSpace, method, 0.3, h, start)?;
        for _ in 0..100 {
            short.advance()?;
            long.advance()?;
            let (a, b): (PositionsState, PhaseSpaceState) = (short.state(), long.state());
            let difference = [a.x - b.x, a.y - b.y, a.dot_x - b.dot_x, a.dot_y - b.dot_y];
            let difference = difference.map(f64::abs).into_iter().fold(0.0, larger);
            assert!(difference < tolerance, "{S} stages: {difference:e}");
        }
        // In lanes it is the same, bit for bit.
        let start = PositionsState { x: 0.7, y: -0.4, dot_x: 0.2, dot_y: 0.9 };
        let mut again = Integrator::new_at(&Positions, Gauss::<S>::new().in_lanes(), 0.3, h, start)?;
        again.take_steps(100)?;
        assert_eq!(again.checkpoint(), short.checkpoint());
        Ok(())
    }
    // The quadratures of fewer than three stages are not exact for the terms by which momenta differ.
    check::<3>(1e-6)?;
    check::<4>(1e-9)?;
    check::<5>(1e-12)?;
    check::<6>(1e-13)?;
    check::<7>(1e-13)?;
    check::<8>(1e-13)
}

/// The largest errors of energy and angular momentum over 20,000 steps, relative to those at the start.
fn errors(mut run: impl Run<Scalar = f64>, angular: usize) -> Outcome<[f64; 2]> {
    let initial = [run.energy(), run.momentum(angular).ok_or("declared")?];
    let mut largest = [0.0; 2];
    for _ in 0..2_000 {
        run.take_steps(10)?;
        let now = [run.energy(), run.momentum(angular).ok_or("declared")?];
        for i in 0..2 {
            largest[i] = larger(largest[i], (now[i] / initial[i] - 1.0).abs());
        }
    }
    Ok(largest)
}

#[test]
fn bilinear_invariants_and_the_energy_stay_at_rounding_errors() -> Outcome {
    let (kepler, start) = (Kepler { mu: 1.0 }, KeplerState { x: 0.4, y: 0.0, dot_x: 0.0, dot_y: 2.0 });
    let h = TAU / 60.0;
    let [energy, angular] = errors(Integrator::new(&kepler, Gauss::<8>::new().in_lanes(), h, start)?, 0)?;
    assert!(angular < 1e-14 && energy < 1e-13, "{energy:e} {angular:e}");
    let [_, angular] = errors(Integrator::new(&kepler, Gauss::<3>::new(), h, start)?, 0)?;
    assert!(angular < 1e-14, "{angular:e}");

    // Two planets around a star.
    let system = Gravity { mass: [1.0, 1e-3, 3e-4] };
    let start = GravityState {
        x: [0.0, 1.0, -2.2],
        y: [0.0, 0.0, 0.1],
        dot_x: [0.0, 0.05, 0.0],
        dot_y: [-8e-4, 1.0, -0.67],
    };
    let run = Integrator::new(&system, Gauss::<8>::new().in_lanes(), 0.2, start)?;
    let [energy, angular] = errors(run, 1)?;
    assert!(angular < 1e-14 && energy < 1e-13, "{energy:e} {angular:e}");
    Ok(())
}

/// a x x' is the derivative of a function of x: the motion is cos t, and the momentum is v + a x.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0 + a * x * dot(x))]
struct Gauge {
    a: f64,
}

/// Stages are consistent where forces depend on velocities, and velocities that cancel in the momentum have
/// their rounding.
#[test]
fn terms_linear_in_the_velocity_do_not_matter() -> Outcome {
    let start = GaugeState { x: 1.0, dot_x: 0.0 };
    // The energy does not drift, however small a drift per step.
    let system = Gauge { a: 1.0 };
    let mut run = Integrator::new(&system, Gauss::<2>::new(), 0.01, start)?;
    run.take_steps(200_000)?;
    let off = run.energy() - 0.5;
    assert!(off.abs() < 1e-12, "{off:e}");
    for (a, h, bound) in [(1.0, 0.01, 1e-13), (100.0, 0.01, 1e-11), (1e3, 0.1, 1e-9), (1e4, 0.01, 1e-9)] {
        let system = Gauge { a };
        let mut run = Integrator::new(&system, Gauss::<3>::new(), h, start)?;
        run.take_steps((1.0 / h) as u64)?;
        let off = run.state().x - run.time().cos();
        assert!(off.abs() < bound, "a = {a}, h = {h}: {off:e}");
    }
    // With a tolerance, the midpoint rule on the oscillator turns by 2 atan(h/2) a step.
    let mut method = Gauss::<1>::new();
    method.stopping.tolerance = 1e-10;
    let system = Gauge { a: 1e6 };
    let mut run = Integrator::new(&system, method, 0.1, start)?;
    run.take_steps(20)?;
    let off = run.state().x - (40.0 * 0.05_f64.atan()).cos();
    assert!(off.abs() < 1e-7, "{off:e}");
    Ok(())
}

/// The largest energy error of Kepler's orbit in `count` hundreds of steps, and the slope of it over the
/// run.
fn energy_error<M: Method<Kepler, f64>>(method: M, count: u32) -> Outcome<[f64; 2]> {
    let mut run = Integrator::new(&KEPLER, method, 0.2, pericentre(0.3))?;
    let before = run.energy();
    let (mut worst, mut moments) = (0.0, [0.0; 2]);
    for k in 0..count {
        run.take_steps(100)?;
        let error = run.energy() - before;
        worst = larger(worst, error.abs());
        // Against time from −½ to ½.
        let at = (f64::from(k) + 0.5) / f64::from(count) - 0.5;
        moments = [moments[0] + at * error, moments[1] + at * at];
    }
    Ok([worst, (moments[0] / moments[1]).abs()])
}

/// The energy error of the method with eight stages is that of rounding.
#[test]
fn eight_stages_keep_the_energy_to_rounding() -> Outcome {
    let [worst, _] = energy_error(Gauss::<8>::new().in_lanes(), 300)?;
    assert!(worst < 1e-14, "{worst:e}");
    Ok(())
}

/// The energy error of nine nodes is that of rounding, and has no slope that rounding does not explain.
#[test]
fn nine_nodes_keep_the_energy_to_rounding() -> Outcome {
    let method = Galerkin { summation: Summation::Compensated, ..Galerkin::<9>::new() };
    let [worst, drift] = energy_error(method.in_lanes(), 600)?;
    // With six eccentricities from 0.2 to 0.35 the largest are 3e-15 to 1.2e-14.
    assert!(worst < 2e-14 && drift < 2e-14, "{worst:e}, {drift:e}");
    Ok(())
}
