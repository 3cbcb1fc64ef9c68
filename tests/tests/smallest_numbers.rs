//! Below 2.2e-308 numbers are multiples of 4.9e-324: steps there are solved to such multiples, and not to
//! digits that are not there.

use dvi_core::prelude::*;
use dvi_tests::Outcome;

use crate::together::same_as_alone;

/// A mass on a spring in a fluid.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0,
    force(x) = -friction * dot(x),
)]
struct Damped {
    friction: f64,
}

/// The largest |x| over the last steps of a run from an amplitude.
fn amplitude<M: Method<Damped, f64>>(method: M, friction: f64, start: f64, h: f64, steps: u64) -> f64 {
    const LAST: usize = 100;
    let system = Damped { friction };
    let start = DampedState { x: start, dot_x: 0.0 };
    let mut run = Integrator::new(&system, method, h, start).unwrap_or_else(|error| panic!("{error}"));
    run.take_steps(steps).unwrap_or_else(|error| panic!("{error}"));
    let last: Vec<_> =
        run.by_ref().take(LAST).collect::<Result<_, _>>().unwrap_or_else(|error| panic!("{error}"));
    last.iter().fold(0.0, |largest, state| largest.max(state.x.abs()))
}

#[test]
fn a_motion_that_dies_away_comes_to_rest() {
    // From 1e-300 on, e^(−t/4) is below the smallest number from t = 220 on.
    fn comes_to_rest<M: Method<Damped, f64> + Clone>(name: &str, method: &M) {
        for h in [0.1, 0.02] {
            let left = amplitude(method.clone(), 0.5, 1e-300, h, (400.0 / h) as u64);
            assert!(left < 1e-318, "{name}, h = {h}: {left:e} is left");
        }
    }
    comes_to_rest("midpoint", &Variational::midpoint());
    comes_to_rest("fixed point", &Variational { solver: Solver::FixedPoint, ..Variational::midpoint() });
    comes_to_rest("Newton", &Variational { solver: Solver::Newton, ..Variational::midpoint() });
    comes_to_rest("Galerkin", &Galerkin::<4>::new());
    comes_to_rest("Gauss", &Gauss::<4>::new());
}

#[test]
fn the_smallest_oscillations_go_on() {
    const STEPS: u64 = 5000;
    // Rounding errors of a step, one or two multiples of the smallest number, add up as a random walk does.
    let rounding = 4.0 * (STEPS as f64).sqrt() * 5e-324;
    fn go_on<M: Method<Damped, f64> + Clone>(name: &str, method: &M, rounding: f64) {
        for start in [1e-306, 1e-308, 1e-310, 1e-315, 1e-322, 5e-324] {
            for h in [0.1, 0.02] {
                let largest = amplitude(method.clone(), 0.0, start, h, STEPS);
                assert!(largest < 1.001 * start + rounding, "{name}: {largest:e} from {start:e}, h = {h}");
            }
        }
    }
    go_on("Gauss", &Gauss::<4>::new(), rounding);
    go_on("Galerkin", &Galerkin::<4>::new(), rounding);
}

/// The same without friction, in the plane of (x, y).
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y * d(x),
    hamiltonian = (x * x + y * y) / 2.0 + (x * x + y * y).powi(2),
)]
#[derive(PartialEq)]
struct Flow;

#[test]
fn small_runs_share_lanes_with_large_ones() -> Outcome {
    let runs = [1e-310, 1.0, 3e-322, 1e-300].map(|x| (&Flow, FlowState { x, y: 0.0 }));
    let method = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
    let errors = same_as_alone::<4, _, _>(&runs, &method, 0.1, &[3000])?;
    assert!(errors.iter().all(Option::is_none), "{errors:?}");
    Ok(())
}
