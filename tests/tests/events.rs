//! Events of a run are as accurate as the run, by every kind of method and with steps of all lengths.

mod changes;
mod declared;
mod edges;
mod jumps;
mod scales;

use approx::abs_diff_eq;
use core::f64::consts::{FRAC_PI_2, TAU};

use dvi_core::prelude::*;
use dvi_tests::systems::*;
use dvi_tests::zoo::gauges::{OneSided, OneSidedState};
use dvi_tests::zoo::regular::{PLANE, Planar, PlanarState};
use dvi_tests::{Outcome, bits, larger};

/// The midpoint rule turns the oscillator by 2 atan(ωh/2) a step: with it, crossings are known as parts of a
/// step.
fn check_against_closed_form(h: f64, direction: Direction) -> Outcome {
    let system = Oscillator { omega: 1.0 };
    let (radius, phase) = (1.5_f64, 0.3_f64);
    let start = OscillatorState { x: radius * phase.cos(), y: radius * phase.sin() };
    let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
    let events = run.events([direction], |_, state: &OscillatorState| [state.x])?;
    let turn = |h: f64| 2.0 * (h / 2.0).atan();
    for (k, crossing) in events.take(20).enumerate() {
        let crossing = crossing?;
        // x falls through zero at angle π/2, and rises at 3π/2.
        let (angle, y) = match (direction, k % 2) {
            (Direction::Falling, _) => (FRAC_PI_2 + TAU * k as f64, radius),
            (Direction::Rising, _) => (3.0 * FRAC_PI_2 + TAU * k as f64, -radius),
            (Direction::Either, 0) => (FRAC_PI_2 * (2 * k + 1) as f64, radius),
            (Direction::Either, _) => (FRAC_PI_2 * (2 * k + 1) as f64, -radius),
        };
        let steps = ((angle - phase) / turn(h)).floor();
        let time = steps * h + 2.0 * ((angle - phase - steps * turn(h)) / 2.0).tan();
        let (found, in_place) =
            (crossing.time, larger(crossing.state.x.abs(), (crossing.state.y - y).abs()));
        assert!(abs_diff_eq!(found, time, epsilon = 1e-12), "{direction:?}, {h}: {found} {time}");
        assert!(in_place < 1e-13, "{direction:?}, {h}: {in_place:e}");
    }
    Ok(())
}

#[test]
fn crossings_are_located_to_rounding_on_a_step_of_the_method() -> Outcome {
    for direction in [Direction::Rising, Direction::Falling, Direction::Either] {
        for h in [0.05, 0.6, 1.7] {
            check_against_closed_form(h, direction)?;
        }
    }
    Ok(())
}

/// The largest error of the first `count` times at which cos t rises through zero.
fn largest_error<R: Run<System = Planar, Scalar = f64>>(mut run: R, count: usize) -> Outcome<f64> {
    let mut largest = 0.0;
    for (k, event) in run.events([Direction::Rising], |_, state| [state.x])?.take(count).enumerate() {
        let Event { time, state, .. } = event?;
        assert!(state.x.abs() < 1e-11, "{state:?}");
        largest = larger(largest, (time - 3.0 * FRAC_PI_2 - TAU * k as f64).abs());
    }
    Ok(largest)
}

const PLANAR: PlanarState = PlanarState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 2.0 };

/// Some of these steps are longer than half a period: what crosses twice in one step is seen. Steps of
/// several periods, which a tolerance of 1e-3 allows, cross more often than that.
#[test]
fn crossings_of_long_steps_are_as_accurate_as_the_run() -> Outcome {
    let method = Gauss::<8>::new();
    for (tolerance, most) in [(1e-12, 1e-10), (1e-9, 1e-7), (1e-6, 1e-4)] {
        let control = ErrorControl::new(tolerance, 0.1);
        let error = largest_error(Integrator::controlled(&PLANE, method, control, PLANAR)?, 50)?;
        assert!(error < most, "{tolerance:e}: {error:e}");
    }
    for (h, most) in [(0.6, 1e-12), (2.0, 1e-10)] {
        let error = largest_error(Integrator::new(&PLANE, method, h, PLANAR)?, 50)?;
        assert!(error < most, "{h}: {error:e}");
    }
    // With the order of the method, 2 and 4.
    for (order, method) in [(2.0, RungeKutta::midpoint()), (4.0, RungeKutta::classical())] {
        let mut errors = Vec::new();
        for h in [0.2, 0.1, 0.05, 0.025] {
            errors.push((h, largest_error(Integrator::new(&PLANE, method, h, PLANAR)?, 5)?));
        }
        let slope = convergence_order(&errors).ok_or("no slope")?;
        assert!(abs_diff_eq!(slope, order, epsilon = 0.2), "{order}: {slope}");
    }
    Ok(())
}

/// x = cos t is above 0.95 for 0.64 in each period, and steps are longer.
#[test]
fn two_crossings_within_a_step_are_seen() -> Outcome {
    for (level, h) in [(0.95_f64, 0.9), (0.95, 1.5), (-0.5, 2.3), (0.999, 0.3), (0.999_99, 0.1)] {
        let mut run = Integrator::new(&PLANE, Gauss::<8>::new(), h, PLANAR)?;
        let half = level.acos();
        let events = run.events([Direction::Either], |_, state| [state.x - level])?;
        for (k, crossing) in events.take(60).enumerate() {
            let nearest = TAU * k.div_ceil(2) as f64;
            let exact = if k % 2 == 0 { nearest + half } else { nearest - half };
            let time = crossing?.time;
            assert!(abs_diff_eq!(time, exact, epsilon = 1e-8), "{level}, {h}: {time} {exact}");
        }
    }
    Ok(())
}

type StateOf<R> = <<R as Run>::System as System>::State<f64>;

/// The points of a run that is asked for events are those of one that is not.
#[test]
fn the_points_of_a_run_stay_as_they_are() -> Outcome {
    fn check<R: Run<Scalar = f64>>(run: impl Fn() -> Outcome<R>, x: fn(&StateOf<R>) -> f64) -> Outcome {
        let (mut plain, mut searched) = (run()?, run()?);
        let mut events =
            searched.events([Direction::Either; 2], |t, state| [x(state), x(state) - t.cos()])?;
        let mut count = 0;
        while events.run().steps() < 300 {
            let t = events.run().time() + 3.3 * events.run().step_size();
            while events.next_until(t)?.is_some() {
                count += 1;
            }
        }
        assert!(count > 1);
        plain.take_steps(searched.steps())?;
        assert_eq!(bits(plain.q()), bits(searched.q()));
        assert_eq!((plain.time(), plain.statistics()), (searched.time(), searched.statistics()));
        Ok(())
    }
    let oscillator = Oscillator { omega: 1.0 };
    let at = OscillatorState { x: 1.0, y: 0.0 };
    for sigma in [0.0, 0.3, 0.5] {
        check(|| Ok(Integrator::new(&oscillator, Sigma::new(sigma), 0.1, at)?), |state| state.x)?;
    }
    check(|| Ok(Integrator::new(&PLANE, Variational::trapezoid(), 0.1, PLANAR)?), |state| state.x)?;
    let limited = EnergyLimit { method: Galerkin::<3>::new(), limit: 1.0 };
    check(|| Ok(Integrator::new(&PLANE, limited, 0.1, PLANAR)?), |state| state.x)?;
    let (method, control) = (Gauss::<4>::new().in_lanes(), ErrorControl::new(1e-9, 0.1));
    check(|| Ok(Integrator::controlled(&PLANE, method, control, PLANAR)?), |state| state.x)
}

/// Where α is not affine, p − α(q) depends on the length of a step. Orbits of the midpoint scheme lie on
/// closed curves, and crossings in all parts of a step near them, to the third order of a step.
#[test]
fn crossings_of_a_scheme_with_a_defect_lie_near_its_orbit() -> Outcome {
    // x' = x (y − 1), y' = y (2 − x)
    let system = OneSided { a: [-1.0; 2], b: [2.0, 1.0] };
    let mut widths = Vec::new();
    for h in [0.1, 0.05, 0.025] {
        let start = OneSidedState { x: 1.0, y: 0.5 };
        let mut run = Integrator::new(&system, Sigma::midpoint(), h, start)?;
        let [mut least, mut most] = [f64::INFINITY, 0.0];
        for event in run.events([Direction::Rising], |_, state| [state.x - 2.0])?.take(40) {
            let y = event?.state.y;
            (least, most) = (f64::min(least, y), larger(most, y));
        }
        widths.push((h, most - least));
    }
    let slope = convergence_order(&widths).ok_or("no slope")?;
    assert!(slope > 2.7, "{slope}: {widths:?}");
    Ok(())
}
